/// Rounds of runs, then chains:
///
///     design       Sobol points of the parameters' ranges
///     posterior    points that short chains draw from the posterior so far, three times
///     chains       on the emulator of all runs, as of any posterior
///
/// Source: Higdon, Gattiker, Williams and Rightley 2008 for the emulator; runs where the
/// posterior is: Kandasamy, Schneider and Poczos 2017, Artificial Intelligence 243.
/// How the budget is shared is judgement. A run that fails is told and left out; it is
/// taken to fail by chance, and its neighbourhood is emulated from other runs.
#include "posterior/simulator_posterior.hpp"

#include "emulator/series_emulator.hpp"
#include "posterior/chain_draws.hpp"
#include "posterior/chain_stage.hpp"
#include "posterior/emulated_meters.hpp"
#include "posterior/posterior.hpp"
#include "posterior/posterior_results.hpp"
#include "sampling/normal.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/datasets.hpp"
#include "study/packed_matrix.hpp"
#include "study/points.hpp"
#include "study/runs_budget.hpp"
#include "study/simulated_hours.hpp"
#include "study/simulator_run.hpp"
#include "study/some_draws.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

using study::SimulatorRun;

constexpr std::uint32_t reach_stream = 0x72656163;
/// As a share of a parameter's range: next runs reach at least so far about a draw, or
/// they would tell the emulator no slope.
constexpr double least_reach = 0.02;

/// Points over which the emulator's variance is a mean, before anything is drawn.
constexpr std::size_t n_first_points = 64;
/// Times that the posterior and the emulator's variance over it are found anew.
constexpr int n_passes = 2;

/// Short chains, to draw next runs from.
ChainOptions chains_between(ChainOptions chains, std::size_t round) {
    chains.sampler = {};
    chains.sampler.n_warm_up = 200;
    chains.n_chains = chains.chains_per_item = 4;
    chains.first_chain = 0;
    chains.draws_per_round = chains.most_draws = 50;
    chains.seed += round;  // other chains than the last ones
    return chains;
}

Matrix row_of(const std::vector<double>& values) {
    Matrix row(1, values.size());
    row.values = values;
    return row;
}

/// Runs that did not fail.
struct UsedRuns {
    Matrix points;  ///< [runs x chosen parameters] on the scale 0 to 1
    Matrix series;  ///< [runs x readings of all periods]
};

using EmulatorPointer = std::shared_ptr<const emulator::SeriesEmulator>;
using PosteriorPointer = std::shared_ptr<const Posterior>;

/// What short chains say.
struct SoFar {
    Matrix points;                 ///< [draws x parameters] on the scale 0 to 1
    std::vector<double> variance;  ///< of the emulator over them [components]
};

/// Those of the simulator that have readings to learn from, as the job has them.
std::vector<std::string> meters_with_readings(const study::Case& building,
                                              const study::HourlySimulator& simulator,
                                              const PosteriorOptions& options) {
    if (!options.meters.empty()) return options.meters;
    std::vector<std::string> names;
    const auto readings =
        study::readings_of(building, training_period(building, options));
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        const std::string& name = building.meters[m].name;
        if (std::ranges::find(simulator.meters(), name) != simulator.meters().end() &&
            study::has_reading(readings[m].values))
            names.push_back(name);
    }
    if (names.empty())
        throw std::invalid_argument("building " + building.name +
                                    " has no reading in its training period");
    return names;
}

std::vector<std::size_t> numbers_of(const study::Case& building,
                                    const std::vector<std::string>& names) {
    std::vector<std::size_t> numbers;
    for (std::size_t m = 0; m < building.meters.size(); ++m)
        if (std::ranges::find(names, building.meters[m].name) != names.end())
            numbers.push_back(m);
    return numbers;
}

