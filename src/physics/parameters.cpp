/// Writes a point into a building: each parameter's value to its targets, then what
/// follows from them. No words and no allocation, since points come by the million.
/// Plain bookkeeping without a source. Paths are resolved in paths.
#include "physics/parameters.hpp"

#include "physics/derived.hpp"

namespace bemcal::physics {

namespace {

/// \param number  of the nominal building, where the parameter has its nominal value
double changed(double number, const Parameter& parameter, double value) {
    switch (parameter.effect) {
        case Effect::factor:
            return number * (value / parameter.nominal);
        case Effect::offset:
            return number + (value - parameter.nominal);
        default:
            return value;
    }
}

}  // namespace

void apply(const Building& nominal, std::span<const Parameter> parameters,
           std::span<const double> point, Building& building) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
        for (const Target& target : parameters[k].targets)
            number_at(building, target) =
                changed(number_at(nominal, target), parameters[k], point[k]) *
                target.weight;
    derive(building);
}

void set_nominal(double value, Parameter& parameter, Building& building) {
    constexpr double next_to_nothing = 1e-9;
    if (parameter.effect == Effect::factor && value == 0) value = next_to_nothing;
    const Building before = building;
    apply(before, {&parameter, 1}, {&value, 1}, building);
    parameter.nominal = value;
}

}  // namespace bemcal::physics
