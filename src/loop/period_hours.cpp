/// Builds a calibrated model anew over a period, and simulates it there.
/// Follows from `make_place` and `build`: parameters keep the values that training gave
/// them, functions their values at points of what they follow.
#include "loop/period_hours.hpp"

#include "base/error.hpp"
#include "loop/find_functions.hpp"
#include "loop/loads.hpp"
#include "physics/simulate.hpp"

#include <cmath>

namespace bemcal::loop {
namespace {

/// Throws what the plain simulation says of a point that is impossible.
void say_why_impossible(const BuiltModel& built, const std::vector<double>& values) {
    physics::simulate(building_at(built, values), built.placed->drive);
    throw CannotSimulate("the model cannot be simulated there");
}

}  // namespace

Place place_in(const LoopData& data, const Standing& standing,
               const std::vector<FoundFunction>& functions,
               std::shared_ptr<const physics::Drive> drive) {
    Place place = make_place(data, standing.model.structure, std::move(drive));
    if (follow_loads(data, standing.model, functions))
        know_its_loads(data, place, standing, functions);
    else
        add_functions(place, functions);
    return place;
}

std::vector<std::vector<double>> hours_of(
    const LoopData& data, const Standing& standing,
    const std::vector<FoundFunction>& functions,
    const std::shared_ptr<const physics::Drive>& drive) {
    Place place = place_in(data, standing, functions, drive);
    for (kernel::Channel& channel : place.channels)
        channel.interval = physics::Interval::hourly;
    const BuiltModel built = build(place, standing.model.effects);
    Matrix point(1, built.unknowns.size());
    point.values = values_in(built, standing);
    const Matrix predicted = built.fit_model->predict(point);
    if (std::isnan(predicted(0, 0))) say_why_impossible(built, point.values);
    std::vector<std::vector<double>> hours;
    const auto& first = built.fit_model->first();
    for (std::size_t c = 0; c + 1 < first.size(); ++c)
        hours.emplace_back(predicted.values.begin() + static_cast<long>(first[c]),
                           predicted.values.begin() + static_cast<long>(first[c + 1]));
    return hours;
}

}  // namespace bemcal::loop
