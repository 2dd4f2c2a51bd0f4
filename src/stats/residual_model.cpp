/// The log likelihood of a meter's readings and its derivatives, block by block of lanes:
/// residuals scaled, then the density of their memory, then the way back.
/// Follows from the model in residual_model.hpp: white, AR(1), or with a Matern-3/2
/// share. A value that is not finite becomes -inf. Heavy tails and correlation among
/// meters are left out.
#include "stats/residual_model.hpp"

#include "stats/residual_model_filter.hpp"
#include "stats/residual_model_memory.hpp"
#include "stats/residual_model_parameters.hpp"
#include "stats/residual_model_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bemcal::stats {

namespace {

using namespace residual;

/// What a call of log_likelihood shares among its blocks of lanes.
struct Call {
    const ReadingTimes& times;
    std::span<const double> measured;
    double unit;
    const ResidualOptions& options;
    std::vector<Parameter> list;
    const double* predictions;
    const double* parameters;
    double* values;
    double* by_prediction;
    double* by_parameter;
    Scaled scaled;
    FilterScratch filter;

    bool wants_derivatives() const { return by_prediction || by_parameter; }
};

ParameterLanes load_parameters(const Call& call, const Block& block) {
    ParameterLanes lanes = no_effect();
    for (std::size_t k = 0; k < call.list.size(); ++k)
        lanes[call.list[k]] = block.load(call.parameters, k);
    return lanes;
}

/// Relative change of the gain from one reading to the next that counts as settled.
constexpr double settled_change = 1e-10;

Lanes filter_density(const Call& call, const ParameterLanes& parameters,
                     ParameterLanes& derivative) {
    const double tolerance = call.options.steady_state ? settled_change : -1;
    Filter filter(call.times, parameters, tolerance, call.scaled, call.filter);
    const Lanes value = filter.log_density();
    if (call.wants_derivatives()) filter.pull_back(derivative);
    return value;
}

/// Log density of the z, and its derivative by the parameters it has.
Lanes density_of_z(const Call& call, const ParameterLanes& parameters,
                   ParameterLanes& derivative) {
    if (call.options.discrepancy) return filter_density(call, parameters, derivative);
    if (!call.options.autocorrelated)
        return white_log_density(call.times.n_present(), call.scaled);
    const auto density = ar1_log_density(call.times, parameters[phi], call.scaled);
    derivative[phi] = density.by_phi;
    return density.value;
}

void store_derivative(const Call& call, const Block& block,
                      const ParameterLanes& derivative) {
    for (std::size_t k = 0; k < call.list.size(); ++k)
        block.store(call.by_parameter, k, derivative[call.list[k]]);
}

void clear_column(double* array, std::size_t rows, std::size_t lanes, std::size_t lane) {
    if (array == nullptr) return;
    for (std::size_t k = 0; k < rows; ++k) array[k * lanes + lane] = 0;
}

/// A value that is not finite becomes -inf, with derivatives of 0.
void settle_values(const Call& call, const Block& block, const Lanes& value) {
    for (std::size_t k = 0; k < block.count; ++k) {
        const std::size_t lane = block.first + k;
        call.values[lane] = value[static_cast<Eigen::Index>(k)];
        if (std::isfinite(call.values[lane])) continue;
        call.values[lane] = -std::numeric_limits<double>::infinity();
        clear_column(call.by_prediction, call.measured.size(), block.lanes, lane);
        clear_column(call.by_parameter, call.list.size(), block.lanes, lane);
    }
}

void evaluate(const Call& call, const Block& block) {
    const ParameterLanes parameters = load_parameters(call, block);
    const Scale scale{parameters[constant], parameters[proportional], call.unit};
    Lanes value = scale_residuals(call.times, call.measured, scale, block,
                                  call.predictions, call.scaled);
    ParameterLanes derivative{all(0), all(0), all(0), all(0), all(0)};
    value += density_of_z(call, parameters, derivative);
    value -= 0.5 * static_cast<double>(call.times.n_present()) *
             std::log(2 * std::numbers::pi);
    if (call.wants_derivatives()) {
        const auto by_scale = pull_back_scale(call.times, scale, block, call.predictions,
                                              call.scaled, call.by_prediction);
        derivative[constant] = by_scale.constant;
        derivative[proportional] = by_scale.proportional;
    }
    if (call.by_parameter) store_derivative(call, block, derivative);
    const Lanes nowhere = all(-std::numeric_limits<double>::infinity());
    settle_values(call, block, choose(are_in_range(parameters), value, nowhere));
}

void clear(double* array, std::size_t size) {
    if (array != nullptr) std::fill_n(array, size, 0.0);
}

}  // namespace

ResidualModel::ResidualModel(std::vector<double> measured, double scale,
                             ResidualOptions options)
    : measured_(std::move(measured)),
      scale_(scale),
      options_(options),
      times_(reading_times(measured_)) {}

std::size_t ResidualModel::n_parameters() const {
    return parameters_of(options_).size();
}

void ResidualModel::log_likelihood(const double* predictions, const double* parameters,
                                   int lanes, double* values, double* by_prediction,
                                   double* by_parameter, Work& work) const {
    const auto n_lanes = static_cast<std::size_t>(lanes);
    clear(values, n_lanes);
    clear(by_prediction, n_readings() * n_lanes);
    clear(by_parameter, n_parameters() * n_lanes);
    if (n_present() == 0) return;
    const std::size_t size = n_present() * width;
    const std::size_t filter_rows =
        options_.discrepancy ? FilterScratch::rows_for(n_present()) : 0;
    work.doubles.resize(3 * size + filter_rows * width);
    work.indices.resize(times_.stretches.size());
    double* scratch = work.doubles.data();
    const Scaled scaled{scratch, scratch + size, scratch + 2 * size};
    double* states = scratch + 3 * size;
    const FilterScratch filter{states, states + 3 * (n_present() + 1) * width,
                               work.indices.data()};
    const Call call{
        times_,      measured_,  scale_, options_,      parameters_of(options_),
        predictions, parameters, values, by_prediction, by_parameter,
        scaled,      filter};
    for (std::size_t first = 0; first < n_lanes; first += width)
        evaluate(call, {first, std::min<std::size_t>(width, n_lanes - first), n_lanes});
}

}  // namespace bemcal::stats
