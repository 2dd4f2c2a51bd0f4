/// Holds a building against its meters over a period: simulates points, adds up the
/// meters' log likelihoods, and pulls their derivatives back to the parameters.
/// Source: `ResidualModel` for residuals, the adjoint of a `MeterResponse` for
/// derivatives. Priors of the residuals stand here. Errors of meters count as independent
/// of each other; those of months and years have no memory.
#include "posterior/building_model.hpp"

#include "base/nan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace bemcal::posterior {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_named(const MeterChoice& choice, const study::Meter& meter) {
    return std::ranges::find(choice.names, meter.name) != choice.names.end();
}

void check_names(const study::Case& building, const MeterChoice& choice) {
    for (const std::string& name : choice.names)
        if (std::ranges::none_of(building.meters, [&](const study::Meter& meter) {
                return meter.name == name;
            }))
            throw std::invalid_argument(building.name + " has no meter \"" + name + "\"");
}

std::vector<double> training_readings(const std::vector<double>& values,
                                      const MeterChoice& choice, std::size_t meter) {
    std::vector<double> kept = values;
    if (meter >= choice.trains.size() || choice.trains[meter].empty()) return kept;
    for (std::size_t k = 0; k < kept.size(); ++k)
        if (!choice.trains[meter][k]) kept[k] = nan;
    return kept;
}

/// Few readings tell nothing of how their residuals hang together.
stats::ResidualOptions options_for(physics::Interval interval,
                                   const stats::ResidualOptions& wanted) {
    stats::ResidualOptions options = wanted;
    if (interval == physics::Interval::monthly || interval == physics::Interval::annual)
        options.autocorrelated = options.discrepancy = false;
    return options;
}

std::vector<MeterModel> meter_models(const study::Case& building,
                                     const study::Period& period,
                                     const MeterChoice& choice) {
    check_names(building, choice);
    const auto readings = study::readings_of(building, period);
    std::vector<MeterModel> models;
    for (std::size_t m = 0; m < readings.size(); ++m) {
        const study::Meter& meter = building.meters[m];
        if (choice.names.empty() ? !study::has_reading(readings[m].values)
                                 : !is_named(choice, meter))
            continue;
        const auto options = options_for(meter.interval, choice.residuals);
        const double scale = choice.scales.empty()
                                 ? study::noise_scale(meter.quantity, readings[m].values)
                                 : choice.scales.at(models.size());
        models.push_back(
            {m,
             meter.name,
             physics::unit_of(meter.quantity),
             scale,
             study::begins_of(study::axis_of(building, period), meter.interval),
             readings[m].values,
             {training_readings(readings[m].values, choice, m), scale, options},
             residual_unknowns(meter, options)});
    }
    return models;
}

std::vector<std::size_t> numbers_of(const std::vector<MeterModel>& meters) {
    std::vector<std::size_t> numbers;
    numbers.reserve(meters.size());
    for (const MeterModel& model : meters) numbers.push_back(model.meter);
    return numbers;
}

stats::Prior beta(double a, double b) {
    stats::Prior prior;
    prior.kind = stats::PriorKind::beta;
    prior.a = a;
    prior.b = b;
    prior.least = 0;
    prior.most = 1;
    return prior;
}

/// Of the scale: where readings and predictions are both 0, as of a plant that is off,
/// the density would grow without bound as the constant part goes to 0.
constexpr double least_constant = 0.01;

/// Of the residuals' variance: a slow error of up to a third of their standard deviation.
/// A larger one takes over the level that the parameters should explain.
constexpr double largest_slow_share = 0.1;

/// A fortnight, in readings.
double fortnight(physics::Interval interval) {
    return interval == physics::Interval::daily ? 14 : 14 * 24;
}

stats::Prior residual_prior(const std::string& name, const study::Meter& meter,
                            const stats::ResidualOptions& options) {
    const bool is_air = physics::is_temperature(meter.quantity);
    if (name == "constant")
        return stats::lognormal_prior(study::usual_constant(meter.quantity), 1,
                                      least_constant);
    if (name == "proportional")
        return is_air || !options.proportional ? stats::fixed_prior(0)
                                               : stats::lognormal_prior(0.1, 1);
    if (name == "phi") return beta(1, 1);
    if (name == "share") return stats::uniform_prior(0, largest_slow_share);
    return stats::lognormal_prior(fortnight(meter.interval), 0.7);
}

}  // namespace

std::vector<study::Coordinate> residual_unknowns(const study::Meter& meter,
                                                 const stats::ResidualOptions& options) {
    std::vector<study::Coordinate> unknowns;
    for (const std::string& name : stats::residual_parameters(options))
        unknowns.push_back({meter.name + "_" + name,
                            name == "timescale" ? "readings" : "-",
                            residual_prior(name, meter, options)});
    return unknowns;
}

