/// Lists units of weather tables, and tells by the sun and by the air whether a column is
/// in the unit that is expected; else names the known one that would fit.
/// Follows from clearness (irradiance over what arrives outside the atmosphere) at
/// midday, its 98th percentile: in nine files of EPW and of stations 0.7 to 0.9 of a
/// year's global irradiance, 0.55 to 0.75 direct, 0.3 to 0.4 diffuse. Air by its daily
/// swing and its mean beside the sun's. Left out: units within a quarter of each other,
/// and of wind within the span of places.
#include "checks/weather_units.hpp"

#include "base/nan.hpp"
#include "checks/data_readings.hpp"
#include "checks/values.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::checks {

namespace {

using physics::Seconds;
using Kind = WeatherKind;

constexpr double joule_per_btu = 1055.05585262;  // international table
constexpr double m2_per_ft2 = 0.09290304;
constexpr double joule_per_cal = 4.184;  // thermochemical, as of the langley

constexpr WeatherUnit table[] = {
    {"degC", Kind::temperature, 1, 0},
    {"0.1 degC", Kind::temperature, 0.1, 0},
    {"0.01 degC", Kind::temperature, 0.01, 0},
    {"K", Kind::temperature, 1, -273.15},
    {"degF", Kind::temperature, 5.0 / 9, -160.0 / 9},
    {"W/m2", Kind::irradiance, 1, 0},
    {"kW/m2", Kind::irradiance, 1000, 0},
    {"Wh/m2", Kind::irradiance, 3600, 0, true},
    {"kWh/m2", Kind::irradiance, 3.6e6, 0, true},
    {"J/m2", Kind::irradiance, 1, 0, true},
    {"kJ/m2", Kind::irradiance, 1e3, 0, true},
    {"MJ/m2", Kind::irradiance, 1e6, 0, true},
    {"J/cm2", Kind::irradiance, 1e4, 0, true},
    {"cal/cm2", Kind::irradiance, 1e4 * joule_per_cal, 0, true},
    {"Btu/ft2", Kind::irradiance, joule_per_btu / m2_per_ft2, 0, true},
    {"m/s", Kind::speed, 1, 0},
    {"km/h", Kind::speed, 1 / 3.6, 0},
    {"knots", Kind::speed, 1852 / 3600.0, 0},
    {"mph", Kind::speed, 0.44704, 0},
    {"%", Kind::humidity, 1, 0},
    {"0 to 1", Kind::humidity, 100, 0},
    {"0 to 1", Kind::cloud, 1, 0},
    {"%", Kind::cloud, 0.01, 0},
    {"tenths", Kind::cloud, 0.1, 0},
    {"oktas", Kind::cloud, 0.125, 0}};

/// Clearness at midday that is possible, by column: below `least` in two weeks, or
/// `least_of_half_year`, no such place is known; above `most` the sun does not shine.
struct Clearness {
    double least, least_of_half_year, usual, most;
    const char* name;
};
constexpr Clearness clearness_of[] = {{0.30, 0.45, 0.75, 1.2, "global irradiance"},
                                      {0.20, 0.35, 0.65, 1.2, "direct irradiance"},
                                      {0.05, 0.10, 0.38, 0.9, "diffuse irradiance"}};
constexpr double clear_quantile = 0.98;
constexpr double low_sun = 0.2;  ///< cosine of the zenith: stamps weigh too much
constexpr double of_noon = 0.7;  ///< of the day's highest cosine: midday
constexpr double most_off = 2;   ///< of a unit from the usual clearness: haze
constexpr int least_days = 2, fortnight = 14, half_year = 180;
constexpr int other_steps_min[] = {10, 15, 30, 60};

constexpr double coldest = -90, hottest = 60;  ///< [degC], as of records
constexpr double air_quantile = 0.001;
constexpr double most_swing = 28;    ///< [K], median of days: deserts reach 20
constexpr double least_swing = 1.5;  ///< [K], of the unit that is named: seas
constexpr double usual_swing = 9;    ///< [K]
/// [degC], mean of the air under a daily mean sun of H outside the atmosphere: 12 +
/// 0.09 H lies above the mildest coasts in winter and the hottest deserts in summer.
constexpr double warmest_without_sun = 12, warmest_by_sun = 0.09;

constexpr double driest = 1.5;  ///< [%], highest of two days: deserts reach 10
/// [m/s], the middle of two weeks and more: the windiest towns (Wellington, Lerwick) have
/// 7.5, mountains' tops more.
constexpr double windiest = 9, usual_wind = 3.5;

/// Days that have readings, counted from the first one.
int n_days(const input::RegularSeries& series) {
    const auto known = [](double v) { return !std::isnan(v); };
    const auto n = std::ranges::count_if(series.values, known);
    return static_cast<int>(static_cast<double>(n) * series.axis.step_s / physics::day_s);
}

/// Readings at midday over what arrives outside the atmosphere.
std::vector<double> midday_clearness(const input::RegularSeries& series,
                                     const physics::Site& site, bool horizontal) {
    const auto suns = physics::step_suns(site, series.axis);
    std::map<Seconds, double> noons;  // highest cosine of each day
    const auto day_of = [&](std::size_t k) -> Seconds {
        return std::chrono::floor<std::chrono::days>(
            series.axis.begin_of(static_cast<int>(k)));
    };
    for (std::size_t k = 0; k < suns.size(); ++k) {
        double& noon = noons[day_of(k)];
        noon = std::max(noon, std::cos(suns[k].position.zenith));
    }
    std::vector<double> clearness;
    for (std::size_t k = 0; k < suns.size(); ++k) {
        const double height = std::cos(suns[k].position.zenith);
        if (std::isnan(series.values[k]) ||
            height < std::max(low_sun, of_noon * noons[day_of(k)]))
            continue;
        clearness.push_back(series.values[k] / suns[k].position.extraterrestrial /
                            (horizontal ? height : 1));
    }
    return clearness;
}

struct Candidate {
    std::string advice;
    double off;  ///< |logarithm| of how far it is from what is usual
};

/// Units in which the clearness would be usual, the nearest first.
std::vector<Candidate> units_for(double clearness, double usual, int step_s) {
    std::vector<Candidate> found;
    const auto add = [&](double factor, std::string advice) {
        const double off = std::abs(std::log(clearness * factor / usual));
        if (factor != 1 && off < std::log(most_off))
            found.push_back({std::move(advice), off});
    };
    for (const WeatherUnit& unit : table)
        if (unit.kind == Kind::irradiance)
            add(factor_of(unit, step_s), fmt::format("unit = \"{}\"", unit.name));
    for (const int minutes : other_steps_min)
        if (60 * minutes != step_s)
            add(60.0 / minutes,
                fmt::format("factor = {:g} (Wh/m2 of {} min)", 60.0 / minutes, minutes));
    std::ranges::stable_sort(found, {}, &Candidate::off);
    return found;
}

/// "Write unit = "A", or unit = "B""
std::string advice_of(const std::vector<Candidate>& candidates) {
    if (candidates.empty()) return "No known unit is near; set factor";
    std::string text = "Write " + candidates[0].advice;
    for (std::size_t k = 1; k < std::min<std::size_t>(candidates.size(), 3); ++k)
        text += ", or " + candidates[k].advice;
    return text;
}

/// What is looked at in a temperature.
struct Air {
    double low, high, mean, swing;

