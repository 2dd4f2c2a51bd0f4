/// A zone's step with a radiator: made twice, with the room as the step before left it,
/// then with the temperatures that this gave; water by the curve or as measured.
/// Follows from radiator and the hour's equations; two passes are our own choice. Left
/// out: iteration to convergence, thermostatic valves, losses of pipes.
#include "physics/zone_radiator.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <string>

namespace bemcal::physics {

RadiatorRun::RadiatorRun(const ZoneRadiator& radiator, double theta_start)
    : radiator_(&radiator), theta_air_(theta_start), theta_surface_(theta_start) {
    const std::string complaint = complaint_about(radiator.radiator);
    if (!complaint.empty()) throw CannotSimulate(complaint);
    elements_.assign(static_cast<std::size_t>(radiator.radiator.n_elements), theta_start);
}

/// The water that flows in, and the room before the step.
RadiatorSurroundings RadiatorRun::surroundings(const Drive& drive, int step) const {
    RadiatorSurroundings around{theta_air_, 0, theta_air_, theta_surface_};
    if (drive.at(radiator_->measured, step) > 0.5) {
        around.supply = drive.at(radiator_->supply_temperature, step);
        around.opening = drive.at(radiator_->flow, step);
        return around;
    }
    const auto supply =
        supply_temperature(radiator_->curve, drive.at(radiator_->scheduled, step) > 0.5,
                           drive.theta_e[static_cast<std::size_t>(step)], theta_air_);
    if (!supply) return around;
    around.supply = *supply;
    around.opening = 1;
    return around;
}

void RadiatorRun::write_state(std::span<double> state) const {
    std::ranges::copy(elements_, state.begin());
    state[elements_.size()] = theta_air_;
    state[elements_.size() + 1] = theta_surface_;
}

void RadiatorRun::set_state(std::span<const double> state) {
    std::ranges::copy(state.first(elements_.size()), elements_.begin());
    theta_air_ = state[elements_.size()];
    theta_surface_ = state[elements_.size() + 1];
}

StepResult RadiatorRun::advance(const Drive& drive, int step, HourDrive hour,
                                const Room& room) {
    RadiatorSurroundings around = surroundings(drive, step);
    const std::vector<double> before = elements_;
    StepResult result;
    RadiatorHeat heat;
    for (int pass = 0; pass < 2; ++pass) {
        elements_ = before;
        heat =
            physics::advance(radiator_->radiator, around, drive.axis.step_s, elements_);
        hour.phi_convective = heat.convective;
        hour.phi_radiant = heat.radiative;
        result = room(hour);
        around.air = result.theta.theta_air;
        around.radiant = result.theta.theta_s;
    }
    theta_air_ = around.air;
    theta_surface_ = around.radiant;
    result.phi_heating = std::max(heat.from_water, 0.0);
    return result;
}

}  // namespace bemcal::physics
