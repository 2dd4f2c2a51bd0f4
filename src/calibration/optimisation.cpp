/// Runs an optimisation as a stage: a round is what the optimiser asks for, an item a run
/// of points. All follows from the answers, which rank 0 tells to an optimiser made anew.
/// Source: paper 2's swarm and pattern search; NSGA-II, as paper 3 compares with it.
/// Methods are in `make_method` and `make_nsga2`, objectives in `meter_goal` and
/// `target_goal`.
#include "calibration/optimisation.hpp"

#include "base/nan.hpp"
#include "calibration/meter_goal.hpp"
#include "calibration/method.hpp"
#include "calibration/target_goal.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

constexpr std::uint32_t optimiser_stream = 0x6f707469;

std::size_t budget_of(const OptimisationOptions& options) {
    if (options.method != OptimisationMethod::nsga2) return options.evaluations;
    return static_cast<std::size_t>(options.n_population) *
           static_cast<std::size_t>(options.n_generations);
}

optimise::Optimiser make_optimiser(const Goal& goal, const OptimisationOptions& options) {
    optimise::Limits limits;
    limits.evaluations = budget_of(options);
    return {optimise::Space(goal.variables()), goal.objectives().size(), limits,
            method_of(options, optimiser_stream)};
}

/// The optimiser with all that it was told, and a record of it.
struct History {
    optimise::Optimiser optimiser;
    std::size_t n_items = 0;  ///< told
    Matrix points, values;    ///< all of them
    std::vector<double> round_end, round_best;
    std::vector<study::Failure> failures;
};

class Optimisation : public study::Stage {
  public:
    Optimisation(std::string name, std::unique_ptr<const Goal> goal,
                 const OptimisationOptions& options)
        : name_(std::move(name)),
          options_(options),
          goal_(std::move(goal)),
          points_(make_optimiser(*goal_, options).next_points()) {}

    std::string name() const override { return name_; }
    int n_items() const override { return static_cast<int>(items_of(points_.rows)); }
    long long n_simulations() const override {
        return static_cast<long long>(budget_of(options_));
    }
    std::size_t answer_bytes() const override {
        return sizeof(double) * options_.points_per_item * goal_->objectives().size();
    }
    bool has_rounds() const override { return true; }
    study::Activity activity() const override;
    study::ItemAnswer run(int item) const override;
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override;
    void begin_round(int first_item, const study::Round& round) override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    std::vector<double> best_point(
        const std::vector<study::ItemAnswer>& answers) const override;
    bool failures_may_pass() const override { return goal_->failures_may_pass(); }

  private:
    std::size_t items_of(std::size_t n_points) const {
        return (n_points + options_.points_per_item - 1) / options_.points_per_item;
    }
    History start() const {
        return {make_optimiser(*goal_, options_), 0, {}, {}, {}, {}, {}};
    }
    void follow(const std::vector<study::ItemAnswer>& answers, History& history) const;

    std::string name_;
    OptimisationOptions options_;
    std::unique_ptr<const Goal> goal_;
    Matrix points_;                           ///< of this round
    int first_item_ = 0;                      ///< of this round
    std::size_t n_before_ = 0;                ///< points before it
    mutable std::optional<History> history_;  ///< of rank 0, from round to round
};

void append(const Matrix& some, Matrix& all) {
    all.cols = some.cols;
    all.rows += some.rows;
    all.values.insert(all.values.end(), some.values.begin(), some.values.end());
}

study::ItemAnswer Optimisation::run(int item) const {
    const std::size_t first =
        static_cast<std::size_t>(item - first_item_) * options_.points_per_item;
    const std::size_t n = std::min(options_.points_per_item, points_.rows - first);
    std::vector<std::string> failures;
    study::ItemAnswer answer;
    answer.values = goal_->evaluate(study::part_of(points_, first, n), failures).values;
    answer.failures = study::failures_of_points(failures, n_before_ + first);
    return answer;
}

/// Writes an item's values behind `first`; one that failed as a whole is as many failed
/// points.
void take(const study::ItemAnswer& answer, std::size_t first, std::size_t n,
          Matrix& values, History& history) {
    study::append_failures(answer, {history.points.rows + first, n}, history.failures);
    if (answer.error.empty()) std::ranges::copy(answer.values, values.row(first).begin());
}

/// Tells the optimiser the answers that it does not know yet.
void Optimisation::follow(const std::vector<study::ItemAnswer>& answers,
                          History& history) const {
    while (history.n_items < answers.size()) {
        const Matrix points = history.optimiser.next_points();
        if (points.rows == 0) return;
        Matrix values(points.rows, goal_->objectives().size(), nan);
        for (std::size_t first = 0;
             first < points.rows && history.n_items < answers.size();
             first += options_.points_per_item)
            take(answers[history.n_items++], first,
                 std::min(options_.points_per_item, points.rows - first), values,
                 history);
        history.optimiser.tell(values);
        append(points, history.points);
        append(values, history.values);
        history.round_end.push_back(static_cast<double>(history.points.rows));
        if (values.cols == 1)
            history.round_best.push_back(history.optimiser.found()[0].objectives[0]);
    }
}