class SimulatorPosterior : public study::Stage {
  public:
    SimulatorPosterior(std::string name, const study::Case& building,
                       std::shared_ptr<const study::HourlySimulator> simulator,
                       const PosteriorOptions& options)
        : name_(std::move(name)),
          building_(building),
          simulator_(std::move(simulator)),
          options_(options),
          budget_(options.simulator_runs),
          n_hours_(study::hours_of_periods(building)) {
        options_.meters = meters_with_readings(building_, *simulator_, options_);
        for (const std::string& meter : options_.meters)
            study::column_of(*simulator_, meter);  // or it throws
        layout_ = std::make_unique<const SeriesLayout>(
            building_, numbers_of(building_, options_.meters));
        for (const std::size_t m : layout_->meters())
            columns_.push_back(study::column_of(*simulator_, building_.meters[m].name));
        const auto& all = simulator_->parameters();
        for (std::size_t k = 0; k < all.size(); ++k)
            if (options.parameters.empty() ||
                std::ranges::find(options.parameters, all[k].name) !=
                    options.parameters.end()) {
                places_.push_back(k);
                parameters_.push_back(all[k]);
            }
        options_.parameters.clear();
        const std::size_t least = emulator::least_runs(parameters_.size());
        if (static_cast<std::size_t>(budget_.design()) < least)
            throw std::invalid_argument(fmt::format(
                "runs = {} has a design of {} runs for {} parameters; expected runs = {} "
                "or more",
                options.simulator_runs, budget_.design(), parameters_.size(), 2 * least));
    }

    std::string name() const override { return name_; }
    int n_items() const override { return budget_.design(); }
    long long n_simulations() const override { return budget_.all(); }
    const char* counts() const override { return "runs"; }
    bool has_rounds() const override { return true; }
    const char* items_are() const override { return chains_ ? "items" : "runs"; }
    std::size_t answer_bytes() const override {
        return sizeof(double) * n_hours_ * columns_.size();
    }
    bool failures_may_pass() const override { return true; }
    study::Activity activity() const override {
        return chains_ ? chains_->activity() : study::Activity{};
    }

