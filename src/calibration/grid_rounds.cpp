/// Judges a stage of a grid and makes the next: errors in per cent, the k nearest plainly
/// and with density avoidance, values that survive, midpoints as the budget allows.
/// Source: paper 3 (Basurra and Jankovic). Whether one value is determined or insensitive
/// is our addition, by the total-order index (Saltelli et al. 2010, eq. 4).
/// For the index, failed points lie at the others' mean. Points are run by `grid`.
#include "calibration/grid_rounds.hpp"

#include "base/nan.hpp"
#include "stats/factorial_indices.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

/// A stage that comes no nearer than this share of the one before has stalled.
constexpr double stalled_share = 0.5;

Matrix errors_of(const Matrix& outputs, const std::vector<GridTarget>& targets) {
    Matrix errors(outputs.rows, outputs.cols);
    for (std::size_t r = 0; r < outputs.rows; ++r)
        for (std::size_t t = 0; t < outputs.cols; ++t)
            errors(r, t) = 100 * (outputs(r, t) - targets[t].measured) /
                           std::abs(targets[t].measured);
    return errors;
}

double norm(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum);
}

bool is_answered(std::span<const double> row) {
    return std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
}

/// Standard deviation of a column over the answered rows; 1 where it does not vary.
double spread_of(const Matrix& errors, std::size_t column) {
    double n = 0, sum = 0, square = 0;
    for (std::size_t r = 0; r < errors.rows; ++r) {
        if (!is_answered(errors.row(r))) continue;
        n += 1;
        sum += errors(r, column);
    }
    const double mean = sum / n;
    for (std::size_t r = 0; r < errors.rows; ++r)
        if (is_answered(errors.row(r))) square += std::pow(errors(r, column) - mean, 2);
    const double spread = std::sqrt(square / n);
    return spread > 0 ? spread : 1;
}

/// A column for the indices: failed points at the mean of the others.
std::vector<double> filled(std::vector<double> column) {
    double n = 0, sum = 0;
    for (const double x : column)
        if (std::isfinite(x)) {
            n += 1;
            sum += x;
        }
    for (double& x : column)
        if (!std::isfinite(x)) x = sum / n;
    return column;
}

/// The parameter's values at points of a grid, rising, each once.
std::vector<double> values_at(const Grid& grid, const std::vector<std::size_t>& points,
                              std::size_t n, std::size_t parameter) {
    std::set<double> values;
    for (std::size_t k = 0; k < std::min(n, points.size()); ++k)
        values.insert(points_of(grid, points[k], 1)(0, parameter));
    return {values.begin(), values.end()};
}

/// Whether an axis has a value that the other has not.
bool has_new_value(const Grid& grid, const Grid& before) {
    for (std::size_t p = 0; p < grid.size(); ++p)
        if (!std::ranges::includes(before[p], grid[p])) return true;
    return false;
}

void check_targets(const GridOptions& options) {
    if (options.targets.empty()) throw std::invalid_argument("there are no targets");
    for (const GridTarget& target : options.targets)
        if (!std::isfinite(target.measured) || target.measured == 0)
            throw std::invalid_argument(
                fmt::format("the target {} is {}: errors are in per cent of it; expected "
                            "a number other than 0",
                            target.output, target.measured));
}

}  // namespace

const char* words_of(ParameterRole role) {
    switch (role) {
        case ParameterRole::held:
            return "held";
        case ParameterRole::open:
            return "open";
        case ParameterRole::determined:
            return "determined";
        case ParameterRole::insensitive:
            return "insensitive";
    }
    return "";
}

double GridStage::error(std::size_t point) const {
    return norm(errors.row(point));
}

Grid grid_of(const std::vector<physics::Parameter>& parameters, const NamedGrid& named) {
    Grid grid;
    grid.reserve(parameters.size());
    for (const physics::Parameter& parameter : parameters)
        grid.push_back({parameter.nominal});
    for (const auto& [name, values] : named) {
        const auto found = std::ranges::find(parameters, name, &physics::Parameter::name);
        if (found == parameters.end())
            throw std::invalid_argument(fmt::format("there is no parameter {}", name));
        std::vector<double> axis = values;
        std::ranges::sort(axis);
        const bool is_good =
            !axis.empty() && std::ranges::adjacent_find(axis) == axis.end() &&
            std::ranges::all_of(axis, [](double x) { return std::isfinite(x); });
        if (!is_good)
            throw std::invalid_argument(fmt::format(
                "the values of {} are none, or one stands there twice", name));
        grid[static_cast<std::size_t>(found - parameters.begin())] = std::move(axis);
    }
    return grid;
}

