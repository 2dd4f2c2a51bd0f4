/// Random buildings, half of them with air systems, whose plant cycles below a least
/// load.
#pragma once

#include "kernel/random_supply.hpp"

namespace bemcal::physics::test {

/// Least loads amid what zones ask for; parameters move them and the losses, one of which
/// begins at 0.
inline RandomCase random_cycling_case(unsigned seed) {
    RandomCase made = seed % 2 == 0 ? random_case(seed) : random_supplied_case(seed);
    Dice dice(seed + 99000);
    Plant& plant = made.building.plant;
    plant.heating_least_load = dice.between(10, 60);
    plant.cooling_least_load = dice.between(10, 60);
    plant.heating_cycling_loss = dice.chance(0.8) ? dice.between(0.05, 0.4) : 0;
    plant.cooling_cycling_loss = dice.between(0.05, 0.4);
    for (const char* path : {"plant.heating_least_load", "plant.cooling_least_load"})
        made.parameters.push_back(
            parameter(made.building, path, 0.9, 1.1, Effect::factor));
    made.parameters.push_back(
        parameter(made.building, "plant.heating_cycling_loss", 0, 0.2, Effect::offset));
    return made;
}

}  // namespace bemcal::physics::test
