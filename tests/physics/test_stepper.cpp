/// A building step by step, stopped and started again, against a period in one go.
#include "physics/simulate.hpp"
#include "physics/stepper.hpp"
#include "support/simple_building.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// Two rooms that share air, with every refinement that has a state.
Building refined_building() {
    Building building = test::simple_building();
    building.zones.push_back(test::simple_zone("hall"));
    building.zones[1].couplings.push_back({});
    building.zones[1].couplings[0].zone = 0;
    building.zones[1].couplings[0].air_flow.value = 30;
    Structure& structure = building.zones[0].structure;
    structure.air_capacity = 15000;
    structure.emitter_time_constant = 1500;
    structure.second_mass_conductance = 2;
    structure.second_mass_capacity = 200000;
    return building;
}

TEST(Stepper, GoesOnFromAStateBitForBit) {
    const Building building = refined_building();
    const Drive drive = test::swinging_drive(building, 200, 2, 400);
    const Trajectory whole = simulate(building, drive);
    Stepper first(building, drive), second(building, drive);
    for (int step = 0; step < 120; ++step) first.advance(step);
    std::vector<double> state(first.n_states());
    first.write_state(state);
    second.set_state(state);
    for (int step = 120; step < 200; ++step) {
        const auto results = second.advance(step);
        for (std::size_t zone = 0; zone < 2; ++zone) {
            const auto k = static_cast<std::size_t>(step);
            ASSERT_EQ(results[zone].theta.theta_air, whole.zones[zone].theta_air[k]);
            ASSERT_EQ(results[zone].theta.theta_m_t, whole.zones[zone].theta_m[k]);
            ASSERT_EQ(results[zone].phi_heating, whole.zones[zone].heating[k]);
        }
    }
}

TEST(Stepper, GivesBackTheStateThatWasSet) {
    const Building building = refined_building();
    const Drive drive = test::swinging_drive(building, 10, 2, 400);
    Stepper stepper(building, drive);
    std::vector<double> set(stepper.n_states()), got(stepper.n_states());
    for (std::size_t k = 0; k < set.size(); ++k) set[k] = 10 + static_cast<double>(k);
    stepper.set_state(set);
    stepper.write_state(got);
    EXPECT_EQ(got, set);
    Stepper moved(std::move(stepper));
    moved.write_state(got);
    EXPECT_EQ(got, set);
}

}  // namespace
}  // namespace bemcal::physics
