/// Writes functions that were sampled: what was declared and the columns' draws together,
/// at each point.
/// Follows from study/sampled_shapes. Left out: what they are between two points, and
/// how points hang together, which the draws have.
#include "posterior/function_results.hpp"

#include "base/nan.hpp"
#include "effects/driver_functions.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::posterior {
namespace {

constexpr double low = 0.05, high = 0.95;

/// [draws x points]
Matrix values_of(const study::SampledFunction& function,
                 const study::FoundPoints& draws) {
    const auto name = std::ranges::find(draws.parameters, function.size_name());
    const auto first = static_cast<std::size_t>(name - draws.parameters.begin()) + 1;
    Matrix values(draws.rows.rows, function.values.size());
    for (std::size_t r = 0; r < values.rows; ++r)
        for (std::size_t p = 0; p < values.cols; ++p) {
            double sum = function.values[p];
            for (std::size_t c = 0; c < function.columns.cols; ++c)
                sum += draws.rows(r, first + c) * function.columns(p, c);
            values(r, p) = sum;
        }
    return values;
}

/// Columns of the table of points.
struct PointTable {
    std::vector<double> of, at, and_at, value, least, most;

    void add(double index, const study::SampledFunction& function, const Matrix& values) {
        const auto places = function.points.drivers_at();
        std::vector<double> column(values.rows);
        for (std::size_t p = 0; p < values.cols; ++p) {
            for (std::size_t r = 0; r < values.rows; ++r) column[r] = values(r, p);
            std::ranges::sort(column);
            of.push_back(index);
            at.push_back(places[0][p]);
            and_at.push_back(places.size() > 1 ? places[1][p] : nan);
            value.push_back(std::accumulate(column.begin(), column.end(), 0.0) /
                            static_cast<double>(column.size()));
            least.push_back(stats::quantile_of_sorted(column, low));
            most.push_back(stats::quantile_of_sorted(column, high));
        }
    }
};

}  // namespace

void add_functions(const std::vector<study::SampledFunction>& functions,
                   const study::FoundPoints& draws, study::DatasetBuilder& datasets) {
    if (functions.empty() || draws.rows.rows == 0) return;
    std::vector<std::string> names, hooks, drivers, units, driver_units;
    PointTable points;
    for (const study::SampledFunction& function : functions) {
        points.add(static_cast<double>(names.size()), function,
                   values_of(function, draws));
        names.push_back(function.name);
        hooks.push_back(function.hook);
        drivers.push_back(function.driver);
        units.push_back(function.unit);
        driver_units.push_back(effects::unit_of_driver(function.driver));
    }
    datasets.texts("function", "function", std::move(names));
    datasets.texts("function_hook", "function", std::move(hooks));
    datasets.texts("function_driver", "function", std::move(drivers));
    datasets.texts("function_unit", "function", std::move(units));
    datasets.texts("function_driver_unit", "function", std::move(driver_units));
    const auto add = [&](const char* leaf, std::vector<double> values) {
        datasets.vector(leaf, "function_point", std::move(values));
    };
    add("function_point_of", std::move(points.of));
    add("function_point_at", std::move(points.at));
    add("function_point_and_at", std::move(points.and_at));
    add("function_point_value", std::move(points.value));
    add("function_point_least", std::move(points.least));
    add("function_point_most", std::move(points.most));
}

}  // namespace bemcal::posterior
