/// Finds meters that are one meter, within a building or in several: pairs that keep one
/// ratio in over 90 % of their common readings. It is stated at both.
/// Follows from `proportion_of`, over every pair; of a large group over a few.
/// Leaves out air temperatures, steps over an hour, and sums of several meters. A stock
/// compares daily sums (`find_shared_meters`).
#include "base/alike.hpp"
#include "checks/data_shared.hpp"
#include "checks/series.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace bemcal::checks {

namespace {

using study::Case;
using study::Meter;

constexpr double least_common_share = 0.9;

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
    return checks::proportion_of(part(a), part(b));
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

/// Two of the places, and how they go together.
struct Share {
    std::size_t first = 0, second = 0;
    Proportion found;
};

bool is_shared(const Place& a, const Place& b, Proportion& found) {
    found = proportion_of(*a.meter, *b.meter);
    return found.n > 0 && found.share > least_common_share;
}

/// \param partners  whom it is shared with, in words
void note(const Place& at, const std::string& partners, double ratio,
          const Proportion& found) {
    at.building->decisions.push_back(
        {at.meter->name,
         fmt::format("shared with {}: {:.4g} times its reading in {:.1f} % of {} hours",
                     partners, ratio, 100 * found.share, found.n),
         "kept; it may be one meter's share"});
}

void note_pair(const Place& a, const Place& b, const Proportion& found) {
    note(a, b.name(*a.building), 1 / found.ratio, found);
    note(b, a.name(*b.building), found.ratio, found);
}

/// Each beside the first that it is like, with how many more there are.
void note_group(const std::vector<Place>& places, const std::vector<std::size_t>& group) {
    for (const std::size_t member : group)
        for (const std::size_t partner : group) {
            Proportion found;
            if (partner == member || !is_shared(places[partner], places[member], found))
                continue;
            note(places[member],
                 fmt::format("{} and {} more",
                             places[partner].name(*places[member].building),
                             group.size() - 2),
                 found.ratio, found);
            break;
        }
}

}  // namespace

void check_shared_meters(std::vector<Case>& buildings) {
    std::vector<Place> places;
    for (Case& building : buildings)
        for (const Meter& meter : building.meters)
            if (can_be_shared(meter)) places.push_back({&building, &meter});
    AlikeGroups groups(places.size());
    std::vector<Share> shares;
    for (std::size_t k = 0; k < places.size(); ++k)
        groups.add(k, [&](std::size_t earlier, std::size_t later) {
            Share share{earlier, later, {}};
            if (!is_shared(places[earlier], places[later], share.found)) return false;
            shares.push_back(share);
            return true;
        });
    std::ranges::sort(shares, {}, [](const Share& share) {
        return std::pair(share.first, share.second);
    });
    for (const Share& share : shares)
        if (!groups.is_large(share.first))
            note_pair(places[share.first], places[share.second], share.found);
    for (const std::vector<std::size_t>& group : groups.large_groups())
        note_group(places, group);
}

}  // namespace bemcal::checks
