/// A plant below its least load: it runs for a part of the hour only, and loses at every
/// start. What it takes for the same heat is divided by the part-load factor.
///
/// Source: AHRI 210/240 (ANSI/AHRI 210/240-2008, C3.5): PLF = 1 - C_D (1 - CLF), where
/// CLF is the load over the capacity of the stage that cycles, and C_D the coefficient of
/// degradation. Boilers follow the same line. Each zone has its own part of the plant.
/// Left out: power that a stopped plant draws, a time that a start takes.
#pragma once

#include "physics/building.hpp"

namespace bemcal::physics {

/// A load, the least load of the plant in W, and C_D. Its adjoints have the same type.
struct Cycling {
    double load = 0, least = 0;  ///< [W]
    double loss = 0;             ///< C_D [-]
};

/// What a plant that cycles would deliver more by the same energy [W]: load (1/PLF - 1).
double lost(const Cycling& cycling);
/// d objective / d (numbers of the cycling).
Cycling pull_lost(const Cycling& cycling, double of_lost);

/// What is lost of a zone's heat and cold [W].
struct Losses {
    double heating = 0, cooling = 0;
};
Losses losses_of(const Plant& plant, double floor_area, double heating, double cooling);
/// What all zones take at a step [W].
struct PlantPowers {
    double heating = 0, cooling = 0, fan = 0;
    Losses lost;
    void add(const Plant& plant, double floor_area, double zone_heating,
             double zone_cooling, double zone_fan);
};
/// Adds to the plant's and the area's adjoints; returns those of the loads.
Losses pull_losses(const Plant& plant, double floor_area, const Losses& loads,
                   const Losses& of_losses, Plant& of_plant, double& of_floor_area);

}  // namespace bemcal::physics
