/// The way back from a zone's network and control to the building: reverse-mode
/// differentiation of network.cpp by hand.
///
/// `of_x` is d objective / d x in the type of x: a Network, a Building of adjoints.
/// Everything is added to.
#pragma once

#include "physics/network.hpp"

namespace bemcal::adjoint {

/// Of an input with changes.
void pull_changed_input(const physics::Input& input, const physics::Drive& drive,
                        int step, double of_value, physics::Input& of_input);

/// d objective / d (value of an input at a step) to its numbers.
inline void pull_input(const physics::Input& input, const physics::Drive& drive, int step,
                       double of_value, physics::Input& of_input) {
    if (input.is_changed())
        return pull_changed_input(input, drive, step, of_value, of_input);
    if (input.profile < 0) {
        of_input.value += of_value;
        return;
    }
    const double profile = drive.profiles(static_cast<std::size_t>(input.profile),
                                          static_cast<std::size_t>(step));
    of_input.value += profile * of_value;
    of_input.low += (1 - profile) * of_value;
}

/// Zeros, in the sizes of `network`.
void clear_adjoints(const physics::Network& network, physics::Network& of_network);

/// A zone of a building at a step, and the building's adjoints.
struct PlaceBack {
    const physics::Building& building;
    std::size_t zone;
    const physics::Drive& drive;
    int step;
    physics::Building& of_building;

    const physics::Zone& here() const { return building.zones[zone]; }
    physics::Zone& of_here() const { return of_building.zones[zone]; }
    double at(const physics::Input& input) const { return drive.at(input, step); }
    void pull(const physics::Input& input, double of_value,
              physics::Input& of_input) const {
        pull_input(input, drive, step, of_value, of_input);
    }
    double air_change(const physics::Input& input) const {
        return physics::air_change_at(drive, input, step);
    }
    /// Air that effects have used up does not follow them.
    void pull_air_change(const physics::Input& input, double of_value,
                         physics::Input& of_input) const {
        if (air_change(input) == at(input)) pull(input, of_value, of_input);
    }
};

/// Of make_network; uses up of_network.
void pull_network(const PlaceBack& place, const physics::Network& network,
                  physics::Network& of_network);

/// Of control_at's set-points and limits.
void pull_control(const PlaceBack& place, const physics::Control& control,
                  physics::Control of_control);

}  // namespace bemcal::adjoint
