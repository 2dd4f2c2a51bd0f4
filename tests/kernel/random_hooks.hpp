/// Random buildings with all that an effect may bring: changes of any input, openings
/// that follow the room, outdoors that differs from the weather, factors of meters.
#pragma once

#include "kernel/random_building.hpp"

namespace bemcal::physics::test {

/// Rows that with_hooks adds to the profiles: by the clock, in a few levels, series.
constexpr int night = n_profiles, few_levels = n_profiles + 1, swinging = n_profiles + 2;
constexpr int n_hook_profiles = 3;

inline void add_hook_profiles(Dice& dice, Drive& drive) {
    const Matrix before = drive.profiles;
    drive.profiles = Matrix(before.rows + n_hook_profiles, before.cols);
    std::copy(before.values.begin(), before.values.end(), drive.profiles.values.begin());
    for (std::size_t k = 0; k < before.cols; ++k) {
        const double hours = static_cast<double>(k) * drive.axis.step_s / 3600;
        const double hour = std::fmod(hours, 24);
        drive.profiles(night, k) = hour < 6 || hour >= 22 ? 1 : 0;
        drive.profiles(few_levels, k) = std::floor(3 + 3 * std::sin(hours / 37)) / 6;
        drive.profiles(swinging, k) = std::sin(hours / 11) + 0.2 * dice.between(0, 1);
    }
}

/// Adds a change; of kind shift in the share `shift` of the input's size.
inline void change(Dice& dice, Input& input, double shift, int last_profile) {
    const double size = std::max(std::fabs(input.value), std::fabs(input.low));
    const auto kind = static_cast<ChangeKind>(dice.below(3));
    const double most = kind == ChangeKind::shift ? shift * size : 0.12;
    const double amount = dice.between(-most, most);
    input.changes.push_back({amount, night + dice.below(last_profile - night + 1), kind});
}

/// One to three changes, by chance.
inline void change_some(Dice& dice, double chance, Input& input, double shift,
                        int last_profile = few_levels) {
    if (!std::isfinite(input.value) || !dice.chance(chance)) return;
    const int n = 1 + dice.below(3);
    for (int k = 0; k < n; ++k) change(dice, input, shift, last_profile);
}

inline void change_elements(Dice& dice, double chance, Building& building) {
    for (Construction& construction : building.constructions)
        change_some(dice, chance, construction.u_value, 0.1);
    for (Glazing& glazing : building.glazings)
        for (Input* input : {&glazing.u_value, &glazing.solar_transmittance})
            change_some(dice, chance, *input, 0.1);
    for (Boundary& boundary : building.boundaries)
        change_some(dice, 2 * chance, boundary.temperature, 0.1, swinging);
    for (Input* input : {&building.plant.heating_efficiency, &building.plant.cooling_cop})
        change_some(dice, 2 * chance, *input, 0.1, swinging);
}

inline void change_zone(Dice& dice, double chance, Zone& zone) {
    for (Surface& surface : zone.surfaces)
        change_some(dice, chance, surface.shading, 0.1);
    for (Window& window : zone.windows) change_some(dice, chance, window.shading, 0.1);
    for (AirFlow& flow : zone.flows)
        for (Input* input : {&flow.air_change, &flow.heat_recovery})
            change_some(dice, chance, *input, 0.1);
    for (Load& load : zone.loads) {
        change_some(dice, 2 * chance, load.density, 0.2, swinging);
        change_some(dice, chance, load.efficiency, 0.1, swinging);
    }
    Thermostat& control = zone.thermostat;
    for (Input* input : {&control.heating_set_point, &control.cooling_set_point})
        if (dice.chance(chance))
            input->changes = {{dice.between(-1, 1), night, ChangeKind::shift}};
    for (Input* input : {&control.heating_capacity, &control.cooling_capacity,
                         &control.heating_available})
        change_some(dice, chance, *input, 0.1);
    if (std::min(control.room_spread.value, control.room_spread.low) > 2)
        change_some(dice, chance, control.room_spread, 0.5);
    if (control.imposed)
        change_some(dice, 2 * chance, control.imposed_power, 0.2, swinging);
}

inline void shift_outdoors(Dice& dice, OutdoorShift& shift) {
    for (Input* input : {&shift.supply, &shift.opaque, &shift.windows}) {
        *input = random_input(dice, -2, 2, 0.3, other_series);
        change_some(dice, 0.7, *input, 1, swinging);
    }
}

inline void set_venting(Dice& dice, Venting& venting) {
    venting = {random_input(dice, 0.5, 4, 0.3), dice.between(20, 24),
               dice.between(0.5, 4)};
    change_some(dice, 0.7, venting.air_change, 0.1);
}

/// \param chance  of each input to be changed
inline RandomCase with_hooks(RandomCase made, unsigned seed, double chance) {
    Dice dice(seed + 500);
    add_hook_profiles(dice, made.drive);
    change_elements(dice, chance, made.building);
    for (Zone& zone : made.building.zones) {
        change_zone(dice, chance, zone);
        if (dice.chance(0.5)) shift_outdoors(dice, zone.outdoor_shift);
        if (dice.chance(0.4)) set_venting(dice, zone.venting);
    }
    for (std::size_t quantity = 1; quantity < made.building.meter_factor.size();
         ++quantity) {
        if (!dice.chance(0.4)) continue;
        made.building.meter_factor[quantity] = random_input(dice, 0.7, 1.4, 0.3);
        change_some(dice, 0.5, made.building.meter_factor[quantity], 0.1, swinging);
    }
    return made;
}

inline RandomCase random_hooked_case(unsigned seed) {
    return with_hooks(random_case(seed), seed, 0.05 + 0.15 * (seed % 3));
}

/// Every change of the building: what `Slot::change` may name.
template <class Visit>
void for_changes(const Building& building, const std::vector<Target>& targets,
                 Visit visit) {
    Building copy = building;
    for (Target target : targets) {
        const Input* input = input_at(copy, target);
        target.slot = Slot::change;
        for (std::size_t k = 0; input != nullptr && k < input->changes.size(); ++k) {
            target.change = static_cast<int>(k);
            visit(target);
        }
    }
}

}  // namespace bemcal::physics::test
