/// Shows what a model leaves: how each hook's score fluctuates along each driver, an
/// effect's alarm, the share of a residual that hour and month foretell in other blocks.
/// Source: Zeileis and Hornik 2007 (generalised M-fluctuation).
/// Days count as independent. Causes are left to `search`.
#include "loop/portrait.hpp"

#include "base/nan.hpp"
#include "effects/profiles.hpp"
#include "loop/decisions.hpp"
#include "loop/search.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using effects::Driver;
using effects::Hook;

constexpr std::array hooks = {Hook::outdoor_air,
                              Hook::infiltration,
                              Hook::ventilation,
                              Hook::opaque_conductance,
                              Hook::window_conductance,
                              Hook::aperture,
                              Hook::gains,
                              Hook::loads,
                              Hook::heating_set_point,
                              Hook::cooling_set_point,
                              Hook::heating_efficiency,
                              Hook::cooling_cop};
constexpr std::array drivers = {Driver::theta_e,  Driver::wind, Driver::sun_horizontal,
                                Driver::moisture, Driver::hour, Driver::weekend,
                                Driver::elapsed};

double typical_of(Hook hook) {
    switch (hook) {
        case Hook::outdoor_air:
        case Hook::heating_set_point:
        case Hook::cooling_set_point:
            return 1;
        case Hook::gains:
            return 2;
        default:
            return 0.2;
    }
}

effects::Effect constant_at(Hook hook) {
    effects::Effect effect;
    effect.name = effects::name_of(hook);
    effect.hook = hook;
    effect.typical = typical_of(hook);
    effect.most = 10 * effect.typical;
    effect.least = -effect.most;
    return effect;
}

/// A driver at every step of the drive; empty where it is not known.
std::vector<double> series_of(const Place& place, Driver driver) {
    effects::Effect effect;
    effect.driver = driver;
    if (!effects::is_known(effect, *place.surroundings)) return {};
    return effects::profile_of(effect, *place.surroundings);
}

/// Sums of score by unit of time, in the order of the driver.
double fluctuation(std::span<const double> scores, std::span<const double> by) {
    std::vector<std::size_t> order(scores.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return by[a] < by[b]; });
    const auto n = static_cast<double>(scores.size());
    const double mean = std::reduce(scores.begin(), scores.end()) / n;
    double square = 0, sum = 0, largest = 0;
    for (const double score : scores) square += (score - mean) * (score - mean);
    // A driver's ties move together.
    for (std::size_t k = 0; k < order.size(); ++k) {
        sum += scores[order[k]] - mean;
        const bool ends = k + 1 == order.size() || by[order[k]] != by[order[k + 1]];
        if (ends) largest = std::max(largest, std::abs(sum));
    }
    return square > 0 ? largest / std::sqrt(square) / decisions::critical_fluctuation : 0;
}

/// Of runs of `hours` hours: sums of a hook's score, means of a driver.
struct Units {
    std::vector<double> scores, by;
};

Units units_of(const LoopData& data, std::span<const double> score,
               std::span<const double> driver, const physics::TimeAxis& axis, int hours) {
    std::map<long long, std::array<double, 3>> sums;
    for (std::size_t k = 0; k < score.size(); ++k) {
        const int step = axis.step_of(data.begins[k]);
        if (step < 0 || step >= axis.n_steps) continue;
        const long long unit =
            data.begins[k].time_since_epoch().count() / (3600LL * hours);
        auto& [s, d, n] = sums[unit];
        s += score[k];
        d += driver[static_cast<std::size_t>(step)];
        n += 1;
    }
    Units units;
    for (const auto& [unit, sum] : sums) {
        units.scores.push_back(sum[0]);
        units.by.push_back(sum[1] / sum[2]);
    }
    return units;
}

/// The effects' scores at each reading, of those that can enter.
std::vector<Screened> with_scores(const LoopData& data, const Place& place,
                                  const Standing& standing,
                                  const std::vector<effects::Effect>& effects) {
    auto screened = screen(data, place, standing, effects, Keep::signatures);
    const auto weights = weights_of(data.targets, standing.noise);
    for (Screened& one : screened)
        for (std::size_t k = 0; k < weights.size(); ++k)
            one.signature[k] *= weights[k] * standing.residuals[k];
    return screened;
}

double cell(const LoopData& data, const Place& place, std::span<const double> score,
            Driver driver, const std::vector<double>& series) {
    if (series.empty()) return nan;
    const int hours = driver == Driver::hour ? 1 : 24;
    const Units units = units_of(data, score, series, place.drive->axis, hours);
    return fluctuation(units.scores, units.by);
}