BuildingModel::BuildingModel(const study::Case& building, const study::Period& period,
                             const MeterChoice& choice,
                             std::shared_ptr<const ResponseSource> source)
    : building_(building),
      source_(std::move(source)),
      meters_(meter_models(building_, period, choice)),
      response_(source_->response(building_, period, numbers_of(meters_))) {}

std::size_t BuildingModel::first_residual_parameter(std::size_t meter) const {
    std::size_t first = 0;
    for (std::size_t m = 0; m < meter; ++m) first += meters_[m].unknowns.size();
    return first;
}

BuildingModel::Work BuildingModel::make_work() const {
    return {response_->make_run(), {}, {}, {}, {}};
}

void BuildingModel::evaluate(const Points& points, bool derivatives, Likelihood& out,
                             Work& work) const {
    const std::size_t n = points.parameters.rows;
    out.value.assign(n, 0);
    out.by_parameter = Matrix(n, n_parameters());
    out.by_residual = Matrix(n, n_residual_parameters());
    for (std::size_t first = 0; first < n; first += static_cast<std::size_t>(lanes()))
        evaluate_group(points, first, derivatives, out, work);
}

void BuildingModel::evaluate_group(const Points& points, std::size_t first,
                                   bool derivatives, Likelihood& out, Work& work) const {
    const std::size_t count =
        std::min(points.parameters.rows - first, static_cast<std::size_t>(lanes()));
    const auto failures = response_->predict(points.parameters, first, count, *work.run);
    for (std::size_t meter = 0; meter < meters_.size(); ++meter)
        add_meter(meter, points, first, derivatives, out, work);
    if (derivatives) {
        Matrix gradient(count, n_parameters());
        response_->pull_back(*work.run, gradient);
        std::ranges::copy(gradient.values, out.by_parameter.row(first).begin());
    }
    for (std::size_t k = 0; k < count; ++k) {
        if (failures[k].empty()) continue;
        out.value[first + k] = -infinity;
        std::ranges::fill(out.by_parameter.row(first + k), 0);
        std::ranges::fill(out.by_residual.row(first + k), 0);
    }
}

/// Unused lanes repeat the last row.
void BuildingModel::add_meter(std::size_t meter, const Points& points, std::size_t first,
                              bool derivatives, Likelihood& out, Work& work) const {
    const MeterModel& model = meters_[meter];
    const auto n_lanes = static_cast<std::size_t>(lanes());
    const std::size_t n = model.unknowns.size(), n_rows = points.parameters.rows;
    const std::size_t column = first_residual_parameter(meter);
    work.parameters.resize(n * n_lanes);
    work.by_parameter.resize(n * n_lanes);
    work.values.resize(n_lanes);
    for (std::size_t q = 0; q < n; ++q)
        for (std::size_t lane = 0; lane < n_lanes; ++lane)
            work.parameters[q * n_lanes + lane] =
                points.residuals(std::min(first + lane, n_rows - 1), column + q);
    model.residuals.log_likelihood(
        response_->readings(*work.run, meter), work.parameters.data(), lanes(),
        work.values.data(),
        derivatives ? response_->sensitivities(*work.run, meter) : nullptr,
        derivatives ? work.by_parameter.data() : nullptr, work.residuals);
    for (std::size_t lane = 0; lane < n_lanes && first + lane < n_rows; ++lane) {
        out.value[first + lane] += work.values[lane];
        if (!derivatives) continue;
        for (std::size_t q = 0; q < n; ++q)
            out.by_residual(first + lane, column + q) =
                work.by_parameter[q * n_lanes + lane];
    }
}

std::vector<Matrix> BuildingModel::predict(const Matrix& parameters) const {
    std::vector<Matrix> predictions;
    predictions.reserve(meters_.size());
    for (const MeterModel& model : meters_)
        predictions.emplace_back(parameters.rows, model.measured.size(), nan);
    const auto run = response_->make_run();
    const auto n_lanes = static_cast<std::size_t>(lanes());
    for (std::size_t first = 0; first < parameters.rows; first += n_lanes) {
        const std::size_t count = std::min(parameters.rows - first, n_lanes);
        const auto failures = response_->predict(parameters, first, count, *run);
        for (std::size_t m = 0; m < meters_.size(); ++m)
            for (std::size_t k = 0; k < count; ++k)
                for (std::size_t r = 0; failures[k].empty() && r < predictions[m].cols;
                     ++r)
                    predictions[m](first + k, r) =
                        response_->readings(*run, m)[r * n_lanes + k];
    }
    return predictions;
}

}  // namespace bemcal::posterior
