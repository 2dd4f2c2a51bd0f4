/// Puts effects into a building: each becomes a profile, changes of the inputs that its
/// hook names or a part that is added, and one parameter whose targets are all of them.
/// Follows from physics::Change. Ranges are twice what is plausible, cut where physics
/// ends. Left out: fitting; a neighbour and a second mass take no gate; an added mass is
/// twice the first.
#include "effects/placement.hpp"

#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "effects/levels.hpp"
#include "effects/schedules.hpp"
#include "physics/meters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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
    throw std::invalid_argument(why);
}

bool all_zero(const Series& series) {
    return std::all_of(series.begin(), series.end(), [](double x) { return x == 0; });
}

/// A range about 0: twice as wide as what is plausible, cut where physics ends.
struct Range {
    double least, most;
};

/// Shares that keep 1 + coefficient x profile above 0.
Range positive_share(Range range, const Series& profile) {
    const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
    if (*most > 0) range.least = std::max(range.least, -0.95 / *most);
    if (*least < 0) range.most = std::min(range.most, -0.95 / *least);
    return range;
}

Range range_of(const Effect& effect, const Series& profile) {
    const double most = 2 * std::max(std::abs(effect.least), std::abs(effect.most));
    switch (effect.hook) {
        case Hook::venting:
        case Hook::neighbour:
        case Hook::second_mass:
            return {0, most};
        case Hook::heat_recovery:
            return {-1, 1};
        case Hook::operation:
        case Hook::occupation:
        case Hook::plant_operation:
            return {-std::min(most, 1.5), std::min(most, 1.5)};
        default:
            break;
    }
    const bool is_share = kind_of(effect.hook) == physics::ChangeKind::factor;
    return is_share ? positive_share({-most, most}, profile) : Range{-most, most};
}

/// Puts effects into a building, one after the other; the drive is made at the end.
class Placer {
  public:
    explicit Placer(const Surroundings& around)
        : around_(around), building_(*around.building) {}

    void put(const Effect& effect);
    Placed finish();
    /// Whether anything that was put has a say at any step.
    bool acts() const {
        return !std::all_of(rows_.begin(), rows_.end(), all_zero) || acts_without_row_;
    }

  private:
    void enter(const Effect& effect);
    void put_changes(const Effect& effect);
    void put_sunlit_windows(const Effect& effect);
    void put_leakage(const Effect& effect);
    void put_venting(const Effect& effect);
    void put_schedules(const Effect& effect, Scheduled which);
    void put_load(const Effect& effect, Carrier carrier, double heat_fraction);
    void put_neighbour(const Effect& effect);
    void put_second_mass(const Effect& effect);

    /// The row of Drive::profiles with this series, appended where it is new.
    int row_of(Series series);
    void change(Target target, physics::ChangeKind kind, int row);
    /// A number that is the coefficient itself.
    void set(Target part, const double& number) {
        parameter().targets.push_back(target_of(building_, part, number));
    }
    void set_value(Target part, const Input& input) {
        Target target = target_of(building_, part, input);
        target.slot = physics::Slot::value;
        parameter().targets.push_back(target);
    }
    physics::Parameter& parameter() { return parameters_.back(); }
    bool is_used(const std::string& name) const {
        return std::any_of(parameters_.begin(), parameters_.end(),
                           [&](const auto& parameter) { return parameter.name == name; });
    }
    std::string new_name() const { return fmt::format("effect_{}", parameters_.size()); }

    const Surroundings& around_;
    Building building_;
    std::vector<Series> rows_;
    std::vector<physics::Parameter> parameters_;
    bool acts_without_row_ = false;
};

int Placer::row_of(Series series) {
    const auto found = std::find(rows_.begin(), rows_.end(), series);
    const auto row = static_cast<std::size_t>(found - rows_.begin());
    if (found == rows_.end()) rows_.push_back(std::move(series));
    return static_cast<int>(around_.drive->profiles.rows + row);
}

void Placer::change(Target target, physics::ChangeKind kind, int row) {
    auto& changes = physics::input_at(building_, target)->changes;
    const auto free = std::find_if(changes.begin(), changes.end(),
                                   [](const auto& one) { return one.profile < 0; });
    if (free == changes.end())
        object(fmt::format("{} effects change the same input already",
                           physics::most_changes));
    *free = {0, row, kind};
    target.change = static_cast<int>(free - changes.begin());
    parameter().targets.push_back(target);
}

