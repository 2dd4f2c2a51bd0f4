/// Runs a grid as a stage of the plan: a round is a stage's grid, an item a run of its
/// points. What a round needs is the grid itself; it follows from the answers alone.
/// Source: paper 3 (Basurra and Jankovic).
/// Which values survive, and the next grid, is decided in `grid_rounds`. A failed point
/// is NaN.
#include "calibration/grid.hpp"

#include "base/nan.hpp"
#include "calibration/grid_results.hpp"
#include "calibration/grid_rounds.hpp"
#include "study/failures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

std::size_t index_of(const std::vector<study::Output>& outputs, const std::string& name) {
    const auto found = std::ranges::find(outputs, name, &study::Output::name);
    if (found == outputs.end())
        throw std::invalid_argument(
            fmt::format("the simulator has no output \"{}\"", name));
    return static_cast<std::size_t>(found - outputs.begin());
}

/// Where the points of a round begin, then each axis with its size before it.
std::vector<double> pack(std::size_t first_point, const Grid& grid) {
    std::vector<double> packed{static_cast<double>(first_point)};
    for (const auto& axis : grid) {
        packed.push_back(static_cast<double>(axis.size()));
        packed.insert(packed.end(), axis.begin(), axis.end());
    }
    return packed;
}

Grid unpack(const std::vector<double>& packed) {
    Grid grid;
    for (auto at = packed.begin() + 1; at != packed.end();) {
        const auto size = static_cast<std::ptrdiff_t>(*at++);
        grid.emplace_back(at, at + size);
        at += size;
    }
    return grid;
}

class GridStudy : public study::Stage {
  public:
    GridStudy(std::string name, std::shared_ptr<const study::Simulator> simulator,
              const GridOptions& options)
        : name_(std::move(name)),
          simulator_(std::move(simulator)),
          beginning_(simulator_->parameters(), options),
          grid_(beginning_.first_grid()) {
        for (const GridTarget& target : options.targets)
            columns_.push_back(index_of(simulator_->outputs(), target.output));
    }

    std::string name() const override { return name_; }
    int n_items() const override { return n_items_of(beginning_.first_grid()); }
    /// Of the grids that are given.
    long long n_simulations() const override {
        std::size_t n = 0;
        for (const NamedGrid& named : options().grids)
            n += size_of(grid_of(simulator_->parameters(), named));
        return static_cast<long long>(n);
    }
    bool has_rounds() const override { return options().grids.size() > 1; }
    std::size_t answer_bytes() const override {
        return options().points_per_item * columns_.size() * sizeof(double);
    }
    study::ItemAnswer run(int item) const override;
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override;
    void begin_round(int first_item, const study::Round& round) override {
        first_item_ = first_item;
        first_point_ = static_cast<std::size_t>(round.needed.at(0));
        grid_ = unpack(round.needed);
    }
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    std::vector<double> best_point(
        const std::vector<study::ItemAnswer>& answers) const override;
    bool failures_may_pass() const override { return simulator_->failures_may_pass(); }
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override;

  private:
    const GridOptions& options() const { return beginning_.options(); }
    int n_items_of(const Grid& grid) const {
        const std::size_t n = options().points_per_item;
        return static_cast<int>((size_of(grid) + n - 1) / n);
    }
    GridRounds followed(const std::vector<study::ItemAnswer>& answers) const;
    Matrix outputs_of(const std::vector<study::ItemAnswer>& answers,
                      std::size_t first_item, std::size_t n_points) const;
    std::vector<study::Failure> failures_of(const std::vector<study::ItemAnswer>& answers,
                                            const GridRounds& rounds) const;

    std::string name_;
    std::shared_ptr<const study::Simulator> simulator_;
    GridRounds beginning_;              ///< without a stage
    std::vector<std::size_t> columns_;  ///< of the targets among the outputs
    Grid grid_;                         ///< of the round
    int first_item_ = 0;
    std::size_t first_point_ = 0;
};

study::ItemAnswer GridStudy::run(int item) const {
    const auto block = static_cast<std::size_t>(item - first_item_);
    const std::size_t first = block * options().points_per_item;
    const std::size_t n = std::min(options().points_per_item, size_of(grid_) - first);
    Matrix outputs;
    std::vector<std::string> failures;
    simulator_->evaluate(points_of(grid_, first, n), outputs, failures);
    study::ItemAnswer answer;
    answer.values.reserve(n * columns_.size());
    for (std::size_t r = 0; r < n; ++r) {
        for (const std::size_t column : columns_)
            answer.values.push_back(outputs(r, column));
    }
    answer.failures = study::failures_of_points(failures, first_point_ + first);
    return answer;
}

