/// The loop over the steps of a period: warm-up first, then what is recorded.
/// Source: ISO 13790:2008, Annex C. A step is left to stepper.cpp, meters to meters.cpp.
#include "physics/simulate.hpp"

#include "physics/stepper.hpp"

namespace bemcal::physics {

namespace {

void record(const StepResult& result, ZoneTrajectory& zone) {
    zone.theta_air.push_back(result.theta.theta_air);
    zone.theta_op.push_back(result.theta.theta_op);
    zone.theta_m.push_back(result.theta.theta_m_t);
    zone.heating.push_back(result.phi_heating);
    zone.cooling.push_back(result.phi_cooling);
    zone.fan.push_back(result.phi_fan);
}

}  // namespace

Trajectory simulate(const Building& building, const Drive& drive) {
    Stepper stepper(building, drive);
    Trajectory trajectory;
    trajectory.zones.resize(building.zones.size());
    for (int step = 0; step < drive.n_steps(); ++step) {
        const auto results = stepper.advance(step);
        if (step < drive.n_warm_up) continue;
        for (std::size_t zone = 0; zone < results.size(); ++zone)
            record(results[zone], trajectory.zones[zone]);
    }
    return trajectory;
}

}  // namespace bemcal::physics
