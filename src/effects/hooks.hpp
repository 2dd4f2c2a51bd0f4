/// Where hooks lie: the inputs of a building that each of them changes, and how.
#pragma once

#include "effects/effect.hpp"
#include "physics/parameters.hpp"

namespace bemcal::effects {

/// How the hook's profile enters the inputs that it changes.
physics::ChangeKind kind_of(Hook hook);

/// Whether it multiplies conductances, set-points, air flows or efficiencies, so that its
/// profile should have few levels.
bool shapes_regimes(Hook hook);

/// The inputs (Slot::change) that the hook changes: of every zone, facade or plant that
/// has them. Of `infiltration` in a zone: the flow of that name, else the first one from
/// outdoors without a schedule; a zone that has neither gets one of 0 1/h. A construction
/// that faces outdoors somewhere is changed wherever it is used. Throws
/// std::invalid_argument where the building has none.
std::vector<physics::Target> sites_of(const Effect& effect, physics::Building& building);

/// Where schedules enter: loads, or thermostat, flows and openings.
enum class Scheduled { loads, plant };
std::vector<physics::Target> scheduled_sites(physics::Building& building,
                                             Scheduled which);

/// The target whose input, or number, that is.
physics::Target target_of(physics::Building& building, physics::Target part,
                          const physics::Input& input);
physics::Target target_of(physics::Building& building, physics::Target part,
                          const double& number);

}  // namespace bemcal::effects
