/// From adjoints of a meter's form to those of the plant, the loads and the meter's
/// factor.
/// Follows from meters.cpp: its quotients and products in reverse. It does not check
/// values again; what meter_form rejects never gets here.
#include "adjoint/meters_adjoint.hpp"

#include "adjoint/network_adjoint.hpp"

namespace bemcal::adjoint {

namespace {

/// Of power / efficiency.
struct QuotientBack {
    double power, efficiency;
};

QuotientBack pull_quotient(double power, double efficiency, double g) {
    return {g / efficiency, -g * power / (efficiency * efficiency)};
}

/// Of floor_area density / efficiency.
void pull_load(const physics::Zone& zone, const physics::Load& load,
               const physics::Drive& drive, int step, double of_source,
               physics::Zone& of_zone, physics::Load& of_load) {
    const double density = drive.at(load.density, step);
    const QuotientBack of = pull_quotient(zone.floor_area * density,
                                          drive.at(load.efficiency, step), of_source);
    of_zone.floor_area += of.power * density;
    pull_input(load.density, drive, step, of.power * zone.floor_area, of_load.density);
    pull_input(load.efficiency, drive, step, of.efficiency, of_load.efficiency);
}

void pull_efficiency(const physics::Input& efficiency, const physics::Drive& drive,
                     int step, double of_inverse, physics::Input& of_efficiency) {
    pull_input(efficiency, drive, step,
               pull_quotient(1, drive.at(efficiency, step), of_inverse).efficiency,
               of_efficiency);
}

}  // namespace

physics::MeterForm pull_meter_factor(const physics::Building& building,
                                     const physics::Drive& drive,
                                     physics::Quantity quantity, int step,
                                     const physics::MeterForm& of_form,
                                     physics::Building& of_building) {
    const auto q = static_cast<std::size_t>(quantity);
    const physics::Input& factor = building.meter_factor[q];
    const physics::MeterForm form =
        physics::true_meter_form(building, drive, quantity, step);
    pull_input(factor, drive, step,
               of_form.per_heating * form.per_heating +
                   of_form.per_cooling * form.per_cooling + of_form.source * form.source +
                   of_form.per_fan * form.per_fan +
                   of_form.per_lost_heating * form.per_lost_heating +
                   of_form.per_lost_cooling * form.per_lost_cooling,
               of_building.meter_factor[q]);
    const double shown = drive.at(factor, step);
    return {of_form.per_heating * shown,      of_form.per_cooling * shown,
            of_form.source * shown,           of_form.per_fan * shown,
            of_form.per_lost_heating * shown, of_form.per_lost_cooling * shown};
}

void pull_meter_form(const physics::Building& building, const physics::Drive& drive,
                     physics::Quantity quantity, int step,
                     const physics::MeterForm& of_form, physics::Building& of_building) {
    const physics::Carrier carrier = physics::carrier_of(quantity);
    if (carrier == physics::Carrier::none) return;
    const physics::Plant& plant = building.plant;
    physics::Plant& of_plant = of_building.plant;
    if (plant.heating_carrier == carrier)
        pull_efficiency(plant.heating_efficiency, drive, step,
                        of_form.per_heating + of_form.per_lost_heating,
                        of_plant.heating_efficiency);
    if (plant.cooling_carrier == carrier)
        pull_efficiency(plant.cooling_cop, drive, step,
                        of_form.per_cooling + of_form.per_lost_cooling,
                        of_plant.cooling_cop);
    if (carrier == physics::Carrier::electricity) {
        of_plant.heating_auxiliary += of_form.per_heating;
        of_plant.cooling_auxiliary += of_form.per_cooling;
    }
    for (std::size_t z = 0; z < building.zones.size(); ++z)
        for (std::size_t k = 0; k < building.zones[z].loads.size(); ++k)
            if (building.zones[z].loads[k].carrier == carrier)
                pull_load(building.zones[z], building.zones[z].loads[k], drive, step,
                          of_form.source, of_building.zones[z],
                          of_building.zones[z].loads[k]);
}

}  // namespace bemcal::adjoint
