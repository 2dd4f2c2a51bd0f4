/// Compares the inputs of two versions of a building, step by step, and calls each by its
/// hook.
/// Follows from the fields' table; conductances, apertures, efficiencies and meters are
/// compared as factors, all others by differences.
/// Left out: what has no input (second mass), boundaries, water of radiators.
#include "effects/hook_series.hpp"

#include "effects/sites.hpp"
#include "effects/variants.hpp"
#include "physics/numbers.hpp"
#include "physics/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace bemcal::effects {
namespace {

using physics::Building;
using physics::Carrier;
using physics::Input;
using physics::Part;
using physics::Target;
using Series = std::vector<double>;

/// An input and the hook that it is at.
struct InputRow {
    Part part;
    std::string_view key;  ///< of the fields' table
    const char* hook;
    const char* unit;
    bool is_factor = false;
};

constexpr InputRow input_rows[] = {
    {Part::zone, "heating_set_point", "heating set-point", "K"},
    {Part::zone, "cooling_set_point", "cooling set-point", "K"},
    {Part::zone, "room_spread", "room spread", "K"},
    {Part::zone, "heating_available", "heating available", "-"},
    {Part::zone, "cooling_available", "cooling available", "-"},
    {Part::zone, "venting_air_change", "venting", "1/h"},
    {Part::zone, "supply_shift", "supply air", "K"},
    {Part::zone, "opaque_shift", "opaque boundary", "K"},
    {Part::zone, "window_shift", "window boundary", "K"},
    {Part::flow, "air_change", "infiltration", "1/h"},
    {Part::flow, "heat_recovery", "heat recovery", "-"},
    {Part::load, "density", "gains", "W/m2"},
    {Part::construction, "u_value", "opaque conductance", "-", true},
    {Part::glazing, "u_value", "window conductance", "-", true},
    {Part::window, "shading_factor", "aperture", "-", true},
    {Part::plant, "heating_efficiency", "heating efficiency", "-", true},
    {Part::plant, "cooling_cop", "cooling COP", "-", true},
    {Part::meter, "factor", "meter factor", "-", true},
    {Part::air_system, "economiser", "economiser", "-"},
    {Part::air_system, "outdoor_air_change", "ventilation", "-"},
    {Part::air_system, "supply_temperature", "supply temperature", "K"},
};

const InputRow* input_row_of(const Target& target) {
    const physics::Field& field = physics::field_of(target);
    const auto* found = std::ranges::find_if(input_rows, [&](const InputRow& row) {
        return row.part == target.part && row.key == field.key;
    });
    return found == std::end(input_rows) ? nullptr : found;
}

/// Whether the part that a target is in stands in the building.
bool is_there(const Building& building, const Target& target) {
    const auto index = static_cast<std::size_t>(target.index),
               inner = static_cast<std::size_t>(target.inner);
    switch (target.part) {
        case Part::construction:
            return index < building.constructions.size();
        case Part::glazing:
            return index < building.glazings.size();
        case Part::flow:
            return inner < building.zones[index].flows.size();
        case Part::load:
            return inner < building.zones[index].loads.size();
        case Part::window:
            return inner < building.zones[index].windows.size();
        default:
            return true;
    }
}

/// Hour by hour; zeros of a part that is not there. [hours]
Series hours_of(Building& building, const physics::Drive& drive, const Target& target) {
    const auto per_hour = 3600 / drive.axis.step_s;
    Series hours(
        static_cast<std::size_t>((drive.n_steps() - drive.n_warm_up) / per_hour));
    if (!is_there(building, target)) return hours;
    const Input& input = *physics::input_at(building, target);
    for (std::size_t h = 0; h < hours.size(); ++h) {
        const int first = drive.n_warm_up + static_cast<int>(h) * per_hour;
        for (int s = 0; s < per_hour; ++s) hours[h] += drive.at(input, first + s);
        hours[h] /= per_hour;
    }
    return hours;
}

/// 0 everywhere where nothing changes.
Series change_of(const InputRow& row, const Series& without, const Series& with) {
    constexpr double least_change = 1e-9;  ///< below it rounding alone is seen
    Series change(with.size());
    for (std::size_t h = 0; h < change.size(); ++h) {
        double value = with[h] - without[h];
        if (row.is_factor) value = without[h] == 0 ? 0 : value / without[h];
        if (std::abs(value) > least_change) change[h] = value;
    }
    return change;
}

bool is_nothing(const Series& series) {
    return std::ranges::all_of(series, [](double value) { return value == 0; });
}

std::string name_of_meter(Carrier carrier) {
    for (const physics::QuantityRow& row : physics::quantity_rows)
        if (row.carrier == carrier) return row.name;
    return "";
}

/// Which hook a load is at: what it heats, and what meters it.
void place_load(const physics::Load& load, HookSeries& series) {
    if (load.heat_fraction == 0) {
        series.hook = "meter addition";
        series.meter = name_of_meter(load.carrier);
    } else if (load.carrier == Carrier::electricity) {
        series.hook = "lights and equipment";
    }
}

/// [1/h] that all fans of a zone bring at most.
double full_flow(const Building& building) {
    const physics::Zone& zone = building.zones[0];
    double sum = 0;
    if (zone.air_system >= 0)
        sum = building.air_systems[static_cast<std::size_t>(zone.air_system)]
                  .outdoor_air_change.value;
    for (const physics::AirFlow& flow : zone.flows)
        if (is_fan(flow)) sum += flow.air_change.value;
    return sum;
}

/// By the parts of the target.
HookSeries placed_at(const InputRow& row, const Target& target,
                     const Building& building) {
    HookSeries series{row.hook, row.unit, row.is_factor, {}, {}};
    const auto index = static_cast<std::size_t>(target.index),
               inner = static_cast<std::size_t>(target.inner);
    if (row.part == Part::flow && is_fan(building.zones[index].flows[inner]))
        if (series.hook == "infiltration") series = {"ventilation", "-", false, {}, {}};
    if (series.hook == "venting")
        series.opens_above = building.zones[index].venting.opens_above;
    if (row.part == Part::load) place_load(building.zones[index].loads[inner], series);
    if (row.part == Part::window) {
        const int plane = building.zones[index].windows[inner].plane;
        series.facade = name_of_facade(building.planes[static_cast<std::size_t>(plane)]);
    }
    if (row.part == Part::meter)
        series.meter = physics::name_of(static_cast<physics::Quantity>(target.index));
    return series;
}

/// By a flow; nothing flows where it is 0.
void divide(Series& series, double by) {
    for (double& value : series) value = by > 0 ? value / by : 0;
}

void add_to(Series& sum, const Series& more) {
    for (std::size_t h = 0; h < sum.size(); ++h) sum[h] += more[h];
}

/// Loads and flows at a hook add up; of others one stands for all.
void take(std::vector<HookSeries>& all, HookSeries series, bool adds_up) {
    const auto known = std::ranges::find_if(
        all, [&](const HookSeries& one) { return is_same_place(one, series); });
    if (known == all.end())
        all.push_back(std::move(series));
    else if (adds_up)
        add_to(known->values, series.values);
}

/// Facades that change alike are one: all of them.
void join_facades(std::vector<HookSeries>& all, std::size_t n_facades) {
    const auto first = std::ranges::find(all, "aperture", &HookSeries::hook);
    if (first == all.end()) return;
    const Series values = first->values;
    const auto is_alike = [&](const HookSeries& one) {
        return one.hook == "aperture" && one.values == values;
    };
    if (static_cast<std::size_t>(std::ranges::count_if(all, is_alike)) != n_facades)
        return;
    HookSeries whole = *first;
    whole.facade.clear();
    std::erase_if(all, is_alike);
    all.push_back(std::move(whole));
}

std::size_t n_facades_of(const Building& building) {
    std::vector<std::string> names;
    for (const physics::Window& window : building.zones[0].windows) {
        const auto plane = static_cast<std::size_t>(window.plane);
        std::string name = name_of_facade(building.planes[plane]);
        if (std::ranges::find(names, name) == names.end())
            names.push_back(std::move(name));
    }
    return names.size();
}

bool is_of_other_zone(const Target& target) {
    const bool is_in_zone = target.part == Part::zone || target.part == Part::flow ||
                            target.part == Part::load || target.part == Part::window;
    return is_in_zone && target.index != 0;
}

}  // namespace

