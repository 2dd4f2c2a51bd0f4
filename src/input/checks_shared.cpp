/// Finds meters that are one meter, within a building or in several: pairs that keep one
/// ratio in over 90 % of their common readings. It is stated at both.
/// Follows from `proportion_of`, over every pair.
/// Leaves out air temperatures, steps over an hour, and sums of several meters. A stock
/// compares daily sums (`find_shared_meters`).
#include "input/checks.hpp"
#include "input/data_shared.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using study::Case;
using study::Meter;

constexpr double least_share = 0.9;

bool can_be_shared(const Meter& meter) {
    return !physics::is_temperature(meter.quantity) && meter.axis.step_s <= 3600 &&
           study::has_reading(meter.values);
}

/// Of the steps that both meters cover.
Proportion proportion_of(const Meter& a, const Meter& b) {
    if (a.axis.step_s != b.axis.step_s ||
        (a.axis.start - b.axis.start).count() % a.axis.step_s != 0)
        return {};
    const auto from = std::max(a.axis.start, b.axis.start);
    const auto to = std::min(a.axis.end(), b.axis.end());
    if (from >= to) return {};
    const auto n = static_cast<std::size_t>((to - from).count() / a.axis.step_s);
    const auto part = [&](const Meter& meter) {
        return std::span(meter.values)
            .subspan(static_cast<std::size_t>(meter.axis.step_of(from)), n);
    };
    return input::proportion_of(part(a), part(b));
}

/// One meter of one building.
struct Place {
    Case* building;
    const Meter* meter;
    std::string name(const Case& seen_from) const {
        return building == &seen_from
                   ? meter->name
                   : fmt::format("{} of {}", meter->name, building->name);
    }
};

void note(const Place& at, const Place& with, double ratio, const Proportion& found) {
    at.building->decisions.push_back(
        {at.meter->name,
         fmt::format("shared with {}: {:.4g} times its reading in {:.1f} % of {} hours",
                     with.name(*at.building), ratio, 100 * found.share, found.n),
         "kept; it may be one meter's share"});
}

}  // namespace

void check_shared_meters(std::vector<Case>& buildings) {
    std::vector<Place> places;
    for (Case& building : buildings)
        for (const Meter& meter : building.meters)
            if (can_be_shared(meter)) places.push_back({&building, &meter});
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = i + 1; j < places.size(); ++j) {
            const auto found = proportion_of(*places[i].meter, *places[j].meter);
            if (found.n == 0 || found.share <= least_share) continue;
            note(places[i], places[j], 1 / found.ratio, found);
            note(places[j], places[i], found.ratio, found);
        }
}

}  // namespace bemcal::input
