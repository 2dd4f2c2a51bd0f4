/// Running means of outdoor temperature, and the shares of rooms that follow them.
/// Source: EN 16798-1:2019, running mean outdoor temperature of the adaptive criteria
/// (alpha = 0.8). The ramp and its width are our own.
/// Left out: switches that a room's own temperature makes, hysteresis, radiators and
/// imposed powers, which have a schedule of their own.
#include "physics/season.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::physics {

namespace {

constexpr double alpha = 0.8;        ///< what the running mean keeps from day to day [-]
constexpr double class_width = 0.5;  ///< of running means [K]

double middle_of_class(double theta) {
    return (std::floor(theta / class_width) + 0.5) * class_width;
}

std::chrono::sys_days day_of(Seconds time) {
    return std::chrono::floor<std::chrono::days>(time);
}

/// Means of the weather's days; NaN where a day has no value.
std::vector<double> daily_means(const Weather& weather) {
    const auto first = day_of(weather.axis.start);
    std::vector<double> sum, n;
    for (std::size_t k = 0; k < weather.theta_e.size(); ++k) {
        const auto day = static_cast<std::size_t>(
            (day_of(weather.axis.begin_of(static_cast<int>(k))) - first).count());
        if (day >= sum.size()) sum.resize(day + 1), n.resize(day + 1);
        if (std::isnan(weather.theta_e[k])) continue;
        sum[day] += weather.theta_e[k];
        n[day] += 1;
    }
    for (std::size_t day = 0; day < sum.size(); ++day) sum[day] /= n[day];
    return sum;
}

/// Of each day, made of the days before it.
std::vector<double> running_means_of(const std::vector<double>& daily) {
    const auto is_known = [](double mean) { return !std::isnan(mean); };
    const auto first = std::ranges::find_if(daily, is_known);
    if (first == daily.end()) return daily;
    std::vector<double> running{*first};
    for (std::size_t day = 1; day < daily.size(); ++day) {
        const double before = daily[day - 1], kept = running.back();
        running.push_back(is_known(before) ? (1 - alpha) * before + alpha * kept : kept);
    }
    return running;
}

/// 1 from half a ramp on, 0 below minus that.
double share_of(double kelvin_within) {
    return std::clamp(0.5 + kelvin_within / season_ramp, 0.0, 1.0);
}

}  // namespace

double heated_share(const Structure& structure, double theta_rm) {
    return share_of(structure.heating_limit - theta_rm);
}

double cooled_share(const Structure& structure, double theta_rm) {
    return share_of(theta_rm - structure.cooling_limit);
}

std::vector<double> running_means(const Weather& weather, const TimeAxis& source) {
    const std::vector<double> running = running_means_of(daily_means(weather));
    const auto first = day_of(weather.axis.start);
    std::vector<double> of_steps;
    of_steps.reserve(static_cast<std::size_t>(source.n_steps));
    for (int k = 0; k < source.n_steps; ++k) {
        const auto day = (day_of(source.begin_of(k)) - first).count();
        of_steps.push_back(middle_of_class(running[static_cast<std::size_t>(day)]));
    }
    return of_steps;
}

}  // namespace bemcal::physics
