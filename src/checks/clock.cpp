/// States whether a meter's days move with summer time as schedules do, how far they lag
/// loads or another meter, and how far sunshine lies from the sun.
/// Follows from `summer_shift`, `lag_of` and `noon_offset`.
/// Corrects nothing, and leaves out readings coarser than an hour. A clock that all
/// meters share is found by the loop (`late_clock_in_place_of`).
#include "checks/data_clock.hpp"
#include "checks/series.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace bemcal::checks {

namespace {

using physics::Seconds;
using study::Case;
using study::Meter;

constexpr double least_edges = 0.75;  ///< correlation of two series' days
constexpr double least_gain = 0.2;    ///< of that correlation by the lag
constexpr double least_lag_h = 0.5;   ///< behind declared loads
constexpr double least_apart_h = 3;   ///< of two meters: plant starts earlier than people
constexpr double least_noon_h = 0.5;
constexpr double most_at_night = 0.01;  ///< share of sunshine with the sun down

bool has_days(const Meter& meter) {
    return meter.axis.step_s <= 3600 && 3600 % meter.axis.step_s == 0 &&
           meter.interval <= physics::Interval::hourly &&
           study::has_reading(meter.values);
}

/// The rule of summer time that a schedule of the building follows; "" where none does.
std::string declared_rule(const Case& building) {
    for (const physics::Profile& profile : building.profiles)
        if (!profile.is_series && profile.schedule.summer_time != "none")
            return profile.schedule.summer_time;
    return "";
}

/// The rule that people around the site live by; "" where it is neither.
std::string local_rule(const physics::Site& site) {
    if (site.latitude > 34 && site.longitude > -25 && site.longitude < 35) return "eu";
    if (site.latitude > 24 && site.longitude > -130 && site.longitude < -55) return "us";
    return "";
}

std::vector<ClockChange> changes_in(const physics::TimeAxis& axis,
                                    const std::string& rule, double utc_offset_h) {
    std::vector<ClockChange> changes;
    for (int k = 1; k < axis.n_steps; ++k) {
        const auto is_summer = [&](int step) {
            return physics::is_summer_time(axis.begin_of(step), rule, utc_offset_h);
        };
        if (is_summer(k) != is_summer(k - 1)) changes.push_back({k, is_summer(k)});
    }
    return changes;
}

/// To the hundredth that is printed: what rounds to nothing has no sign.
double rounded(double hours) {
    return std::round(hours * 100) / 100 + 0.0;
}

/// "-1.02 h at 2013-03-31, ..."
std::string words_of(const SummerShift& shift, const physics::TimeAxis& axis) {
    std::string text;
    for (const auto& judged : shift.changes)
        text += fmt::format("{}{:+.2f} h at {}", text.empty() ? "" : ", ",
                            rounded(judged.hours),
                            physics::format_date(axis.begin_of(judged.change.at)));
    return text;
}

void check_summer_time(Case& building, const Meter& meter, const std::string& declared,
                       const std::string& rule) {
    const DataSeries data = data_series(meter.values, meter.axis, meter.quantity);
    const double offset = building.weather.site.utc_offset_h;
    const auto shift = summer_shift(data, changes_in(meter.axis, rule, offset));
    const auto note = [&](const std::string& finding, const std::string& action) {
        building.decisions.push_back(
            {meter.name,
             fmt::format("{}: {}; {:.2f} h at other dates", finding,
                         words_of(shift, meter.axis), shift.natural),
             action});
    };
    if (shift.verdict == SummerTime::mixed)
        note(fmt::format("its days move with summer time (\"{}\") in some years only",
                         rule),
             "kept; a file for each clock, or a mask, would mend it");
    if (shift.verdict == SummerTime::moves && declared.empty())
        note(fmt::format("its days begin an hour earlier in summer time (\"{}\"), the "
                         "schedules' do not",
                         rule),
             fmt::format("kept; schedules with summer_time = \"{}\" would follow", rule));
    if (shift.verdict == SummerTime::stands && !declared.empty())
        note(fmt::format("its days do not move with summer time (\"{}\"), the schedules' "
                         "do",
                         rule),
             fmt::format("kept; clock = \"{}\" would read its stamps as wall clock",
                         rule));
}

/// An input's values on the axis; NaN where its series has none.
std::vector<double> values_of(const physics::Input& input, const Case& building,
                              const physics::TimeAxis& axis) {
    const auto n = static_cast<std::size_t>(axis.n_steps);
    std::vector<double> values(n, input.value);
    if (input.profile < 0) return values;
    const auto& profile = building.profiles[static_cast<std::size_t>(input.profile)];
    std::vector<double> shares;
    if (!profile.is_series)
        shares = physics::values_of(profile.schedule, axis,
                                    building.weather.site.utc_offset_h);
    for (std::size_t k = 0; k < n; ++k) {
        double share = std::nan("");
        if (!profile.is_series) {
            share = shares[k];
        } else {
            const int step = profile.axis.step_of(axis.begin_of(static_cast<int>(k)));
            if (step >= 0 && step < profile.axis.n_steps)
                share = profile.values[static_cast<std::size_t>(step)];
        }
        values[k] = input.low + (input.value - input.low) * share;
    }
    return values;
}

/// What the declared loads draw from the electricity meter, in W.
std::vector<double> declared_loads(const Case& building, const physics::TimeAxis& axis) {
    std::vector<double> sum(static_cast<std::size_t>(axis.n_steps));
    for (const physics::Zone& zone : building.building.zones)
        for (const physics::Load& load : zone.loads) {
            if (load.carrier != physics::Carrier::electricity) continue;
            const auto density = values_of(load.density, building, axis);
            const auto efficiency = values_of(load.efficiency, building, axis);
            for (std::size_t k = 0; k < sum.size(); ++k)
                sum[k] += zone.floor_area * density[k] / efficiency[k];
        }
    return sum;
}

std::vector<double> profile_of(const DataSeries& series) {
    return weekday_profile(series, 0, series.size());
}

bool is_certain(const Lag& lag, double least_hours) {
    return !(std::abs(lag.hours) < least_hours || lag.correlation < least_edges ||
             lag.correlation - lag.unmoved < least_gain);
}

std::string sentence_of(const Lag& lag, const std::string& others) {
    return fmt::format(
        "its working days lie {:.2f} h {} {} (edges correlate by {:.2f}, without a lag "
        "by "
        "{:.2f})",
        std::abs(lag.hours), lag.hours > 0 ? "behind" : "before", others, lag.correlation,
        lag.unmoved);
}

void check_lag_behind_loads(Case& building, const Meter& meter) {
    const std::vector<double> loads = declared_loads(building, meter.axis);
    const auto declared = profile_of(data_series(loads, meter.axis, meter.quantity));
    const auto measured =
        profile_of(data_series(meter.values, meter.axis, meter.quantity));
    if (declared.empty() || measured.empty()) return;
    const Lag lag = lag_of(declared, measured);
    if (!is_certain(lag, least_lag_h)) return;
    building.decisions.push_back(
        {meter.name, sentence_of(lag, "the declared electrical loads"),
         "kept; stamp, utc_offset or clock of the meter, or the loads' schedules, would "
         "mend it"});
}

void check_lag_behind_meter(Case& building, const Meter& meter, const Meter& other) {
    const auto first = profile_of(data_series(other.values, other.axis, other.quantity));
    const auto second = profile_of(data_series(meter.values, meter.axis, meter.quantity));
    if (first.empty() || first.size() != second.size()) return;
    const Lag lag = lag_of(first, second);
    if (!is_certain(lag, least_apart_h)) return;
    building.decisions.push_back(
        {meter.name, sentence_of(lag, "those of " + other.name),
         "kept; stamp, utc_offset or clock of one of them would mend it"});
}

}  // namespace

