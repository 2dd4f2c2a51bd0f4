/// Takes a study's points, and counts hours outside the limits of comfort.
/// Follows from `FoundPoints`: columns by their names.
/// Nothing is drawn: points are evenly spread over those that there are.
#include "retrofit/setting.hpp"

#include "study/points.hpp"
#include "study/some_draws.hpp"

#include <algorithm>

namespace bemcal::retrofit {
namespace {

/// A thermostat holds its set-point but for rounding: nearer than this is not outside.
constexpr double tolerance = 0.05;  // [K]

}  // namespace

void count(const Setting& setting, double temperature, double hours, ComfortHours& to) {
    if (temperature < setting.too_cold - tolerance) to.too_cold += hours;
    if (temperature > setting.too_warm + tolerance) to.too_warm += hours;
}

Matrix points_in(const study::Summary* found,
                 const std::vector<physics::Parameter>& parameters) {
    if (found == nullptr) return {0, parameters.size()};
    const auto& [names, rows] = found->points;
    Matrix points = study::nominal_points(parameters, rows.rows);
    for (std::size_t k = 0; k < points.cols; ++k) {
        const auto name = std::ranges::find(names, parameters[k].name);
        if (name == names.end()) continue;
        const auto column = static_cast<std::size_t>(name - names.begin());
        for (std::size_t r = 0; r < rows.rows; ++r) points(r, k) = rows(r, column);
    }
    return points;
}

Matrix some_of(const Matrix& points, int n_points) {
    Matrix some(0, points.cols);
    for (const std::size_t row : study::chosen_rows(points.rows, n_points))
        some.add_row(points.row(row));
    return some;
}

}  // namespace bemcal::retrofit
