/// Simulates a building once, and adds its zones' powers up. The warm-up, of which no
/// trajectory tells, repeats the first steps.
/// Follows from physics::simulate.
/// Left out: what effects that follow loads would do to them (HookRow::leaves_loads).
#include "effects/loads.hpp"

#include "physics/simulate.hpp"

#include <algorithm>

namespace bemcal::effects {
namespace {

std::vector<double> on_all_steps(const physics::Trajectory& trajectory,
                                 std::vector<double> physics::ZoneTrajectory::* power,
                                 const physics::Drive& drive) {
    const auto n = static_cast<std::size_t>(drive.n_steps()),
               before = static_cast<std::size_t>(drive.n_warm_up);
    std::vector<double> sums(n, 0.0);
    for (const physics::ZoneTrajectory& zone : trajectory.zones)
        for (std::size_t k = 0; k < n; ++k)
            sums[k] += (zone.*power)[k < before ? k % (n - before) : k - before];
    return sums;
}

}  // namespace

ModelSeries loads_of(const physics::Building& building, const physics::Drive& drive) {
    const physics::Trajectory trajectory = physics::simulate(building, drive);
    ModelSeries series;
    series.heating = on_all_steps(trajectory, &physics::ZoneTrajectory::heating, drive);
    series.cooling = on_all_steps(trajectory, &physics::ZoneTrajectory::cooling, drive);
    series.most_heating = *std::ranges::max_element(series.heating);
    series.most_cooling = *std::ranges::max_element(series.cooling);
    return series;
}

ModelSeries no_loads(const physics::Drive& drive) {
    const std::vector<double> none(static_cast<std::size_t>(drive.n_steps()), 0.0);
    return {none, none, 0, 0};
}

}  // namespace bemcal::effects
