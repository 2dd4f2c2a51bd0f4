/// The part-load factor and its derivatives.
/// Follows from the formula in cycling.hpp. Without a least load nothing cycles.
#include "physics/cycling.hpp"

namespace bemcal::physics {

namespace {

bool cycles(const Cycling& cycling) {
    return cycling.load > 0 && cycling.load < cycling.least;
}

double part_load_factor(const Cycling& cycling) {
    return 1 - cycling.loss * (1 - cycling.load / cycling.least);
}

Cycling heating_of(const Plant& plant, double floor_area, double load) {
    return {load, plant.heating_least_load * floor_area, plant.heating_cycling_loss};
}

Cycling cooling_of(const Plant& plant, double floor_area, double load) {
    return {load, plant.cooling_least_load * floor_area, plant.cooling_cycling_loss};
}

}  // namespace

double lost(const Cycling& cycling) {
    return cycles(cycling) ? cycling.load * (1 / part_load_factor(cycling) - 1) : 0;
}

Cycling pull_lost(const Cycling& cycling, double of_lost) {
    if (!cycles(cycling)) return {};
    const double factor = part_load_factor(cycling);
    const double of_factor = -of_lost * cycling.load / (factor * factor);
    const double share = cycling.load / cycling.least;
    return {of_lost * (1 / factor - 1) + of_factor * cycling.loss / cycling.least,
            -of_factor * cycling.loss * share / cycling.least, -of_factor * (1 - share)};
}

Losses losses_of(const Plant& plant, double floor_area, double heating, double cooling) {
    return {lost(heating_of(plant, floor_area, heating)),
            lost(cooling_of(plant, floor_area, cooling))};
}

void PlantPowers::add(const Plant& plant, double floor_area, double zone_heating,
                      double zone_cooling, double zone_fan) {
    const Losses losses = losses_of(plant, floor_area, zone_heating, zone_cooling);
    heating += zone_heating;
    cooling += zone_cooling;
    fan += zone_fan;
    lost.heating += losses.heating;
    lost.cooling += losses.cooling;
}

Losses pull_losses(const Plant& plant, double floor_area, const Losses& loads,
                   const Losses& of_losses, Plant& of_plant, double& of_floor_area) {
    const Cycling of_heating =
        pull_lost(heating_of(plant, floor_area, loads.heating), of_losses.heating);
    const Cycling of_cooling =
        pull_lost(cooling_of(plant, floor_area, loads.cooling), of_losses.cooling);
    of_plant.heating_least_load += of_heating.least * floor_area;
    of_plant.cooling_least_load += of_cooling.least * floor_area;
    of_plant.heating_cycling_loss += of_heating.loss;
    of_plant.cooling_cycling_loss += of_cooling.loss;
    of_floor_area += of_heating.least * plant.heating_least_load +
                     of_cooling.least * plant.cooling_least_load;
    return {of_heating.load, of_cooling.load};
}

}  // namespace bemcal::physics