/// Of the rounds before, which rank 0 alone knows.
study::Activity Optimisation::activity() const {
    if (!history_) return {};
    std::string text;
    if (!history_->round_best.empty())
        text = fmt::format("best {:.4g} after ", history_->round_best.back());
    text += fmt::format("{} of at most {} evaluations", history_->points.rows,
                        budget_of(options_));
    return {0, {}, text};
}

std::optional<study::Round> Optimisation::next_round(
    const std::vector<study::ItemAnswer>& answers) const {
    if (!history_ || history_->n_items > answers.size()) history_.emplace(start());
    follow(answers, *history_);
    const Matrix points = history_->optimiser.next_points();
    if (points.rows == 0) return std::nullopt;
    study::Round round{static_cast<int>(items_of(points.rows)),
                       {static_cast<double>(history_->points.rows)}};
    round.needed.insert(round.needed.end(), points.values.begin(), points.values.end());
    return round;
}

void Optimisation::begin_round(int first_item, const study::Round& round) {
    first_item_ = first_item;
    n_before_ = static_cast<std::size_t>(round.needed.at(0));
    points_.cols = goal_->parameters().size();
    points_.values.assign(round.needed.begin() + 1, round.needed.end());
    points_.rows = points_.values.size() / points_.cols;
}

/// The front's row nearest to the ideal of no error; of one objective the best point.
std::size_t best_row(const std::vector<optimise::Found>& found) {
    const auto size = [](const optimise::Found& each) {
        double sum = 0;
        for (const double value : each.objectives) sum += value * value;
        return sum;
    };
    return static_cast<std::size_t>(std::ranges::min_element(found, {}, size) -
                                    found.begin());
}

std::vector<double> at_bounds(const std::vector<physics::Parameter>& parameters,
                              std::span<const double> point) {
    std::vector<double> ends;
    ends.reserve(parameters.size());
    for (std::size_t k = 0; k < parameters.size(); ++k)
        ends.push_back(
            study::end_of_range(point[k], parameters[k].least, parameters[k].most));
    return ends;
}

void add_front(const optimise::Optimiser& optimiser, study::DatasetBuilder& datasets) {
    const Matrix points = optimiser.found_points();
    std::vector<double> values;
    std::size_t n_objectives = 0;
    for (const optimise::Found& found : optimiser.found()) {
        n_objectives = found.objectives.size();
        values.insert(values.end(), found.objectives.begin(), found.objectives.end());
    }
    datasets.array("front_parameters", {"front", "parameter"}, {points.rows, points.cols},
                   points.values);
    datasets.array("front_objective", {"front", "objective"}, {points.rows, n_objectives},
                   std::move(values));
}

/// What a building's readings say; an optimum of other targets is not handed on.
std::vector<study::Summary> summaries_of(const std::string& name, const Goal& goal,
                                         std::span<const double> best) {
    if (!goal.is_of_readings()) return {};
    study::Summary summary;
    summary.study = name;
    for (std::size_t k = 0; k < best.size(); ++k)
        summary.values.push_back({goal.parameters()[k].name, best[k], best[k], best[k]});
    summary.shortfall = goal.shortfall_of(best);
    return {std::move(summary)};
}

std::vector<double> Optimisation::best_point(
    const std::vector<study::ItemAnswer>& answers) const {
    History history = start();
    follow(answers, history);
    const Matrix found = history.optimiser.found_points();
    return goal_->in_simulator(found.row(best_row(history.optimiser.found())));
}

study::Conclusion Optimisation::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    History history = start();
    follow(answers, history);
    study::DatasetBuilder datasets(name_);
    datasets.kind("optimisation");
    datasets.parameters(goal_->parameters());
    datasets.texts("objective", "objective", goal_->objectives());
    datasets.texts("objective_unit", "objective", goal_->units());
    const std::size_t n = history.points.rows;
    datasets.scalar("n_points", static_cast<double>(n));
    datasets.array("points", {"point", "parameter"}, {n, history.points.cols},
                   history.points.values);
    datasets.array("point_objective", {"point", "objective"}, {n, history.values.cols},
                   history.values.values);
    datasets.vector("round_end", "round", history.round_end);
    if (!history.round_best.empty())
        datasets.vector("round_best", "round", history.round_best);
    add_front(history.optimiser, datasets);
    datasets.failures(history.failures);
    const std::size_t row = best_row(history.optimiser.found());
    if (!std::isfinite(history.optimiser.found()[row].objectives[0]))
        return {datasets.take(), {}};  // all points failed
    const Matrix found = history.optimiser.found_points();
    const auto best = found.row(row);
    datasets.vector("at_bound", "parameter", at_bounds(goal_->parameters(), best));
    goal_->describe(best, datasets);
    return {datasets.take(), summaries_of(name_, *goal_, best)};
}

}  // namespace

std::unique_ptr<study::Stage> make_optimisation(std::string name,
                                                const study::Case& building,
                                                const OptimisationOptions& options) {
    return std::make_unique<Optimisation>(
        std::move(name), std::make_unique<MeterGoal>(building, options), options);
}

std::unique_ptr<study::Stage> make_optimisation(std::string name, const TargetAim& aim,
                                                const OptimisationOptions& options) {
    OptimisationOptions own = options;
    if (aim.simulator->is_slow()) own.points_per_item = 1;
    return std::make_unique<Optimisation>(std::move(name),
                                          std::make_unique<TargetGoal>(aim, own), own);
}

}  // namespace bemcal::calibration
