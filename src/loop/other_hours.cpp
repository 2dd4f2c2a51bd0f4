/// Searches declared schedules for other hours: each by itself, one kind of days after
/// the other, all runs of a day by simulation. Follows from HourSearch. Hours of a kind
/// of days that are not the declared ones are one of 301, which is their price; days that
/// pay less keep the declared ones. Left out: schedules of use, whose hours effects of
/// people and loads tell; schedules with periods or two runs a day.
#include "loop/other_hours.hpp"

#include "effects/catalogue.hpp"
#include "loop/hour_search.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;
using physics::WeekHours;

/// Of -2 log prior.
double cost_of_other(const DailyRun& run, const DailyRun& declared) {
    static const double one_of_all =
        2 * std::log(static_cast<double>(physics::all_runs().size()));
    return run == declared ? 0 : one_of_all;
}

double cost_of_other(const WeekHours& hours, const WeekHours& declared) {
    double cost = 0;
    for (std::size_t kind = 0; kind < hours.size(); ++kind)
        cost += cost_of_other(hours[kind], declared[kind]);
    return cost;
}

/// Whether it drives set-points, availability, openings or flows of air.
bool drives_plant(const physics::Building& building, std::size_t profile) {
    return std::ranges::any_of(
        physics::inputs_that_follow(building, static_cast<int>(profile)),
        [](const physics::Target& target) {
            return target.part == physics::Part::zone ||
                   target.part == physics::Part::flow ||
                   target.part == physics::Part::air_system;
        });
}

bool is_searched(const Standing& standing, std::size_t profile) {
    return std::ranges::any_of(standing.model.effects, [&](const auto& effect) {
        return effect.other_hours &&
               effect.other_hours->profile == static_cast<int>(profile);
    });
}

/// The declared hours of a schedule whose others may be told.
std::optional<WeekHours> declared_hours(const LoopData& data, const Standing& standing,
                                        std::size_t profile) {
    const physics::Profile& own = data.building.profiles[profile];
    if (own.is_series || !numbered_row_of(data.building, profile) ||
        has_unknown_hours(data.building, profile) || is_searched(standing, profile) ||
        !drives_plant(data.building.building, profile))
        return std::nullopt;
    return physics::hours_of(own.schedule);
}

effects::OtherHours as_effect(const LoopData& data, const ScheduleHours& schedule,
                              const WeekHours& hours, const WeekHours& declared) {
    const std::size_t profile = schedule.profile();
    return {data.building.profiles[profile].name,
            static_cast<int>(profile),
            static_cast<int>(schedule.numbered_row()),
            schedule.low(),
            schedule.high(),
            hours,
            declared};
}

}  // namespace

std::vector<Departure> other_hours(const LoopData& data, const Place& place,
                                   const Standing& standing) {
    std::vector<Departure> found;
    for (std::size_t p = 0; p < data.building.profiles.size(); ++p) {
        const auto declared = declared_hours(data, standing, p);
        if (!declared) continue;
        const ScheduleHours schedule(data, p);
        HourSearch search(
            data, place, standing, {{schedule, *declared, *declared}},
            [](const DailyRun& run, const DailyRun& from) {
                return cost_of_other(run, from);
            },
            Tries::near_the_best);
        for (std::size_t kind = 0; kind < physics::n_day_kinds; ++kind)
            search.improve(0, static_cast<DayKind>(kind),
                           kind == 0 && standing.model.effects.empty());
        const WeekHours& hours = search.hours(0);
        if (hours == *declared) continue;
        found.push_back({effects::with_hours(as_effect(data, schedule, hours, *declared)),
                         search.standing().fit.at.x, cost_of_other(hours, *declared)});
    }
    return found;
}

}  // namespace bemcal::loop
