/// The profile of an effect: shape(driver) x gate at every step, which a coefficient
/// multiplies. A lag is a running mean with exponential weights.
/// Plain definitions, our own. A lag starts from the mean of its first time constant.
/// Levels, drivers and gates have files of their own.
#include "effects/profiles.hpp"

#include "base/error.hpp"
#include "effects/drivers.hpp"
#include "effects/gates.hpp"
#include "effects/steps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

using Series = std::vector<double>;

bool lies_within(const Shape& shape, double value) {
    const bool after = value >= shape.at, before = value < shape.until;
    return shape.at <= shape.until ? after && before : after || before;
}

double shaped(const Shape& shape, double value) {
    switch (shape.form) {
        case Form::above:
            return std::max(value - shape.at, 0.0);
        case Form::below:
            return std::max(shape.at - value, 0.0);
        case Form::over:
            return value > shape.at ? 1 : 0;
        case Form::under:
            return value < shape.at ? 1 : 0;
        case Form::within:
            return lies_within(shape, value) ? 1 : 0;
        default:
            return value;
    }
}

/// Running mean with exponential weights; it starts from the mean of its first time
/// constant.
void lag(Series& series, double time_constant_h, int step_s) {
    if (!(time_constant_h > 0)) return;
    const double step_h = step_s / 3600.0;
    const auto n = std::clamp<std::size_t>(
        static_cast<std::size_t>(time_constant_h / step_h), 1, series.size());
    double state = 0;
    for (std::size_t k = 0; k < n; ++k) state += series[k] / static_cast<double>(n);
    const double weight = 1 - std::exp(-step_h / time_constant_h);
    for (double& value : series) value = state += weight * (value - state);
}

void apply_shape(const Effect& effect, const Surroundings& around, Series& series) {
    const Shape& shape = effect.shape;
    if (shape.form == Form::lagged)
        return lag(series, shape.at, around.drive->axis.step_s);
    if (effect.driver == Driver::hour && shape.form == Form::within)
        series = shares_of({shape.at, shape.until}, around);
    else
        for (double& value : series) value = shaped(shape, value);
}

}  // namespace

bool is_known(const Effect& effect, const Surroundings& around) {
    const auto n = static_cast<std::size_t>(around.drive->n_steps());
    return driver_of(effect, around).size() == n && gate_of(effect, around).size() == n;
}

std::vector<double> profile_of(const Effect& effect, const Surroundings& around) {
    Series series = driver_of(effect, around);
    const Series gate = gate_of(effect, around);
    const auto n = static_cast<std::size_t>(around.drive->n_steps());
    if (series.size() != n || gate.size() != n)
        throw CannotSimulate(
            fmt::format("'{}' follows {} ({}), which this job does not have", effect.name,
                        name_of(effect.driver), name_of(effect.gate)));
    apply_shape(effect, around, series);
    for (std::size_t k = 0; k < n; ++k) series[k] *= gate[k];
    return series;
}

}  // namespace bemcal::effects
