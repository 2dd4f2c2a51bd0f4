/// Gives effects of part load what they follow: heating and cooling of the calibrated
/// model over a period, scaled by the largest in training.
/// Follows from a simulation without effects: no series may depend on what follows it.
/// How effects change the load is left out. The warm-up repeats the first steps.
#include "loop/loads.hpp"

#include "base/error.hpp"
#include "physics/simulate.hpp"

#include <algorithm>

namespace bemcal::loop {
namespace {

/// Sums over zones. The warm-up, of which no trajectory tells, repeats the first steps.
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

void know_loads(Place& place, const Standing& calibrated) {
    const BuiltModel built = place_only(place, {});
    effects::ModelSeries& series = place.surroundings->model;
    try {
        const auto trajectory = physics::simulate(
            building_at(built, values_in(built, calibrated)), built.placed->drive);
        series.heating = on_all_steps(trajectory, &physics::ZoneTrajectory::heating,
                                      built.placed->drive);
        series.cooling = on_all_steps(trajectory, &physics::ZoneTrajectory::cooling,
                                      built.placed->drive);
    } catch (const CannotSimulate&) {
        series = {};
        return;
    }
    series.most_heating = *std::ranges::max_element(series.heating);
    series.most_cooling = *std::ranges::max_element(series.cooling);
}

void know_loads(Place& place, const Standing& calibrated,
                const effects::ModelSeries& in_training) {
    know_loads(place, calibrated);
    place.surroundings->model.most_heating = in_training.most_heating;
    place.surroundings->model.most_cooling = in_training.most_cooling;
}

}  // namespace bemcal::loop