    study::ItemAnswer run(int item) const override {
        if (item >= budget_.all()) return chains_->run(item - budget_.all());
        if (next_.rows > 0) {
            const auto point = next_.row(static_cast<std::size_t>(item - first_item_));
            return simulate({point.begin(), point.end()});
        }
        return simulate(sobol_points(static_cast<std::size_t>(item), 1).values);
    }

    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        if (chains_) return chains_->next_round(of_chains(answers));
        const UsedRuns used = used_of(answers);
        if (!are_enough(used)) return std::nullopt;
        study::Round round;
        const EmulatorPointer emulator = emulator_of(used);
        const SoFar so_far = look_at(emulator, answers.size());
        if (answers.size() < n_runs()) {
            round.n_items = budget_.of_round();
            study::pack(next_points(so_far, answers.size()), round.needed);
        } else {
            round.n_items = make_chains(emulator, so_far.variance)->n_items();
            study::pack(used.points, round.needed);
            study::pack(used.series, round.needed);
            study::pack(row_of(so_far.variance), round.needed);
        }
        return round;
    }
    void begin_round(int first_item, const study::Round& round) override {
        if (chains_) return chains_->begin_round(first_item - budget_.all(), round);
        std::span<const double> packed = round.needed;
        first_item_ = first_item;
        next_ = study::take_matrix(packed);
        if (packed.empty()) return;
        const UsedRuns used{next_, study::take_matrix(packed)};
        chains_ = make_chains(emulator_of(used), study::take_matrix(packed).values);
    }

    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        study::Conclusion conclusion;
        if (chains_) conclusion = chains_->conclude(of_chains(answers));
        study::DatasetBuilder more(name_);
        if (!chains_) more.kind("posterior");
        add_runs(answers, more);
        std::ranges::move(more.take(), std::back_inserter(conclusion.datasets));
        return conclusion;
    }
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        if (chains_) return chains_->shortfall(of_chains(answers));
        return "too few runs of the simulator succeeded for a posterior";
    }

  private:
    std::size_t n_runs() const { return static_cast<std::size_t>(budget_.all()); }

    Matrix sobol_points(std::size_t first, std::size_t n) const {
        return stats::scrambled_sobol_points(
            first, n, static_cast<int>(parameters_.size()), options_.chains.seed);
    }
    /// \param point  [chosen parameters] on the scale 0 to 1
    study::ItemAnswer simulate(std::vector<double> point) const {
        const std::vector<double> values = values_at(point);
        return study::simulate(*simulator_,
                               {std::move(point),
                                {},
                                study::AskedPeriods(building_.periods.size(), 1),
                                {},
                                {},
                                {}},
                               values, {}, columns_, building_.periods);
    }
    /// Of all of the program's parameters; those that are not chosen are nominal.
    std::vector<double> values_at(std::span<const double> point) const {
        std::vector<double> values;
        values.reserve(simulator_->parameters().size());
        for (const physics::Parameter& parameter : simulator_->parameters())
            values.push_back(parameter.nominal);
        const std::vector<double> chosen = study::values_at(point, parameters_);
        for (std::size_t k = 0; k < places_.size(); ++k) values[places_[k]] = chosen[k];
        return values;
    }

    std::vector<SimulatorRun> runs_in(
        const std::vector<study::ItemAnswer>& answers) const {
        std::vector<SimulatorRun> runs;
        for (std::size_t k = 0; k < std::min(answers.size(), n_runs()); ++k)
            runs.push_back(study::run_in(answers[k], parameters_.size()));
        return runs;
    }
    UsedRuns used_of(const std::vector<study::ItemAnswer>& answers) const {
        UsedRuns used;
        for (const SimulatorRun& run : runs_in(answers)) {
            if (!run.failure.empty()) continue;
            used.points.add_row(run.point);
            used.series.add_row(layout_->series(building_, run.hours));
        }
        return used;
    }
    bool are_enough(const UsedRuns& used) const {
        return used.points.rows >= emulator::least_runs(parameters_.size());
    }

    EmulatorPointer emulator_of(const UsedRuns& used) const {
        return std::make_shared<const emulator::SeriesEmulator>(
            used.points, used.series, layout_->weights(building_), study::share_emulated);
    }
    PosteriorPointer posterior_of(EmulatorPointer emulator,
                                  std::vector<double> variance) const {
        const study::Case emulated =
            with_parameters(building_, parameters_, emulator->n_components());
        return make_posterior_through(
            emulated_meters(*layout_, std::move(emulator), std::move(variance)), emulated,
            options_);
    }
    std::unique_ptr<study::Stage> make_chains(EmulatorPointer emulator,
                                              std::vector<double> variance) const {
        return make_chain_stage(name_,
                                posterior_of(std::move(emulator), std::move(variance)),
                                options_.chains);
    }

    /// The emulator's variance over the posterior, which follows from it.
    SoFar look_at(const EmulatorPointer& emulator, std::size_t n_so_far) const {
        SoFar so_far{sobol_points(0, n_first_points), {}};
        for (int pass = 0; pass < n_passes; ++pass) {
            const auto posterior =
                posterior_of(emulator, mean_variance(*emulator, so_far.points));
            Matrix points =
                points_of(*posterior,
                          draws_of(posterior, chains_between(options_.chains, n_so_far)));
            if (points.rows > 0) so_far.points = std::move(points);
        }
        so_far.variance = mean_variance(*emulator, so_far.points);
        return so_far;
    }
    /// All rounds of some chains, here and now.
    ChainDraws draws_of(PosteriorPointer posterior, const ChainOptions& chains) const;
    /// [draws x parameters] on the scale 0 to 1
    Matrix points_of(const Posterior& posterior, const ChainDraws& draws) const {
        Matrix points(draws.positions.rows, parameters_.size());
        std::vector<double> values(posterior.unknowns().size());
        for (std::size_t r = 0; r < points.rows; ++r) {
            posterior.read(draws.positions.row(r), values);
            for (std::size_t k = 0; k < points.cols; ++k)
                points(r, k) = study::on_scale(values[k], parameters_[k]);
        }
        return points;
    }
    /// Some of the draws, each moved by a little. [runs x parameters]
    Matrix next_points(const SoFar& so_far, std::size_t n_so_far) const {
        Matrix points(static_cast<std::size_t>(budget_.of_round()), parameters_.size());
        const auto rows = study::chosen_rows(so_far.points.rows, budget_.of_round());
        Stream random(options_.chains.seed, reach_stream, n_so_far);
        for (std::size_t r = 0; r < points.rows; ++r)
            for (std::size_t k = 0; k < points.cols; ++k)
                points(r, k) =
                    std::clamp(so_far.points(rows[r % rows.size()], k) +
                                   least_reach * sampling::standard_normal(random),
                               0.0, 1.0);
        return points;
    }

    std::vector<study::ItemAnswer> of_chains(
        const std::vector<study::ItemAnswer>& answers) const {
        return {answers.begin() + budget_.all(), answers.end()};
    }

    void add_runs(const std::vector<study::ItemAnswer>& answers,
                  study::DatasetBuilder& datasets) const;

    std::string name_;
    study::Case building_;
    std::shared_ptr<const study::HourlySimulator> simulator_;
    PosteriorOptions options_;
    study::RunsBudget budget_;
    std::size_t n_hours_;
    std::unique_ptr<const SeriesLayout> layout_;
    std::vector<std::size_t> columns_;  ///< of the simulator's meters
    std::vector<std::size_t> places_;   ///< of the parameters among the simulator's
    std::vector<physics::Parameter> parameters_;  ///< that are calibrated
    Matrix next_;                                 ///< of this round; empty = the design
    int first_item_ = 0;
    std::unique_ptr<study::Stage> chains_;  ///< once the runs are there
};