    bool is_possible(double warmest) const {
        return low >= coldest && high <= hottest && mean <= warmest &&
               !(swing > most_swing);
    }
    Air in(const WeatherUnit& unit) const {
        return {low * unit.factor + unit.offset, high * unit.factor + unit.offset,
                mean * unit.factor + unit.offset, swing * unit.factor};
    }
};

/// The middle one of the daily differences of highest and lowest.
double daily_swing(const input::RegularSeries& series) {
    const auto per_day = static_cast<std::size_t>(physics::day_s / series.axis.step_s);
    std::vector<double> swings;
    for (std::size_t k = 0; k + per_day <= series.values.size(); k += per_day) {
        const std::span day(series.values.data() + k, per_day);
        if (std::ranges::any_of(day, [](double v) { return std::isnan(v); })) continue;
        const auto [low, high] = std::ranges::minmax(day);
        swings.push_back(high - low);
    }
    return swings.empty() ? nan : quantile_of(std::move(swings), 0.5);
}

Air air_of(const input::RegularSeries& series) {
    const std::vector<double> known = known_of(series.values);
    const double sum = std::accumulate(known.begin(), known.end(), 0.0);
    const double mean = sum / static_cast<double>(known.size());
    return {quantile_of(known, air_quantile), quantile_of(known, 1 - air_quantile), mean,
            daily_swing(series)};
}

/// Codes for missing are no air; the reader refuses them one by one.
input::RegularSeries without_codes(input::RegularSeries series) {
    if (physics::day_s % series.axis.step_s == 0)
        mask_codes(series, physics::Quantity::air_temperature);
    return series;
}

/// [degC] that no mean over these steps exceeds.
double warmest_mean(const input::RegularSeries& series, const physics::Site& site) {
    double sum = 0;
    for (const auto& sun : physics::step_suns(site, series.axis))
        sum +=
            sun.position.extraterrestrial * std::max(std::cos(sun.position.zenith), 0.0);
    return warmest_without_sun + warmest_by_sun * sum / series.axis.n_steps;
}

std::vector<Candidate> units_for(const Air& air, double warmest) {
    std::vector<Candidate> found;
    for (const WeatherUnit& unit : table) {
        if (unit.kind != Kind::temperature || (unit.factor == 1 && unit.offset == 0))
            continue;
        const Air as = air.in(unit);
        if (as.is_possible(warmest) && as.swing >= least_swing)
            found.push_back({fmt::format("unit = \"{}\"", unit.name),
                             std::abs(std::log(as.swing / usual_swing))});
    }
    std::ranges::stable_sort(found, {}, &Candidate::off);
    return found;
}

std::vector<Candidate> speeds_for(double wind) {
    std::vector<Candidate> found;
    for (const WeatherUnit& unit : table)
        if (unit.kind == Kind::speed && unit.factor != 1)
            found.push_back({fmt::format("unit = \"{}\"", unit.name),
                             std::abs(std::log(wind * unit.factor / usual_wind))});
    std::ranges::stable_sort(found, {}, &Candidate::off);
    return found;
}

}  // namespace

