/// Where hooks lie: the inputs of a building that each of them changes.
#pragma once

#include "effects/effect.hpp"
#include "physics/parameters.hpp"

#include <vector>

namespace bemcal::effects {

/// Collects inputs (Slot::change) of one building, zone after zone.
class Sites {
  public:
    explicit Sites(physics::Building& building) : building_(building) {}

    void of_outdoors(physics::Input physics::OutdoorShift::* input);
    /// Of each zone the flow of that name, else the first one from outdoors without a
    /// schedule; a zone that has neither gets one of 0 1/h.
    void of_infiltration();
    /// The same where a zone has one that is not 0.
    void of_leaks();
    void of_flows(physics::Input physics::AirFlow::* input,
                  bool (*is_one)(const physics::AirFlow&));
    void of_openings();
    /// Air from outdoors that fans bring: flows, or what a system has of it.
    void of_ventilation();
    /// Temperatures behind elements that follow a profile.
    void of_boundaries();
    /// Constructions of elements that face outdoors, changed wherever they are used.
    void of_outer_walls();
    void of_glazings();
    /// Shading of the windows that face as this plane does; none = of all.
    void of_windows(std::optional<int> facade);
    void of_loads(bool (*is_one)(const physics::Load&));
    /// A thermostat's input in the zones that it heats, or cools.
    void of_heating(physics::Input physics::Thermostat::* input);
    void of_cooling(physics::Input physics::Thermostat::* input);
    /// By how much the rooms of zones differ that a thermostat heats or cools.
    void of_rooms();
    /// Of the systems that serve a zone.
    void of_air_systems(physics::Input physics::AirSystem::* input);
    /// Of boundaries whose air systems supply; of systems where they supply another.
    void of_supply_temperatures();
    /// The efficiency, or COP, where a carrier and some zone use it.
    void of_heating_plant();
    void of_cooling_plant();
    /// The factor of an energy's meter.
    void of_meter(std::optional<physics::Quantity> meter);
    /// Inputs of loads, or of thermostat, flows, openings and air systems, that follow a
    /// profile.
    void of_scheduled_loads();
    void of_scheduled_plant();

    const std::vector<physics::Target>& targets() const { return targets_; }

  private:
    void add(physics::Part part, std::size_t index, std::size_t inner,
             const physics::Input& input);
    template <class Pick>
    void of_zones(Pick pick);
    template <class Has>
    void of_thermostats(physics::Input physics::Thermostat::* input, Has has);
    void keep_scheduled();
    bool is_supply(std::size_t boundary) const;

    physics::Building& building_;
    std::vector<physics::Target> targets_;
};

bool is_fan(const physics::AirFlow& flow);
bool recovers_heat(const physics::AirFlow& flow);
bool heats_a_zone(const physics::Load& load);
/// By its name: it begins with "light", in letters of any size, and is of no equipment.
bool lights_a_zone(const physics::Load& load);
/// Likewise: with "equip", "plug", "device" or "appliance", and it is of no light.
bool equips_a_zone(const physics::Load& load);

/// Whether two planes face the same way.
bool same_facade(const physics::Building& building, int plane, int other);

/// The target whose input, or number, that is.
physics::Target target_of(physics::Building& building, physics::Target part,
                          const physics::Input& input);
physics::Target target_of(physics::Building& building, physics::Target part,
                          const double& number);

}  // namespace bemcal::effects