void check_clocks(Case& building) {
    const std::string declared = declared_rule(building);
    const std::string rule =
        declared.empty() ? local_rule(building.weather.site) : declared;
    const Meter* first = nullptr;
    for (const Meter& meter : building.meters) {
        if (!has_days(meter)) continue;
        if (!rule.empty()) check_summer_time(building, meter, declared, rule);
        if (physics::is_temperature(meter.quantity)) continue;
        if (meter.quantity == physics::Quantity::electricity)
            check_lag_behind_loads(building, meter);
        if (first != nullptr)
            check_lag_behind_meter(building, meter, *first);
        else
            first = &meter;
    }
}

void check_weather_clock(Case& building) {
    const physics::Weather& weather = building.weather;
    const auto suns =
        physics::step_suns(weather.site, weather.axis, physics::SunOfStep::sunlit_part);
    std::vector<double> horizontal(suns.size());
    double total = 0, at_night = 0;
    for (std::size_t k = 0; k < suns.size(); ++k) {
        const auto& sun = suns[k];
        horizontal[k] = sun.sunlit * sun.position.extraterrestrial *
                        std::max(std::cos(sun.position.zenith), 0.0);
        const double measured = weather.global_horizontal[k];
        if (std::isnan(measured)) continue;
        total += measured;
        if (sun.sunlit == 0) at_night += measured;
    }
    const DataSeries data = data_series(weather.global_horizontal, weather.axis,
                                        physics::Quantity::air_temperature);
    const NoonOffset noon = noon_offset(data, horizontal);
    const bool dark = at_night > most_at_night * total;
    if (!(std::abs(noon.hours) >= least_noon_h) && !dark) return;
    building.decisions.push_back(
        {"weather",
         fmt::format("on its {} clearest days sunshine lies {:.2f} h {} the sun at {:g} "
                     "deg, {:g} deg, {:+g} h; {:.1f} % of it comes with the sun down",
                     noon.n_days, std::abs(noon.hours),
                     noon.hours > 0 ? "behind" : "before", weather.site.latitude,
                     weather.site.longitude, weather.site.utc_offset_h,
                     total > 0 ? 100 * at_night / total : 0),
         "kept; stamp and utc_offset of the weather, or [site], would mend it"});
}

}  // namespace bemcal::checks
