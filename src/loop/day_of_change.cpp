/// Two means for each hour of the week, before and behind a day: the day for which they
/// take off most of the residuals' squares, all meters together by their noise.
/// Source: least squares with one break, Bai 1997 (Review of Economics and Statistics
/// 79).
/// Left out: a second day, and meters that are not read by the hour. Whether anything has
/// changed is not asked here.
#include "loop/day_of_change.hpp"

#include "loop/decisions.hpp"
#include "loop/function_bases.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace bemcal::loop {
namespace {

constexpr std::size_t n_hours = 72;  ///< of Points::Kind::hours

struct Sum {
    double of_all = 0, n = 0;
};
using HoursOfDay = std::array<Sum, n_hours>;

/// Of a channel's residuals. [days]
std::vector<HoursOfDay> sums_of_days(const LoopData& data, const Standing& standing,
                                     std::size_t channel,
                                     const std::vector<double>& hours) {
    const physics::TimeAxis axis = data.drive->period();
    const physics::Seconds first = axis.begin_of(0);
    std::vector<HoursOfDay> days;
    const auto& targets = data.targets;
    for (std::size_t k = targets.first[channel]; k < targets.first[channel + 1]; ++k) {
        if (std::isnan(targets.measured[k])) continue;
        const int step = axis.step_of(data.begins[k]);
        const auto day =
            static_cast<std::size_t>((data.begins[k] - first) / std::chrono::days(1));
        if (days.size() <= day) days.resize(day + 1);
        Sum& sum =
            days[day][static_cast<std::size_t>(hours[static_cast<std::size_t>(step)])];
        sum.of_all += standing.residuals[k];
        sum.n += 1;
    }
    return days;
}

/// By how much the residuals' squares fall if hours have another mean from each day on.
/// [days]
std::vector<double> gains_of(const std::vector<HoursOfDay>& days) {
    HoursOfDay all{};
    for (const HoursOfDay& day : days)
        for (std::size_t h = 0; h < n_hours; ++h) {
            all[h].of_all += day[h].of_all;
            all[h].n += day[h].n;
        }
    HoursOfDay before{};
    std::vector<double> gains;
    gains.reserve(days.size());
    for (const HoursOfDay& day : days) {
        double gain = 0;
        for (std::size_t h = 0; h < n_hours; ++h) {
            const double behind = all[h].n - before[h].n;
            if (before[h].n > 0 && behind > 0) {
                const double differ = (all[h].of_all - before[h].of_all) / behind -
                                      before[h].of_all / before[h].n;
                gain += differ * differ * behind * before[h].n / all[h].n;
            }
            before[h].of_all += day[h].of_all;
            before[h].n += day[h].n;
        }
        gains.push_back(gain);
    }
    return gains;
}

}  // namespace

std::optional<double> day_of_change(const LoopData& data, const Standing& standing,
                                    const effects::FunctionDrivers& drivers,
                                    const Place& place) {
    const auto hours = of_period(drivers.at("hour of the week"), *place.drive)[0];
    std::vector<double> gains;
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        if (data.targets.channels[c].interval > physics::Interval::hourly) continue;
        const auto own = gains_of(sums_of_days(data, standing, c, hours));
        gains.resize(std::max(gains.size(), own.size()));
        for (std::size_t d = 0; d < own.size(); ++d)
            gains[d] += standing.noise[c].weight() * own[d];
    }
    constexpr auto least = static_cast<std::size_t>(decisions::least_days_of_change);
    if (gains.size() <= 2 * least) return std::nullopt;
    std::size_t best = least;
    for (std::size_t d = least; d + least <= gains.size(); ++d)
        if (gains[d] > gains[best]) best = d;
    const physics::TimeAxis axis = data.drive->period();
    const int step = axis.step_of(axis.begin_of(0) + std::chrono::days(best));
    return of_period(drivers.at("time"), *place.drive)[0][static_cast<std::size_t>(step)];
}

}  // namespace bemcal::loop