GridRounds::GridRounds(std::vector<physics::Parameter> parameters, GridOptions options)
    : parameters_(std::move(parameters)), options_(std::move(options)) {
    check_targets(options_);
    if (options_.grids.empty()) throw std::invalid_argument("there is no first grid");
    std::size_t n = 0;
    for (const NamedGrid& named : options_.grids)
        n += size_of(grid_of(parameters_, named));
    if (n > static_cast<std::size_t>(options_.budget))
        throw std::invalid_argument(fmt::format(
            "the given grids have {} points, more than budget = {}", n, options_.budget));
}

void GridRounds::add(Grid grid, Matrix outputs) {
    GridStage stage;
    stage.first_point = n_points();
    stage.grid = std::move(grid);
    stage.outputs = std::move(outputs);
    measure(stage);
    select(stage);
    judge(stage);
    stages_.push_back(std::move(stage));
}

/// Errors and distances; the first stage sets the scales.
void GridRounds::measure(GridStage& stage) {
    stage.errors = errors_of(stage.outputs, options_.targets);
    const std::size_t n_targets = options_.targets.size();
    if (scales_.empty())
        for (std::size_t t = 0; t < n_targets; ++t)
            scales_.push_back(options_.distance == GridDistance::euclidean ? 1
                              : options_.targets[t].scale > 0
                                  ? options_.targets[t].scale
                                  : spread_of(stage.errors, t));
    stage.distance.assign(stage.errors.rows, nan);
    std::vector<double> scaled(n_targets);
    for (std::size_t r = 0; r < stage.errors.rows; ++r) {
        for (std::size_t t = 0; t < n_targets; ++t)
            scaled[t] = stage.errors(r, t) / scales_[t];
        if (is_answered(scaled)) stage.distance[r] = norm(scaled);
    }
}

/// The nearest among the answered points, both ways.
void GridRounds::select(GridStage& stage) const {
    const std::size_t n_targets = options_.targets.size();
    std::vector<std::size_t> answered;
    Matrix points(0, n_targets);
    for (std::size_t r = 0; r < stage.errors.rows; ++r) {
        if (!std::isfinite(stage.distance[r])) continue;
        answered.push_back(r);
        for (std::size_t t = 0; t < n_targets; ++t)
            points.values.push_back(stage.errors(r, t) / scales_[t]);
    }
    points.rows = answered.size();
    const std::vector<double> reference(n_targets, 0.0);
    stats::Selection found =
        stats::nearest_avoiding_density(points, reference, options_.nearest);
    stage.plain = stats::nearest(points, reference,
                                 stats::neighbour_count(options_.nearest, points.rows));
    stage.selection.crowding = found.crowding;
    stage.selection.is_high_density.assign(stage.errors.rows, 0);
    for (std::size_t k = 0; k < answered.size(); ++k)
        stage.selection.is_high_density[answered[k]] = found.is_high_density[k];
    for (std::size_t& index : found.nearest) index = answered[index];
    for (std::size_t& index : stage.plain) index = answered[index];
    stage.selection.nearest = std::move(found.nearest);
}

/// What survives, the indices over the stage's grid, and what became of each parameter.
void GridRounds::judge(GridStage& stage) const {
    const std::size_t d = parameters_.size(), n_targets = options_.targets.size();
    stage.total_order = Matrix(n_targets + 1, d, nan);
    stage.roles.assign(d, ParameterRole::held);
    stage.surviving.resize(d);
    if (!stage.has_answer()) return;
    for (std::size_t t = 0; t <= n_targets; ++t) {
        std::vector<double> column = stage.distance;
        for (std::size_t r = 0; t < n_targets && r < column.size(); ++r)
            column[r] = stage.errors(r, t);
        const auto indices =
            stats::total_order_on_grid(stage.grid, filled(std::move(column)));
        std::ranges::copy(indices, stage.total_order.row(t).begin());
    }
    const auto& nearest = stage.selection.nearest;
    for (std::size_t p = 0; p < d; ++p) {
        stage.surviving[p] = values_at(stage.grid, nearest, nearest.size(), p);
        bool matters = false;
        for (std::size_t t = 0; t <= n_targets; ++t)
            matters = matters || stage.total_order(t, p) > options_.index_threshold;
        stage.roles[p] = stage.grid[p].size() == 1       ? ParameterRole::held
                         : stage.surviving[p].size() > 1 ? ParameterRole::open
                         : matters                       ? ParameterRole::determined
                                                         : ParameterRole::insensitive;
    }
}