std::span<const WeatherUnit> weather_units() {
    return table;
}

double factor_of(const WeatherUnit& unit, int step_s) {
    return unit.per_step ? unit.factor / step_s : unit.factor;
}

std::optional<std::string> doubt_of_irradiance(const input::RegularSeries& series,
                                               const physics::Site& site,
                                               SunColumn which) {
    const int days = n_days(series);
    const Clearness& expected = clearness_of[static_cast<std::size_t>(which)];
    const std::vector<double> all =
        midday_clearness(series, site, which != SunColumn::direct_normal);
    if (days < least_days || all.empty()) return std::nullopt;
    const double clear = quantile_of(all, clear_quantile);
    const double least = days >= half_year   ? expected.least_of_half_year
                         : days >= fortnight ? expected.least
                                             : 0;
    if (!(clear > expected.most) && !(clear < least && clear > 0)) return std::nullopt;
    return fmt::format(
        "at its clearest middays it is {:.3g} of what the sun sends outside the "
        "atmosphere; {} in W/m2 is about {:g} there, {:.3g} times as much. {}; unit = "
        "\"W/m2\" if it is so",
        clear, expected.name, expected.usual, expected.usual / clear,
        advice_of(units_for(clear, expected.usual, series.axis.step_s)));
}

std::optional<std::string> doubt_of_temperature(const input::RegularSeries& series,
                                                const physics::Site& site) {
    if (n_days(series) < least_days || series.axis.step_s > physics::day_s)
        return std::nullopt;
    const Air air = air_of(without_codes(series));
    const double warmest = warmest_mean(series, site);
    if (air.is_possible(warmest)) return std::nullopt;
    const std::vector<Candidate> units = units_for(air, warmest);
    if (units.empty()) return std::nullopt;
    return fmt::format(
        "from {:g} to {:g}, {:.3g} on average, {:.3g} between day and night: no air in "
        "degC. {}; unit = \"degC\" if it is so",
        air.low, air.high, air.mean, air.swing, advice_of(units));
}

std::optional<std::string> doubt_of_humidity(const input::RegularSeries& series) {
    if (n_days(series) < least_days) return std::nullopt;
    const double most = std::ranges::max(known_of(series.values));
    if (!(most > 0) || most > driest) return std::nullopt;
    return fmt::format(
        "at most {:.3g}: no air in %. Write unit = \"0 to 1\"; unit = \"%\" if it is so",
        most);
}

std::optional<std::string> doubt_of_wind(const input::RegularSeries& series) {
    if (n_days(series) < fortnight) return std::nullopt;
    const double middle = quantile_of(known_of(series.values), 0.5);
    if (!(middle > windiest)) return std::nullopt;
    return fmt::format(
        "half of the time above {:.3g}: no wind in m/s but on mountains. {}; unit = \"m/s\" "
        "if it is so",
        middle, advice_of(speeds_for(middle)));
}

}  // namespace bemcal::checks