ChainDraws SimulatorPosterior::draws_of(PosteriorPointer posterior,
                                        const ChainOptions& chains) const {
    const ChainLayout layout{chains.n_chains, chains.chains_per_item,
                             posterior->make_density()->dimension()};
    const auto stage = make_chain_stage(name_, std::move(posterior), chains);
    std::vector<study::ItemAnswer> answers;
    for (int left = stage->n_items(); left > 0;) {
        const auto first = static_cast<int>(answers.size());
        for (int k = 0; k < left; ++k) answers.push_back(stage->run(first + k));
        const auto round = stage->next_round(answers);
        left = round ? round->n_items : 0;
        if (round) stage->begin_round(static_cast<int>(answers.size()), *round);
    }
    return gather_draws(layout, chains.first_chain, answers);
}

void SimulatorPosterior::add_runs(const std::vector<study::ItemAnswer>& answers,
                                  study::DatasetBuilder& datasets) const {
    study::MadeRuns made;
    for (const SimulatorRun& run : runs_in(answers)) {
        const auto design = static_cast<std::size_t>(budget_.design());
        made.of.emplace_back(made.of.size() < design ? "design" : "posterior");
        made.failures.push_back(run.failure);
        const std::vector<double> at = study::values_at(run.point, parameters_);
        made.values.insert(made.values.end(), at.begin(), at.end());
    }
    study::add_made_runs(parameters_, std::move(made), datasets);
    const UsedRuns used = used_of(answers);
    if (!are_enough(used)) return;
    datasets.texts("simulator_channel", "simulator_channel", options_.meters);
    datasets.vector("simulator_emulator_error", "simulator_channel",
                    emulator_of(used)->leave_one_out(layout_->ranges(
                        building_, training_period(building_, options_))));
}

}  // namespace

std::unique_ptr<study::Stage> make_simulator_posterior(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator,
    const PosteriorOptions& options) {
    return std::make_unique<SimulatorPosterior>(std::move(name), building,
                                                std::move(simulator), options);
}

}  // namespace bemcal::posterior
