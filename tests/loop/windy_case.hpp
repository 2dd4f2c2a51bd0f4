/// A small building in five months of wind, and gas readings of it with an effect.
#pragma once

#include "effects/catalogue.hpp"
#include "effects/make_surroundings.hpp"
#include "effects/placement.hpp"
#include "physics/simulate.hpp"
#include "sampling/normal.hpp"
#include "study/small_case.hpp"

#include <cmath>
#include <stdexcept>

namespace bemcal::test {

inline constexpr int n_days = 150, n_training = 110;

inline effects::Effect named(const std::string& name) {
    for (const effects::Entry& entry : effects::catalogue())
        if (entry.effect.name == name) return entry.effect;
    throw std::out_of_range(name);
}

/// Heat that nobody meters, from 5 to 9 h.
inline effects::Effect gains_of_the_morning() {
    effects::Effect effect;
    effect.name = "gains";
    effect.hook = effects::Hook::gains;
    effect.driver = effects::Driver::hour;
    effect.shape = {effects::Form::within, 5, 9};
    effect.most = 60;
    return effect;
}

/// Five months of wind, a training period and one that is held out, no meters yet.
inline study::Case windy_case() {
    study::Case made = small_case();
    made.weather = made_up_weather(n_days);
    for (int k = 0; k < made.weather.axis.n_steps; ++k) {
        made.weather.wind_speed.push_back(4 + 3 * std::sin(k / 17.0) + std::sin(k / 5.0));
        made.weather.theta_e[static_cast<std::size_t>(k)] -= 8;
    }
    made.periods = {{"training", day(7), day(n_training)},
                    {"held_out", day(n_training), day(n_days)}};
    for (const physics::Parameter& parameter : made.parameters) {
        stats::Prior prior;
        prior.kind = stats::PriorKind::normal;
        prior.a = parameter.nominal;
        prior.b = 0.25 * (parameter.most - parameter.least);
        prior.least = parameter.least;
        prior.most = parameter.most;
        made.priors.push_back({prior, {}});
    }
    return made;
}

/// A series that nothing of the building follows: 2 mm in some hours.
inline void add_rain(study::Case& made) {
    physics::Profile rain;
    rain.name = "rain";
    rain.is_series = true;
    rain.axis = made.weather.axis;
    for (int k = 0; k < rain.axis.n_steps; ++k)
        rain.values.push_back(k % 41 < 9 || k % 97 < 14 ? 2 : 0);
    made.profiles.push_back(rain);
    made.columns.push_back({"rain", "mm"});
}

/// Adds the gas meter of the building with effects, with errors of 3 % of its mean.
inline void measure(study::Case& made, const std::vector<effects::Effect>& effects,
                    const std::vector<double>& coefficients, std::uint64_t seed) {
    const study::Period all{"all", made.periods.front().from, made.periods.back().to};
    const physics::Drive drive = study::drive_of(made, all);
    auto around = effects::make_surroundings(made.building, drive, made.weather,
                                             made.periods[0].from);
    for (std::size_t p = 0; p < made.profiles.size(); ++p) {
        const auto row = drive.profiles.row(p);
        if (made.profiles[p].is_series)
            around.columns[made.profiles[p].name].assign(row.begin(), row.end());
    }
    const auto placed = effects::place(effects, around);
    physics::Building building = placed.building;
    physics::apply(placed.building, placed.parameters, coefficients, building);
    auto gas = physics::predict(building, placed.drive,
                                physics::simulate(building, placed.drive),
                                physics::Quantity::gas);
    double mean = 0;
    for (const double value : gas) mean += value / static_cast<double>(gas.size());
    Stream random(seed, 0, 0);
    for (double& value : gas) value += 0.03 * mean * sampling::standard_normal(random);
    made.meters = {{"gas", physics::Quantity::gas, physics::Interval::hourly,
                    study::axis_of(made, all), gas}};
}
inline void measure(study::Case& made, const effects::Effect& effect, double coefficient,
                    std::uint64_t seed) {
    measure(made, std::vector{effect}, std::vector{coefficient}, seed);
}

}  // namespace bemcal::test
