/// Which inputs a meter's form follows.
#include "physics/input_profiles.hpp"
#include "physics/plan.hpp"

#include <algorithm>

namespace bemcal::physics {

namespace {

/// Of the loads on the carrier.
std::vector<int> load_profiles(const Building& building, Carrier carrier) {
    std::vector<int> profiles;
    if (carrier == Carrier::none) return profiles;
    for (const Zone& zone : building.zones)
        for (const Load& load : zone.loads)
            if (load.carrier == carrier)
                for (const Input* input : {&load.density, &load.efficiency})
                    add_profiles(profiles, *input);
    return profiles;
}

/// Of the plant, if the carrier is its own, and of the meter's factor.
std::vector<int> share_profiles(const Building& building, Quantity quantity) {
    std::vector<int> profiles;
    if (quantity == Quantity::air_temperature) return profiles;
    add_profiles(profiles, building.meter_factor[static_cast<std::size_t>(quantity)]);
    const Carrier carrier = carrier_of(quantity);
    if (carrier == Carrier::none) return profiles;
    const Plant& plant = building.plant;
    if (plant.heating_carrier == carrier)
        add_profiles(profiles, plant.heating_efficiency);
    if (plant.cooling_carrier == carrier) add_profiles(profiles, plant.cooling_cop);
    return profiles;
}

bool has_factor(const Nominal& nominal, Quantity quantity) {
    const auto q = static_cast<std::size_t>(quantity);
    const Input& factor = nominal.building.meter_factor[q];
    const auto is_it = [&](const Target& target) {
        return target.part == Part::meter && static_cast<std::size_t>(target.index) == q;
    };
    return factor.value != 1 || factor.profile >= 0 || factor.is_changed() ||
           std::ranges::any_of(nominal.parameters, [&](const Parameter& parameter) {
               return std::ranges::any_of(parameter.targets, is_it);
           });
}

}  // namespace

MeterPlan plan_meter(const Nominal& nominal, Quantity quantity, ProfileClasses& classes) {
    const std::vector<int> of_shares = share_profiles(nominal.building, quantity);
    MeterPlan plan;
    plan.shares_vary = !of_shares.empty();
    plan.has_factor = has_factor(nominal, quantity);
    plan.rows =
        classes.refine(classes.refine(one_class(nominal.drive.n_steps()), of_shares),
                       load_profiles(nominal.building, carrier_of(quantity)));
    plan.row_offset = offsets_of(plan.rows, 3 * nominal.lanes);
    return plan;
}

void plan_mixed(const ZonePlan& zone, int lanes, MeterPlan& meter) {
    meter.mixed = both(zone.rows, meter.rows);
    meter.mixed_offset = offsets_of(meter.mixed, kernel::MixedColumn::count * lanes);
}

}  // namespace bemcal::physics