/// Hour of the week, then month and hour of the day: additive bins.
constexpr std::size_t n_week = 168, n_year = 288, n_bins = n_week + n_year;

std::array<std::size_t, 2> bins_of(physics::Seconds begin) {
    const auto step = physics::calendar_step(begin);
    return {static_cast<std::size_t>(24 * step.weekday + step.hour),
            n_week + static_cast<std::size_t>(24 * (step.month - 1) + step.hour)};
}

/// Means by bin over the blocks of the other parity, of what the bins before leave.
std::vector<double> bin_means(const LoopData& data, std::size_t channel,
                              std::span<const double> residuals, int parity) {
    std::vector<double> means(n_bins, 0.0);
    for (std::size_t level = 0; level < 2; ++level) {
        std::vector<double> sum(n_bins, 0.0),
            n(n_bins, decisions::readings_of_no_pattern);
        for (std::size_t k = data.targets.first[channel];
             k < data.targets.first[channel + 1]; ++k) {
            if (std::isnan(data.targets.measured[k])) continue;
            if (data.blocks[k] % 2 == parity) continue;
            const auto bins = bins_of(data.begins[k]);
            sum[bins[level]] += residuals[k] - (level == 1 ? means[bins[0]] : 0);
            n[bins[level]] += 1;
        }
        for (std::size_t b = 0; b < n_bins; ++b)
            if (sum[b] != 0) means[b] = sum[b] / n[b];
    }
    return means;
}

std::string cell_name(std::size_t cell) {
    return fmt::format("{}, {} to {} h",
                       physics::name_of_month(static_cast<int>(cell / 24) + 1), cell % 24,
                       cell % 24 + 1);
}

Unexplained unexplained_of(const LoopData& data, const Standing& standing,
                           std::size_t channel) {
    const std::array means = {bin_means(data, channel, standing.residuals, 0),
                              bin_means(data, channel, standing.residuals, 1)};
    std::vector<double> by_cell(n_year, 0.0);
    double square = 0, left = 0;
    for (std::size_t k = data.targets.first[channel]; k < data.targets.first[channel + 1];
         ++k) {
        if (std::isnan(data.targets.measured[k])) continue;
        const auto bins = bins_of(data.begins[k]);
        const auto& mean = means[static_cast<std::size_t>(data.blocks[k] % 2)];
        const double r = standing.residuals[k], rest = r - mean[bins[0]] - mean[bins[1]];
        square += r * r;
        left += rest * rest;
        by_cell[bins[1] - n_week] += r * r - rest * rest;
    }
    const auto most = std::ranges::max_element(by_cell);
    return {square > 0 ? std::max(0.0, 1 - left / square) : 0,
            cell_name(static_cast<std::size_t>(most - by_cell.begin()))};
}

}  // namespace

Localisation localise(const LoopData& data, const Place& place,
                      const Standing& standing) {
    Localisation map;
    for (const Hook hook : hooks) map.hooks.emplace_back(effects::name_of(hook));
    for (const Driver driver : drivers)
        map.drivers.emplace_back(effects::name_of(driver));
    map.statistic = Matrix(hooks.size(), drivers.size(), nan);
    std::vector<effects::Effect> constants;
    constants.reserve(hooks.size());
    for (const Hook hook : hooks) constants.push_back(constant_at(hook));
    for (const Screened& one : with_scores(data, place, standing, constants)) {
        const auto h = static_cast<std::size_t>(
            std::ranges::find(hooks, one.effect.hook) - hooks.begin());
        for (std::size_t d = 0; d < drivers.size(); ++d)
            map.statistic(h, d) = cell(data, place, one.signature, drivers[d],
                                       series_of(place, drivers[d]));
    }
    return map;
}

double alarm_of(const LoopData& data, const Place& place, const Standing& standing,
                const effects::Effect& effect) {
    const auto screened = with_scores(data, place, standing, {effect});
    if (screened.empty()) return 0;
    const std::vector<double>& score = screened[0].signature;
    double largest = 0;
    for (const Driver driver : {effect.driver, Driver::hour, Driver::elapsed}) {
        const double here = cell(data, place, score, driver, series_of(place, driver));
        if (!std::isnan(here)) largest = std::max(largest, here);
    }
    return largest;
}

bool is_over(double before, double after) {
    return after <= std::max(1.0, decisions::largest_alarm_left * before);
}

std::vector<Unexplained> unexplained_of(const LoopData& data, const Standing& standing) {
    std::vector<Unexplained> all;
    all.reserve(data.targets.n_channels());
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c)
        all.push_back(unexplained_of(data, standing, c));
    return all;
}

}  // namespace bemcal::loop
