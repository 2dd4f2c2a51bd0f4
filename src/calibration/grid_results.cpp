/// Writes a grid's datasets: a group for each stage (points, errors, both selections,
/// what survives, indices), and what the stages add up to.
/// Follows from `GridRounds`.
/// Nothing is judged here: roles and the reason of the end are those of `grid_rounds`.
#include "calibration/grid_results.hpp"

#include "base/nan.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

std::vector<double> as_numbers(const std::vector<std::size_t>& indices) {
    return {indices.begin(), indices.end()};
}

/// Values of all parameters one after the other, and whose each is.
void add_axes(const Grid& grid, study::DatasetBuilder& datasets) {
    std::vector<double> values, parameters;
    for (std::size_t p = 0; p < grid.size(); ++p)
        for (const double value : grid[p]) {
            values.push_back(value);
            parameters.push_back(static_cast<double>(p));
        }
    datasets.vector("grid_value", "grid_value", std::move(values));
    datasets.vector("grid_parameter", "grid_value", std::move(parameters));
}

void add_points(const GridStage& stage, study::DatasetBuilder& datasets) {
    const std::size_t n = stage.outputs.rows;
    Matrix points = points_of(stage.grid, 0, n);
    datasets.array("grid_points", {"grid_point", "parameter"}, {n, points.cols},
                   std::move(points.values));
    datasets.array("target_output", {"grid_point", "target"}, {n, stage.outputs.cols},
                   stage.outputs.values);
    datasets.array("target_error", {"grid_point", "target"}, {n, stage.outputs.cols},
                   stage.errors.values);
    datasets.vector("distance", "grid_point", stage.distance);
    const auto& high = stage.selection.is_high_density;
    datasets.vector("is_high_density", "grid_point", {high.begin(), high.end()});
}

std::vector<double> counts_of(const Grid& grid) {
    std::vector<double> counts;
    counts.reserve(grid.size());
    for (const auto& axis : grid) counts.push_back(static_cast<double>(axis.size()));
    return counts;
}

std::vector<study::Dataset> stage_datasets(const std::string& name,
                                           const GridStage& stage) {
    study::DatasetBuilder datasets(name);
    add_axes(stage.grid, datasets);
    add_points(stage, datasets);
    datasets.vector("neighbour", "neighbour", as_numbers(stage.selection.nearest));
    datasets.vector("plain_neighbour", "plain_neighbour", as_numbers(stage.plain));
    datasets.scalar("crowding_radius", stage.selection.crowding.radius);
    datasets.scalar("crowding_threshold", stage.selection.crowding.threshold);
    datasets.vector("n_values", "parameter", counts_of(stage.grid));
    datasets.vector("n_surviving", "parameter", counts_of(stage.surviving));
    std::vector<std::string> roles;
    roles.reserve(stage.roles.size());
    for (const ParameterRole role : stage.roles) roles.emplace_back(words_of(role));
    datasets.texts("parameter_role", "parameter", std::move(roles));
    const Matrix& total = stage.total_order;
    const auto last = total.values.end() - static_cast<std::ptrdiff_t>(total.cols);
    datasets.array("grid_total_order", {"target", "parameter"},
                   {total.rows - 1, total.cols}, {total.values.begin(), last});
    datasets.vector("distance_total_order", "parameter", {last, total.values.end()});
    return datasets.take();
}

void add_targets(const GridRounds& rounds, const std::vector<std::string>& units,
                 study::DatasetBuilder& datasets) {
    std::vector<std::string> names;
    std::vector<double> measured;
    for (const GridTarget& target : rounds.options().targets) {
        names.push_back(target.output);
        measured.push_back(target.measured);
    }
    datasets.texts("target", "target", std::move(names));
    datasets.texts("target_unit", "target", units);
    datasets.vector("target_measured", "target", std::move(measured));
    datasets.vector("target_scale", "target", rounds.scales());
}

/// Each stage's points and its nearest.
void add_stages(const GridRounds& rounds, study::DatasetBuilder& datasets) {
    std::vector<double> n, distance, error, nearest_errors;
    for (const GridStage& stage : rounds.stages()) {
        const bool any = stage.has_answer();
        n.push_back(static_cast<double>(stage.outputs.rows));
        distance.push_back(any ? stage.distance[stage.nearest()] : nan);
        error.push_back(any ? stage.error(stage.nearest()) : nan);
        for (std::size_t t = 0; t < stage.errors.cols; ++t)
            nearest_errors.push_back(any ? stage.errors(stage.nearest(), t) : nan);
    }
    const std::size_t n_stages = n.size(), n_targets = rounds.options().targets.size();
    datasets.vector("stage_points", "grid_stage", std::move(n));
    datasets.vector("stage_distance", "grid_stage", std::move(distance));
    datasets.vector("stage_error", "grid_stage", std::move(error));
    datasets.array("stage_target_error", {"grid_stage", "target"}, {n_stages, n_targets},
                   std::move(nearest_errors));
}

/// The nearest point of all stages.
void add_best(const GridRounds& rounds, study::DatasetBuilder& datasets) {
    const GridStage* best = rounds.best();
    std::vector<double> point(rounds.parameters().size(), nan);
    if (best != nullptr) point = points_of(best->grid, best->nearest(), 1).values;
    datasets.vector("nearest_parameters", "parameter", std::move(point));
}

}  // namespace

std::vector<study::Dataset> grid_datasets(const std::string& name,
                                          const GridRounds& rounds,
                                          const std::vector<std::string>& units,
                                          const std::vector<study::Failure>& failures) {
    study::DatasetBuilder datasets(name);
    datasets.kind("grid");
    datasets.parameters(rounds.parameters());
    add_targets(rounds, units, datasets);
    add_stages(rounds, datasets);
    add_best(rounds, datasets);
    datasets.text("grid_distance", rounds.options().distance == GridDistance::euclidean
                                       ? "euclidean"
                                       : "scaled");
    datasets.text("ended_by", rounds.next().reason);
    datasets.scalar("target_error_wanted", rounds.options().target_error);
    datasets.scalar("budget", static_cast<double>(rounds.options().budget));
    datasets.scalar("threshold", rounds.options().index_threshold);
    datasets.failures(failures);
    std::vector<study::Dataset> all = datasets.take();
    for (std::size_t s = 0; s < rounds.stages().size(); ++s) {
        auto stage =
            stage_datasets(fmt::format("{}/stage_{}", name, s + 1), rounds.stages()[s]);
        std::ranges::move(stage, std::back_inserter(all));
    }
    return all;
}

}  // namespace bemcal::calibration