std::size_t GridRounds::n_points() const {
    return stages_.empty() ? 0 : stages_.back().first_point + stages_.back().outputs.rows;
}

const GridStage* GridRounds::best() const {
    const GridStage* best = nullptr;
    for (const GridStage& stage : stages_)
        if (stage.has_answer() &&
            (best == nullptr ||
             stage.distance[stage.nearest()] < best->distance[best->nearest()]))
            best = &stage;
    return best;
}

GridRounds::Next GridRounds::next() const {
    const auto n_done = stages_.size();
    const GridStage* nearest = best();
    if (nearest != nullptr && nearest->error(nearest->nearest()) <= options_.target_error)
        return {std::nullopt, "the target error is reached"};
    if (n_done >= static_cast<std::size_t>(options_.most_stages))
        return {std::nullopt, "all stages are done"};
    if (n_done < options_.grids.size())
        return {grid_of(parameters_, options_.grids[n_done]), {}};
    if (!stages_.back().has_answer()) return {std::nullopt, "no point was answered"};
    std::optional<Grid> grid = refined();
    if (!grid) return {std::nullopt, "no refinement fits into the budget"};
    if (!has_new_value(*grid, stages_.back().grid))
        return {std::nullopt, "no parameter has a new value to try"};
    return {std::move(grid), {}};
}

bool GridRounds::has_stalled() const {
    const std::size_t n = stages_.size();
    if (n < 2 || !stages_[n - 2].has_answer()) return false;
    const GridStage &last = stages_[n - 1], &before = stages_[n - 2];
    return last.distance[last.nearest()] >
           stalled_share * before.distance[before.nearest()];
}

/// Determined parameters, where a stage has stalled or nothing is open.
std::vector<char> GridRounds::set_free() const {
    std::vector<char> is_free(parameters_.size(), 0);
    const bool any_open =
        std::ranges::count(stages_.back().roles, ParameterRole::open) > 0;
    if (any_open && !has_stalled()) return is_free;
    for (std::size_t p = 0; p < is_free.size(); ++p)
        for (const GridStage& stage : stages_)
            if (stage.roles[p] != ParameterRole::held)
                is_free[p] = stage.roles[p] == ParameterRole::determined ? 1 : 0;
    return is_free;
}

/// Values of the nearest n_kept, with midpoints; fixed ones at their value, free ones
/// with midpoints on the axis on which they last varied.
Grid GridRounds::refined_by(std::size_t n_kept, const std::vector<char>& is_free) const {
    const GridStage& last = stages_.back();
    Grid grid(parameters_.size());
    for (std::size_t p = 0; p < grid.size(); ++p) {
        const physics::Parameter& parameter = parameters_[p];
        const bool is_discrete =
            std::ranges::count(options_.discrete, parameter.name) > 0;
        const Room room{parameter.least, parameter.most, !is_discrete};
        const std::vector<double> kept =
            values_at(last.grid, last.selection.nearest, n_kept, p);
        grid[p] = last.surviving[p];
        if (last.roles[p] == ParameterRole::open) {
            grid[p] = with_midpoints(last.grid[p], kept, room);
        } else if (is_free[p] != 0) {
            const auto varied = std::ranges::find_if(
                stages_.rbegin(), stages_.rend(), [&](const GridStage& stage) {
                    return stage.roles[p] != ParameterRole::held;
                });
            grid[p] = with_midpoints(varied->grid[p], kept, room);
        }
    }
    return grid;
}

/// The largest refinement that the budget allows: of all selected, else of the nearest of
/// them, in the last resort without what was set free.
std::optional<Grid> GridRounds::refined() const {
    const auto left = static_cast<std::size_t>(options_.budget) - n_points();
    const std::vector<char> none(parameters_.size(), 0);
    for (const auto& is_free : {set_free(), none})
        for (std::size_t n = stages_.back().selection.nearest.size(); n > 0; --n)
            if (Grid grid = refined_by(n, is_free);
                size_of(grid) <= left && has_new_value(grid, stages_.back().grid))
                return grid;
    return std::nullopt;
}

}  // namespace bemcal::calibration
