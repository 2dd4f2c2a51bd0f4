/// Ways in which effects enter a building: profiles that change the inputs of a hook, and
/// parts that are added, each with one coefficient.
/// Follows from physics::Change.
/// Left out: a neighbour and a second mass take no gate; an added mass is twice the
/// first.
#include "effects/entering.hpp"

#include "base/error.hpp"
#include "effects/decisions.hpp"
#include "effects/gates.hpp"
#include "effects/levels.hpp"
#include "effects/placer.hpp"
#include "effects/profiles.hpp"
#include "effects/schedules.hpp"
#include "effects/sites.hpp"
#include "effects/steps.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

using physics::Building;
using physics::Carrier;
using physics::Input;
using physics::Part;
using physics::Target;
using Series = std::vector<double>;

[[noreturn]] void object(const std::string& why) {
    throw CannotSimulate(why);
}

std::vector<Target> sites_of(const HookRow& row, const Effect& effect,
                             Building& building) {
    Sites sites(building);
    row.sites(effect, sites);
    if (sites.targets().empty()) object(row.lack);
    return sites.targets();
}

/// Few levels where the hook shapes regimes.
Series levelled_for(const HookRow& row, const Effect& effect, const Series& profile) {
    const bool is_rounded = row.shapes_regimes && !effect.is_smooth;
    return is_rounded ? levelled(profile, decisions::most_levels) : profile;
}

/// Adds what its schedules would change; inputs of loads that an effect added have none.
void move_inputs(Placer& placer, const HookRow& row, const Effect& effect,
                 const std::vector<Target>& targets) {
    const Surroundings& around = placer.around();
    const physics::Drive& drive = *around.drive;
    const Series gate = gate_of(effect, around);
    for (const Target& target : targets) {
        const auto profile = static_cast<std::size_t>(
            physics::input_at(placer.building(), target)->profile);
        if (profile >= placer.first_row()) continue;
        const auto own = drive.profiles.row(profile);
        if (!is_schedule(own, drive)) continue;
        Series moved = effect.driver == Driver::another_day
                           ? as_on(static_cast<int>(effect.shape.at), own, drive)
                           : later_by(effect.shape.at, own, drive);
        for (std::size_t k = 0; k < moved.size(); ++k)
            moved[k] = gate[k] * (moved[k] - own[k]);
        if (!placer.keeps_rows() &&
            std::ranges::all_of(moved, [](double x) { return x == 0; }))
            continue;
        if (target.part != Part::load) moved = levelled(moved, decisions::most_levels);
        placer.change(target, row.kind, placer.profile_row(std::move(moved)));
    }
}

void check_moves_schedules(const Effect& effect) {
    if (effect.driver != Driver::another_day && effect.driver != Driver::shifted_hours)
        object("schedules move to another day or hour, and by no other driver");
}

void add_load(Placer& placer, const Effect& effect, Carrier carrier,
              double heat_fraction) {
    const int row = placer.profile_row(profile_of(effect, placer.around()));
    std::vector<physics::Zone>& zones = placer.building().zones;
    for (std::size_t z = 0; z < zones.size(); ++z) {
        std::vector<physics::Load>& loads = zones[z].loads;
        physics::Load& load = loads.emplace_back();
        load.name = placer.new_name();
        load.density.profile = row;
        load.carrier = carrier;
        load.heat_fraction = heat_fraction;
        placer.set({Part::load, static_cast<int>(z), static_cast<int>(loads.size()) - 1},
                   load.density);
    }
}

/// A wall of the size of the floor to a boundary, in every zone.
void add_walls(Building& building, const std::string& name) {
    physics::Surface surface;
    surface.name = name;
    surface.construction = static_cast<int>(building.constructions.size()) - 1;
    surface.boundary = static_cast<int>(building.boundaries.size()) - 1;
    surface.in_sun = false;
    for (physics::Zone& zone : building.zones) {
        surface.area = zone.floor_area;
        zone.surfaces.push_back(surface);
    }
}

/// As a ground does; a neighbour's rooms follow the hour.
bool keeps_all_day(const Series& series, const Surroundings& around) {
    for (std::size_t k = 1; k < series.size(); ++k)
        if (series[k] != series[k - 1] &&
            around.calendar[k].day_of_year == around.calendar[k - 1].day_of_year)
            return false;
    return true;
}

}  // namespace

void change_inputs(Placer& placer, const HookRow& row, const Effect& effect) {
    const int profile = placer.profile_row(
        levelled_for(row, effect, profile_of(effect, placer.around())));
    for (const Target& target : sites_of(row, effect, placer.building()))
        placer.change(target, row.kind, profile);
}

void change_windows(Placer& placer, const HookRow& row, const Effect& effect) {
    if (effect.facade || !follows_sun_on_facade(effect.driver))
        return change_inputs(placer, row, effect);
    for (const Target& target : sites_of(row, effect, placer.building())) {
        const physics::Zone& zone =
            placer.building().zones[static_cast<std::size_t>(target.index)];
        Effect of_facade = effect;
        of_facade.facade = zone.windows[static_cast<std::size_t>(target.inner)].plane;
        placer.change(target, row.kind,
                      placer.profile_row(levelled_for(
                          row, of_facade, profile_of(of_facade, placer.around()))));
    }
}