/// The rows of a stage; NaN where an item failed.
Matrix GridStudy::outputs_of(const std::vector<study::ItemAnswer>& answers,
                             std::size_t first_item, std::size_t n_points) const {
    Matrix outputs(n_points, columns_.size(), nan);
    const std::size_t step = options().points_per_item * columns_.size();
    for (std::size_t at = 0, item = first_item; at < outputs.values.size();
         at += step, ++item)
        std::ranges::copy(answers.at(item).values,
                          outputs.values.begin() + static_cast<std::ptrdiff_t>(at));
    return outputs;
}

/// The stages that the answers are of.
GridRounds GridStudy::followed(const std::vector<study::ItemAnswer>& answers) const {
    GridRounds rounds = beginning_;
    std::optional<Grid> grid = rounds.first_grid();
    for (std::size_t item = 0; item < answers.size() && grid;) {
        const auto n_items = static_cast<std::size_t>(n_items_of(*grid));
        Matrix outputs = outputs_of(answers, item, size_of(*grid));
        rounds.add(std::move(*grid), std::move(outputs));
        item += n_items;
        if (item < answers.size()) grid = rounds.next().grid;
    }
    return rounds;
}

std::optional<study::Round> GridStudy::next_round(
    const std::vector<study::ItemAnswer>& answers) const {
    const GridRounds rounds = followed(answers);
    const auto next = rounds.next();
    if (!next.grid) return std::nullopt;
    return study::Round{n_items_of(*next.grid), pack(rounds.n_points(), *next.grid)};
}

/// A point's own, and of each item that failed as a whole its points.
std::vector<study::Failure> GridStudy::failures_of(
    const std::vector<study::ItemAnswer>& answers, const GridRounds& rounds) const {
    std::vector<study::Failure> failures;
    std::size_t item = 0;
    for (const GridStage& stage : rounds.stages()) {
        const std::size_t n = stage.outputs.rows, step = options().points_per_item;
        for (std::size_t first = 0; first < n; first += step, ++item)
            study::append_failures(answers.at(item),
                                   {stage.first_point + first, std::min(step, n - first)},
                                   failures);
    }
    return failures;
}

/// The nearest of the last stage that has an answer, nearest first.
study::Summary summary_of(const std::string& name, const GridRounds& rounds) {
    study::Summary summary;
    summary.study = name;
    for (const physics::Parameter& parameter : rounds.parameters())
        summary.points.parameters.push_back(parameter.name);
    for (const GridStage& stage : rounds.stages()) {
        if (stage.selection.nearest.empty()) continue;
        Matrix& rows = summary.points.rows = Matrix(0, stage.grid.size());
        for (const std::size_t point : stage.selection.nearest) {
            const Matrix row = points_of(stage.grid, point, 1);
            rows.values.insert(rows.values.end(), row.values.begin(), row.values.end());
            ++rows.rows;
        }
    }
    return summary;
}

std::vector<double> GridStudy::best_point(
    const std::vector<study::ItemAnswer>& answers) const {
    const GridRounds rounds = followed(answers);
    const GridStage* best = rounds.best();
    if (best == nullptr) return {};
    return points_of(best->grid, best->nearest(), 1).values;
}

study::Conclusion GridStudy::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    const GridRounds rounds = followed(answers);
    std::vector<std::string> units;
    units.reserve(columns_.size());
    for (const std::size_t column : columns_)
        units.push_back(simulator_->outputs()[column].unit);
    return {grid_datasets(name_, rounds, units, failures_of(answers, rounds)),
            {summary_of(name_, rounds)}};
}

std::string GridStudy::shortfall(const std::vector<study::ItemAnswer>& answers) const {
    const GridRounds rounds = followed(answers);
    const GridStage* best = rounds.best();
    if (best == nullptr) return "no point was answered";
    const double error = best->error(best->nearest());
    if (options().target_error == 0 || error <= options().target_error) return {};
    return fmt::format(
        "the nearest of {} points is {:.3g} % off, more than target_error "
        "= {:g} %: {}",
        rounds.n_points(), error, options().target_error, rounds.next().reason);
}

}  // namespace

std::unique_ptr<study::Stage> make_grid(std::string name,
                                        std::shared_ptr<const study::Simulator> simulator,
                                        const GridOptions& options) {
    return std::make_unique<GridStudy>(std::move(name), std::move(simulator), options);
}

}  // namespace bemcal::calibration
