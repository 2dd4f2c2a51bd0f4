/// Asks whether a clock of all meters that is late by whole hours explains more than late
/// schedules; tries the hours beside it, and summer time with each.
/// Follows from the weather's answer, late with a clock only; in the standard's model.
/// Leaves out clocks of single meters (`check_clocks`), parts of an hour, and meters that
/// are not read by the hour.
#include "loop/late_clock.hpp"

#include "base/nan.hpp"
#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using Effects = std::vector<effects::Effect>;

double at(std::span<const double> series, std::ptrdiff_t k) {
    const bool is_there = k >= 0 && k < static_cast<std::ptrdiff_t>(series.size());
    return is_there ? series[static_cast<std::size_t>(k)] : nan;
}

bool is_by_the_hour(const kernel::Channel& channel) {
    return channel.interval == physics::Interval::hourly;
}

/// By how many hours an effect shifts all schedules; 0 where it does not.
int hours_of(const effects::Effect& effect, double coefficient) {
    if (effect.hook != effects::Hook::operation ||
        effect.driver != effects::Driver::shifted_hours ||
        effect.gate != effects::Gate::always)
        return 0;
    const double shift = effect.shape.at * coefficient;
    const double whole = std::round(shift);
    return std::abs(shift - whole) < decisions::about_whole_hours
               ? static_cast<int>(whole)
               : 0;
}

/// What the meters read so many hours later; missing at an end.
study::Targets read_later(const study::Targets& targets, int hours) {
    study::Targets moved = targets;
    for (std::size_t c = 0; c < targets.n_channels(); ++c) {
        const auto own = targets.of(c, targets.measured);
        for (std::size_t k = 0; k < own.size(); ++k)
            moved.measured[targets.first[c] + k] =
                at(own, static_cast<std::ptrdiff_t>(k) + hours);
    }
    return moved;
}

/// What the best fit leaves, from the prior's means on; infinity where none can be made.
double objective_of(const BuiltModel& built, const study::Targets& targets,
                    const std::vector<ChannelNoise>& noise) {
    const study::Fit best = study::fit(*built.fit_model, built.unknowns, targets.measured,
                                       weights_of(targets, noise),
                                       std::vector<double>(built.unknowns.size(), 0.0),
                                       {20, 5e-4, study::without_derivatives});
    return best.failed ? std::numeric_limits<double>::infinity() : best.objective;
}

using decisions::least_fall_of_clock;

/// Summer time, which people may keep though the building does not say so, or the
/// reverse: beside a clock it is half a year's hour, and the clock alone would stop
/// between.
Effects summers_of(const LoopData& data, const Place& place) {
    Effects summers;
    const auto& exclude = data.options.exclude;
    const auto meters = data.quantities();
    for (effects::Effect& effect :
         effects::named_candidates(*place.surroundings, meters)) {
        const bool is_summers = effect.gate == effects::Gate::eu_summer_time ||
                                effect.gate == effects::Gate::us_summer_time;
        if (is_summers && std::ranges::find(exclude, effect.name) == exclude.end())
            summers.push_back(std::move(effect));
    }
    return summers;
}

}  // namespace

std::optional<LateClock> late_clock_in_place_of(const LoopData& data,
                                                const Standing& standing,
                                                std::size_t effect) {
    const effects::Effect& schedules = standing.model.effects[effect];
    const int hours = hours_of(schedules, standing.coefficient(effect));
    if (hours == 0 || !std::ranges::all_of(data.targets.channels, is_by_the_hour))
        return {};
    const Place plain = make_place(data, {}, data.drive);
    const auto by_clock = [&](const Effects& others, int late) {
        return objective_of(build(plain, others), read_later(data.targets, late),
                            standing.noise);
    };
    const double without = by_clock({}, hours);
    const double gained =
        objective_of(build(plain, {schedules}), data.targets, standing.noise) - without;
    if (!(gained > least_fall_of_clock)) return {};
    const auto summers = summers_of(data, plain);
    const auto with_summers = [&](int late, double least) {
        for (const effects::Effect& summer : summers)
            least = std::min(least, least_fall_of_clock + by_clock({summer}, late));
        return least;
    };
    const double least = with_summers(hours, without);
    LateClock best{hours, gained};
    for (const int other : {hours - 1, hours + 1}) {
        if (other == 0) continue;
        const double more = least - with_summers(other, by_clock({}, other));
        if (more > least_fall_of_clock && gained + more > best.gained)
            best = {other, gained + more};
    }
    return best;
}

study::Case with_clock_set(const study::Case& building, const LateClock& late) {
    study::Case set = building;
    for (study::Meter& meter : set.meters)
        meter.axis.start -= std::chrono::hours(late.hours);
    set.decisions.push_back(
        {"all meters",
         fmt::format("their clock is {} h {}: this explains more than schedules that are "
                     "(evidence {:.0f})",
                     std::abs(late.hours), late.hours > 0 ? "late" : "early",
                     late.gained),
         "read by the right hour, predicted by their clock; exclude = [\"schedules "
         "earlier or later\"] would keep it"});
    return set;
}

std::vector<double> by_late_clock(const std::vector<double>& hours, int late) {
    std::vector<double> moved(hours.size(), nan);
    for (std::size_t k = 0; k < hours.size(); ++k)
        moved[k] = at(hours, static_cast<std::ptrdiff_t>(k) - late);
    return moved;
}

std::vector<double> by_late_clock_throughout(const std::vector<double>& hours, int late) {
    constexpr std::ptrdiff_t day = 24;
    std::vector<double> moved = by_late_clock(hours, late);
    const auto n = static_cast<std::ptrdiff_t>(hours.size());
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::ptrdiff_t from = k - late;
        if (from < 0) moved[static_cast<std::size_t>(k)] = at(hours, from + day);
        if (from >= n) moved[static_cast<std::size_t>(k)] = at(hours, from - day);
    }
    return moved;
}

}  // namespace bemcal::loop
