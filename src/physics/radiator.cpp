/// Moves the water and metal of a radiator on: elements in a row, Heun's method in
/// sub-steps of a quarter of the shortest time constant; and the heating curve.
/// Source: modelica-buildings' RadiatorEN442_2; paper 2, eq. 10-12. Left out: conduction
/// between elements, pipes, thermostatic valves. The room is zone_radiator's.
#include "physics/radiator.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::physics {
namespace {

constexpr double c_water = 4184;  ///< [J/(kg K)]
constexpr double safety = 0.25;   ///< longest sub-step, of an element's time constant

double power(double difference, double exponent) {
    return std::copysign(std::pow(std::abs(difference), exponent), difference);
}

/// What one element gives off, and its change of temperature.
struct Flows {
    double convective, radiative, from_water;  ///< [W]
};

/// A radiator between its surroundings, with everything that stays the same in a step.
class Elements {
  public:
    Elements(const Radiator& radiator, const RadiatorSurroundings& around)
        : around_(around),
          exponent_(radiator.exponent),
          flow_(around.opening * radiator.most_flow * c_water),
          share_(1.0 / radiator.n_elements) {
        const double ua = transmittance_of(radiator) * share_;
        convective_ = (1 - radiator.radiative_fraction) * ua;
        radiative_ = radiator.radiative_fraction * ua;
        capacity_ = radiator.capacity * share_;
    }

    Flows flows(double before, double element) const {
        return {convective_ * power(element - around_.air, exponent_),
                radiative_ * power(element - around_.radiant, exponent_),
                flow_ * (before - element)};
    }
    double change(const Flows& flows) const {
        return (flows.from_water - flows.convective - flows.radiative) / capacity_;
    }
    double supply() const { return around_.supply; }
    /// Long against none of the elements' time constants [s].
    double longest_step(std::span<const double> elements) const {
        double most = std::abs(around_.supply - around_.air);
        for (const double element : elements)
            most = std::max(most, std::abs(element - around_.air));
        const double slope = (convective_ + radiative_) * exponent_ *
                             std::pow(std::max(most, 1.0), exponent_ - 1);
        return safety * capacity_ / (flow_ + slope);
    }

  private:
    RadiatorSurroundings around_;
    double exponent_, flow_, share_;
    double convective_ = 0, radiative_ = 0, capacity_ = 1;
};

/// Adds half of a stage's flows to the sums, and its changes of temperature.
void add_stage(const Elements& model, std::span<const double> at, double seconds,
               std::vector<double>& change, RadiatorHeat& sums) {
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Flows flows = model.flows(i == 0 ? model.supply() : at[i - 1], at[i]);
        change[i] = model.change(flows) * seconds;
        sums.convective += 0.5 * seconds * flows.convective;
        sums.radiative += 0.5 * seconds * flows.radiative;
        sums.from_water += 0.5 * seconds * flows.from_water;
    }
}

}  // namespace

const char* complaint_about(const Radiator& radiator) {
    if (!(radiator.exponent >= 1 && radiator.exponent <= 2))
        return "the exponent of a radiator lies between 1 and 2";
    if (!(radiator.power_60 > 0)) return "a radiator needs a positive nominal power";
    if (!(radiator.capacity > 0)) return "a radiator needs a positive capacity";
    if (!(radiator.radiative_fraction >= 0 && radiator.radiative_fraction <= 1))
        return "the radiative fraction of a radiator lies between 0 and 1";
    if (!(radiator.most_flow > 0)) return "a radiator needs a positive maximum flow";
    if (radiator.n_elements < 1) return "a radiator needs an element";
    return "";
}

double transmittance_of(const Radiator& radiator) {
    return radiator.power_60 / std::pow(60, radiator.exponent);
}

RadiatorHeat advance(const Radiator& radiator, const RadiatorSurroundings& around,
                     double seconds, std::span<double> elements) {
    const Elements model(radiator, around);
    const std::size_t n = elements.size();
    std::vector<double> first(n), second(n), ahead(n);
    RadiatorHeat heat;
    for (double left = seconds; left > 0;) {
        const double limit = model.longest_step(elements);
        const double step = left <= limit ? left : left / std::ceil(left / limit);
        add_stage(model, elements, step, first, heat);
        for (std::size_t i = 0; i < n; ++i) ahead[i] = elements[i] + first[i];
        add_stage(model, ahead, step, second, heat);
        for (std::size_t i = 0; i < n; ++i) elements[i] += 0.5 * (first[i] + second[i]);
        left = left <= limit ? 0 : left - step;
    }
    if (seconds > 0)
        for (double* each : {&heat.convective, &heat.radiative, &heat.from_water})
            *each /= seconds;
    return heat;
}

std::optional<double> supply_temperature(const HeatingCurve& curve, bool is_scheduled,
                                         double outdoor, double room) {
    if (is_scheduled)
        return outdoor < curve.limit ? curve.a * outdoor + curve.b : curve.c;
    if (room < curve.set_back) return curve.d;
    return std::nullopt;
}

}  // namespace bemcal::physics
