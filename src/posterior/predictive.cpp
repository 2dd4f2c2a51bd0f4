/// Draws readings from a posterior: simulates some of its draws over a period, multiplies
/// energies by an unknown level, and draws each residual by its own residual model.
/// Follows from the posterior predictive distribution.
/// Impossible draws are left out; meters are drawn apart. What follows is in
/// `posterior_results`.
#include "posterior/predictive.hpp"

#include "base/error.hpp"
#include "sampling/normal.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::posterior {
namespace {

/// Rows without a NaN.
std::vector<std::size_t> possible_rows(const Matrix& simulated) {
    std::vector<std::size_t> rows;
    rows.reserve(simulated.rows);
    for (std::size_t r = 0; r < simulated.rows; ++r)
        if (simulated.cols > 0 && !std::isnan(simulated(r, 0))) rows.push_back(r);
    return rows;
}

std::vector<double> mean_of(const Matrix& simulated,
                            const std::vector<std::size_t>& rows) {
    std::vector<double> mean(simulated.cols, 0);
    for (const std::size_t r : rows)
        for (std::size_t k = 0; k < simulated.cols; ++k) mean[k] += simulated(r, k);
    for (double& value : mean) value /= static_cast<double>(rows.size());
    return mean;
}

/// What use and operation, of which nothing is known, make of an energy.
void change_level(const BuildingModel& model, std::size_t meter, double level_change,
                  Stream& random, std::vector<double>& energies) {
    const auto quantity = model.building().meters[model.meters()[meter].meter].quantity;
    if (level_change <= 0 || physics::is_temperature(quantity)) return;
    const double factor = std::exp(level_change * sampling::standard_normal(random));
    for (double& energy : energies) energy *= factor;
}

Matrix draw_readings(const BuildingModel& model, std::size_t meter,
                     const Matrix& simulated, const std::vector<std::size_t>& rows,
                     const Matrix& residuals, double level_change, Stream& random) {
    const MeterModel& of = model.meters()[meter];
    std::vector<double> normals(of.residuals.n_normals());
    Matrix draws(rows.size(), simulated.cols);
    for (std::size_t d = 0; d < rows.size(); ++d) {
        const auto row = simulated.row(rows[d]);
        std::vector<double> level(row.begin(), row.end());
        change_level(model, meter, level_change, random, level);
        sampling::fill_standard_normal(random, normals);
        const auto drawn = of.residuals.draw(
            level,
            residuals.row(rows[d]).subspan(model.first_residual_parameter(meter),
                                           of.unknowns.size()),
            normals);
        std::ranges::copy(drawn, draws.row(d).begin());
    }
    return draws;
}

}  // namespace

std::vector<MeterPrediction> predict_meters(const BuildingModel& model,
                                            const BuildingModel::Points& points,
                                            double level_change, Stream& random) {
    require(points.residuals.cols == model.n_residual_parameters(),
            "residuals of the model that they were drawn for");
    const auto nominal = model.predict(study::nominal_row(model.building().parameters));
    const auto simulated = model.predict(points.parameters);
    std::vector<MeterPrediction> predictions;
    predictions.reserve(simulated.size());
    for (std::size_t m = 0; m < simulated.size(); ++m) {
        const MeterModel& meter = model.meters()[m];
        const study::Meter& described = model.building().meters[meter.meter];
        const auto rows = possible_rows(simulated[m]);
        predictions.push_back({meter.name, meter.unit, described.quantity,
                               described.interval, meter.begins, meter.measured,
                               nominal[m].values, mean_of(simulated[m], rows),
                               draw_readings(model, m, simulated[m], rows,
                                             points.residuals, level_change, random)});
    }
    return predictions;
}

}  // namespace bemcal::posterior