std::vector<std::string> hooks_of_series() {
    std::vector<std::string> hooks = {"ventilation", "meter addition",
                                      "lights and equipment"};  // by their parts
    for (const InputRow& row : input_rows)
        if (std::ranges::find(hooks, row.hook) == hooks.end())
            hooks.emplace_back(row.hook);
    return hooks;
}

std::vector<HookSeries> changes_between(const Version& without, const Version& with) {
    std::vector<HookSeries> all;
    Building before = without.building, after = with.building;  // input_at() may write
    for (const Target& target : physics::inputs_of(with.building)) {
        const InputRow* row = input_row_of(target);
        if (row == nullptr || is_of_other_zone(target)) continue;
        if (row->is_factor && !is_there(without.building, target)) continue;
        Series change = change_of(*row, hours_of(before, without.drive, target),
                                  hours_of(after, with.drive, target));
        if (is_nothing(change)) continue;
        HookSeries series = placed_at(*row, target, with.building);
        series.values = std::move(change);
        if (series.hook == "ventilation")
            divide(series.values, full_flow(without.building));
        take(all, std::move(series), row->part == Part::load || row->part == Part::flow);
    }
    join_facades(all, n_facades_of(with.building));
    return all;
}

void append(std::vector<HookSeries>& all, std::size_t n_before,
            std::vector<HookSeries> more, std::size_t n_more) {
    for (HookSeries& series : more) {
        const auto known = std::ranges::find_if(
            all, [&](const HookSeries& one) { return is_same_place(one, series); });
        if (known != all.end()) {
            known->values.insert(known->values.end(), series.values.begin(),
                                 series.values.end());
            continue;
        }
        series.values.insert(series.values.begin(), n_before, 0.0);
        all.push_back(std::move(series));
    }
    for (HookSeries& series : all) series.values.resize(n_before + n_more, 0.0);
}

}  // namespace bemcal::effects