void Placer::put_changes(const Effect& effect) {
    Series profile = profile_of(effect, around_);
    if (shapes_regimes(effect.hook)) profile = levelled(profile, most_levels);
    const int row = row_of(std::move(profile));
    for (const Target& target : sites_of(effect, building_))
        change(target, kind_of(effect.hook), row);
}

/// Windows of every facade, each by its own sun.
void Placer::put_sunlit_windows(const Effect& effect) {
    for (const Target& target : sites_of(effect, building_)) {
        const physics::Zone& zone =
            building_.zones[static_cast<std::size_t>(target.index)];
        Effect facade = effect;
        facade.place = zone.windows[static_cast<std::size_t>(target.inner)].plane;
        const int row = row_of(levelled(profile_of(facade, around_), most_levels));
        change(target, kind_of(effect.hook), row);
    }
}

/// Of each zone's declared infiltration, whatever a parameter makes of it.
void Placer::put_leakage(const Effect& effect) {
    const Series profile = levelled(profile_of(effect, around_), most_levels);
    for (const Target& target : sites_of(effect, building_)) {
        Series leak = profile;
        for (double& value : leak) value *= physics::input_at(building_, target)->value;
        change(target, kind_of(effect.hook), row_of(std::move(leak)));
    }
}

void Placer::put_venting(const Effect& effect) {
    if (effect.driver != Driver::one)
        object("openings follow the room and a gate, no other driver");
    for (physics::Zone& zone : building_.zones) {
        physics::Venting& venting = zone.venting;
        const bool used = venting.air_change.value > 0 || venting.air_change.is_changed();
        if (used && effect.shape.at > 0 && venting.opens_above != effect.shape.at)
            object(fmt::format("there are openings already, which open above {} degC",
                               venting.opens_above));
        if (effect.shape.at > 0) venting.opens_above = effect.shape.at;
    }
    put_changes(effect);
}

void Placer::put_schedules(const Effect& effect, Scheduled which) {
    if (effect.driver != Driver::another_day && effect.driver != Driver::shifted_hours)
        object("schedules move to another day or hour, and by no other driver");
    const physics::Drive& drive = *around_.drive;
    const Series gate = gate_of(effect, around_);
    for (const Target& target : scheduled_sites(building_, which)) {
        const auto profile =
            static_cast<std::size_t>(physics::input_at(building_, target)->profile);
        if (profile >= drive.profiles.rows) continue;  // of a load that an effect added
        const auto own = drive.profiles.row(profile);
        if (!is_schedule(own, drive)) continue;
        Series moved = effect.driver == Driver::another_day
                           ? as_on(static_cast<int>(effect.shape.at), own, drive)
                           : later_by(effect.shape.at, own, drive);
        for (std::size_t k = 0; k < moved.size(); ++k)
            moved[k] = gate[k] * (moved[k] - own[k]);
        if (all_zero(moved)) continue;
        if (which == Scheduled::plant) moved = levelled(moved, most_levels);
        change(target, physics::ChangeKind::schedule, row_of(std::move(moved)));
    }
}

void Placer::put_load(const Effect& effect, Carrier carrier, double heat_fraction) {
    const int row = row_of(profile_of(effect, around_));
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        std::vector<physics::Load>& loads = building_.zones[z].loads;
        physics::Load& load = loads.emplace_back();
        load.name = new_name();
        load.density.profile = row;
        load.carrier = carrier;
        load.heat_fraction = heat_fraction;
        set_value({Part::load, static_cast<int>(z), static_cast<int>(loads.size()) - 1},
                  load.density);
    }
}

void Placer::put_neighbour(const Effect& effect) {
    if (effect.gate != Gate::always)
        object("a conductance to another temperature is always there: it takes no gate");
    acts_without_row_ = true;
    Input temperature{effect.shape.at, 0, -1};
    if (effect.driver != Driver::constant_temperature)
        temperature = {1, 0, row_of(profile_of(effect, around_))};
    physics::Construction& wall = building_.constructions.emplace_back();
    wall.name = new_name();
    building_.boundaries.push_back({wall.name, temperature});
    for (physics::Zone& zone : building_.zones) {
        physics::Surface& surface = zone.surfaces.emplace_back();
        surface.name = wall.name;
        surface.construction = static_cast<int>(building_.constructions.size()) - 1;
        surface.area = zone.floor_area;
        surface.boundary = static_cast<int>(building_.boundaries.size()) - 1;
        surface.in_sun = false;
    }
    set_value(
        {Part::construction, static_cast<int>(building_.constructions.size()) - 1, 0},
        wall.u_value);
}

