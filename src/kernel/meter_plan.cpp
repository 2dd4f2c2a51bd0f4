/// Which profiles a meter's form follows, and so the steps in which it is the same: those
/// of the plant on its carrier, of the loads on it, of the meter's factor.
/// Follows from meter_form (meters). Values are left to meter_rows; the steps of a zone
/// are sorted in zone_plan.
#include "kernel/input_profiles.hpp"
#include "kernel/plan.hpp"

#include <algorithm>

namespace bemcal::kernel {

namespace {

/// Of the loads on the carrier.
std::vector<int> load_profiles(const physics::Building& building,
                               physics::Carrier carrier) {
    std::vector<int> profiles;
    if (carrier == physics::Carrier::none) return profiles;
    for (const physics::Zone& zone : building.zones)
        for (const physics::Load& load : zone.loads)
            if (load.carrier == carrier)
                for (const physics::Input* input : {&load.density, &load.efficiency})
                    add_profiles(profiles, *input);
    return profiles;
}

/// Of the plant, if the carrier is its own, and of the meter's factor.
std::vector<int> share_profiles(const physics::Building& building,
                                physics::Quantity quantity) {
    std::vector<int> profiles;
    if (quantity == physics::Quantity::air_temperature) return profiles;
    add_profiles(profiles, building.meter_factor[static_cast<std::size_t>(quantity)]);
    const physics::Carrier carrier = physics::carrier_of(quantity);
    if (carrier == physics::Carrier::none) return profiles;
    const physics::Plant& plant = building.plant;
    if (plant.heating_carrier == carrier)
        add_profiles(profiles, plant.heating_efficiency);
    if (plant.cooling_carrier == carrier) add_profiles(profiles, plant.cooling_cop);
    return profiles;
}

bool has_factor(const Nominal& nominal, physics::Quantity quantity) {
    const auto q = static_cast<std::size_t>(quantity);
    const physics::Input& factor = nominal.building.meter_factor[q];
    const auto is_it = [&](const physics::Target& target) {
        return target.part == physics::Part::meter &&
               static_cast<std::size_t>(target.index) == q;
    };
    return factor.value != 1 || factor.profile >= 0 || factor.is_changed() ||
           std::ranges::any_of(nominal.parameters,
                               [&](const physics::Parameter& parameter) {
                                   return std::ranges::any_of(parameter.targets, is_it);
                               });
}

}  // namespace

MeterPlan plan_meter(const Nominal& nominal, physics::Quantity quantity,
                     ProfileClasses& classes) {
    const std::vector<int> of_shares = share_profiles(nominal.building, quantity);
    MeterPlan plan;
    plan.shares_vary = !of_shares.empty();
    plan.has_factor = has_factor(nominal, quantity);
    plan.rows =
        classes.refine(classes.refine(one_class(nominal.drive.n_steps()), of_shares),
                       load_profiles(nominal.building, physics::carrier_of(quantity)));
    plan.row_offset = offsets_of(plan.rows, 3 * nominal.lanes);
    return plan;
}

void plan_mixed(const ZonePlan& zone, int lanes, MeterPlan& meter) {
    meter.mixed = both(zone.rows, meter.rows);
    meter.mixed_offset = offsets_of(meter.mixed, MixedColumn::count * lanes);
}

}  // namespace bemcal::kernel