void change_leaks(Placer& placer, const HookRow& row, const Effect& effect) {
    const Series exact = profile_of(effect, placer.around());
    Series profile = levelled_for(row, effect, exact);
    // Leaks may not turn round. The calmest hours keep their value, which is that of
    // every year: what one year shows to be possible is so in another.
    std::ranges::replace(profile, std::ranges::min(profile), std::ranges::min(exact));
    for (const Target& target : sites_of(row, effect, placer.building())) {
        Series leak = profile;
        for (double& value : leak)
            value *= physics::input_at(placer.building(), target)->value;
        placer.change(target, row.kind, placer.profile_row(std::move(leak)));
    }
}

void move_boundaries(Placer& placer, const HookRow& row, const Effect& effect) {
    const Surroundings& around = placer.around();
    const Series towards = profile_of(effect, around);
    bool is_any = false;
    for (const Target& target : sites_of(row, effect, placer.building())) {
        const physics::Input declared = *physics::input_at(placer.building(), target);
        const Series own = each_step(around, [&](std::size_t k) {
            return around.drive->at(declared, static_cast<int>(k));
        });
        if (!keeps_all_day(own, around)) continue;
        Series moved = towards;
        for (std::size_t k = 0; k < moved.size(); ++k) moved[k] -= own[k];
        placer.change(target, row.kind, placer.profile_row(std::move(moved)));
        is_any = true;
    }
    if (!is_any) object(row.lack);
}

void open_windows(Placer& placer, const HookRow& row, const Effect& effect) {
    if (effect.driver != Driver::one)
        object("openings follow the room and a gate, no other driver");
    for (physics::Zone& zone : placer.building().zones) {
        physics::Venting& venting = zone.venting;
        const bool used = venting.air_change.value > 0 || venting.air_change.is_changed();
        if (used && effect.shape.at > 0 && venting.opens_above != effect.shape.at)
            object(fmt::format("there are openings already, which open above {} degC",
                               venting.opens_above));
        if (effect.shape.at > 0) venting.opens_above = effect.shape.at;
    }
    change_inputs(placer, row, effect);
}

void move_schedules(Placer& placer, const HookRow& row, const Effect& effect) {
    move_schedules_of_loads(placer, row, effect);
    move_schedules_of_plant(placer, row, effect);
}

void move_schedules_of_loads(Placer& placer, const HookRow& row, const Effect& effect) {
    check_moves_schedules(effect);
    Sites sites(placer.building());
    sites.of_scheduled_loads();
    move_inputs(placer, row, effect, sites.targets());
}

void move_schedules_of_plant(Placer& placer, const HookRow& row, const Effect& effect) {
    if (effect.other_hours) return placer.act_always();  // the drive has them
    check_moves_schedules(effect);
    Sites sites(placer.building());
    sites.of_scheduled_plant();
    move_inputs(placer, row, effect, sites.targets());
}

void add_heat(Placer& placer, const HookRow&, const Effect& effect) {
    add_load(placer, effect, Carrier::none, 1);
}

void add_lights_and_equipment(Placer& placer, const HookRow&, const Effect& effect) {
    add_load(placer, effect, Carrier::electricity, 1);
}

void add_to_meter(Placer& placer, const HookRow&, const Effect& effect) {
    const Carrier carrier =
        effect.meter ? physics::carrier_of(*effect.meter) : Carrier::none;
    if (carrier == Carrier::none)
        object(fmt::format("it needs a meter of {} as its place",
                           physics::nouns_of_carriers()));
    add_load(placer, effect, carrier, 0);
}

void add_neighbour(Placer& placer, const HookRow&, const Effect& effect) {
    if (effect.gate != Gate::always)
        object("a conductance to another temperature is always there: it takes no gate");
    placer.act_always();
    Input temperature{effect.shape.at, 0, -1};
    if (effect.driver != Driver::constant_temperature)
        temperature = {1, 0, placer.profile_row(profile_of(effect, placer.around()))};
    Building& building = placer.building();
    physics::Construction& wall = building.constructions.emplace_back();
    wall.name = placer.new_name();
    building.boundaries.push_back({wall.name, temperature});
    add_walls(building, wall.name);
    placer.set(
        {Part::construction, static_cast<int>(building.constructions.size()) - 1, 0},
        wall.u_value);
}

void add_second_mass(Placer& placer, const HookRow&, const Effect& effect) {
    if (effect.driver != Driver::one || effect.gate != Gate::always)
        object("a second mass is always there: it follows nothing");
    std::vector<physics::Zone>& zones = placer.building().zones;
    for (std::size_t z = 0; z < zones.size(); ++z) {
        physics::Structure& structure = zones[z].structure;
        if (structure.second_mass_conductance > 0)
            object("the model has a second mass already");
        structure.second_mass_capacity = 2 * zones[z].heat_capacity;
        placer.set({Part::zone, static_cast<int>(z), 0},
                   structure.second_mass_conductance);
    }
    placer.act_always();
}

}  // namespace bemcal::effects