void Placer::put_second_mass(const Effect& effect) {
    if (effect.driver != Driver::one || effect.gate != Gate::always)
        object("a second mass is always there: it follows nothing");
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        physics::Zone& zone = building_.zones[z];
        if (zone.structure.second_mass_conductance > 0)
            object("the model has a second mass already");
        zone.structure.second_mass_capacity = 2 * zone.heat_capacity;
        set({Part::zone, static_cast<int>(z), 0}, zone.structure.second_mass_conductance);
    }
    acts_without_row_ = true;
}

/// The carrier of the meter that an addition is on.
Carrier carrier_of(const Effect& effect) {
    const bool is_meter = effect.place > 0 && effect.place < 6;
    const Carrier carrier =
        is_meter ? physics::carrier_of(static_cast<physics::Quantity>(effect.place))
                 : Carrier::none;
    if (carrier == Carrier::none)
        object("it needs a meter of electricity, gas or district heat as its place");
    return carrier;
}

bool follows_own_sun(const Effect& effect) {
    const bool of_sun =
        effect.driver == Driver::bright || effect.driver == Driver::sun_on_facade;
    return effect.hook == Hook::aperture && effect.place < 0 && of_sun;
}

void Placer::put(const Effect& effect) {
    const Range range = range_of(effect, profile_of(effect, around_));
    physics::Parameter coefficient;
    coefficient.name = is_used(effect.name)
                           ? fmt::format("{}: {}", effect.name, sentence_of(effect))
                           : effect.name;
    coefficient.unit = unit_of(effect);
    coefficient.least = range.least;
    coefficient.most = range.most;
    parameters_.push_back(std::move(coefficient));
    enter(effect);
}

void Placer::enter(const Effect& effect) {
    switch (effect.hook) {
        case Hook::gains:
            return put_load(effect, Carrier::none, 1);
        case Hook::lights_and_equipment:
            return put_load(effect, Carrier::electricity, 1);
        case Hook::meter_addition:
            return put_load(effect, carrier_of(effect), 0);
        case Hook::neighbour:
            return put_neighbour(effect);
        case Hook::second_mass:
            return put_second_mass(effect);
        case Hook::leakage:
            return put_leakage(effect);
        case Hook::venting:
            return put_venting(effect);
        case Hook::operation:
            put_schedules(effect, Scheduled::loads);
            return put_schedules(effect, Scheduled::plant);
        case Hook::occupation:
            return put_schedules(effect, Scheduled::loads);
        case Hook::plant_operation:
            return put_schedules(effect, Scheduled::plant);
        default:
            return follows_own_sun(effect) ? put_sunlit_windows(effect)
                                           : put_changes(effect);
    }
}

Placed Placer::finish() {
    physics::Drive drive = *around_.drive;
    Matrix profiles(drive.profiles.rows + rows_.size(),
                    static_cast<std::size_t>(drive.n_steps()));
    std::copy(drive.profiles.values.begin(), drive.profiles.values.end(),
              profiles.values.begin());
    for (std::size_t k = 0; k < rows_.size(); ++k)
        std::copy(rows_[k].begin(), rows_[k].end(),
                  profiles.row(drive.profiles.rows + k).begin());
    drive.profiles = std::move(profiles);
    return {std::move(building_), std::move(drive), std::move(parameters_)};
}

}  // namespace

Placed place(std::span<const Effect> effects, const Surroundings& around) {
    Placer placer(around);
    for (const Effect& effect : effects) try {
            placer.put(effect);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(
                fmt::format("effect '{}': {}", effect.name, error.what()));
        }
    return placer.finish();
}

std::optional<std::string> objection(const Effect& effect, const Surroundings& around) {
    Placer placer(around);
    try {
        placer.put(effect);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    if (!placer.acts()) return "it has no say at any step of this period";
    return std::nullopt;
}

}  // namespace bemcal::effects
