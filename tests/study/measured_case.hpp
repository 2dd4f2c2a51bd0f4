/// The small building with hourly readings that the model itself makes at known values.
#pragma once

#include "physics/simulate.hpp"
#include "study/small_case.hpp"

#include <vector>

namespace bemcal::test {

/// Of the small case's parameters.
inline const std::vector<double> true_values{0.6, 0.6, 21.6};

/// Gas and air temperature at the truth, from the 7th to the 24th day.
inline study::Case measured_case() {
    study::Case made = small_case();
    const study::Period all{"all", day(7), day(24)};
    const physics::Drive drive = study::drive_of(made, all);
    physics::Building building = made.building;
    physics::apply(made.building, made.parameters, true_values, building);
    const auto trajectory = physics::simulate(building, drive);
    for (const auto quantity :
         {physics::Quantity::gas, physics::Quantity::air_temperature})
        made.meters.push_back({physics::name_of(quantity), quantity,
                               physics::Interval::hourly, study::axis_of(made, all),
                               physics::predict(building, drive, trajectory, quantity)});
    return made;
}

}  // namespace bemcal::test
