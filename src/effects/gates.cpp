/// The gates that let effects through: by people, clock, calendar and season.
/// Plain definitions, our own: day 7 to 19 h, occupied above a tenth of the largest
/// density, heating below and cooling above 12 and 16 degC as a week's mean.
/// What effects follow is left to drivers.
#include "effects/gates.hpp"

#include "effects/decisions.hpp"
#include "effects/steps.hpp"
#include "physics/calendar.hpp"

#include <algorithm>

namespace bemcal::effects {
namespace {

using Series = std::vector<double>;

/// Mean of theta_e over the seven days before each step ends.
Series week_means(const Surroundings& around) {
    const Series& theta_e = around.drive->theta_e;
    const auto week =
        static_cast<std::size_t>(7 * physics::day_s / around.drive->axis.step_s);
    double sum = 0;
    return each_step(around, [&](std::size_t k) {
        sum += theta_e[k];
        if (k >= week) sum -= theta_e[k - week];
        return sum / static_cast<double>(std::min(k + 1, week));
    });
}

physics::DateRange range_of(const Days& days) {
    using std::chrono::sys_days;
    const auto first = physics::calendar_step(sys_days(std::chrono::days(days.first)));
    const auto last = physics::calendar_step(sys_days(std::chrono::days(days.last)));
    return {days.yearly ? 0 : first.year, first.month, first.day,
            days.yearly ? 0 : last.year,  last.month,  last.day};
}

Series on_days(const Effect& effect, const Surroundings& around) {
    std::vector<physics::DateRange> ranges;
    ranges.reserve(effect.days.size());
    for (const Days& days : effect.days) ranges.push_back(range_of(days));
    return each_step(around, [&](std::size_t k) {
        const bool inside = std::any_of(ranges.begin(), ranges.end(), [&](const auto& r) {
            return r.contains(around.calendar[k]);
        });
        return inside ? 1.0 : 0.0;
    });
}

Series in_summer_time(const char* rule, const Surroundings& around) {
    return each_step(around, [&](std::size_t k) {
        const auto begin = around.drive->axis.begin_of(static_cast<int>(k));
        return physics::is_summer_time(begin, rule, 0) ? 1.0 : 0.0;
    });
}

template <class Test>
Series where(const Series& series, Test test) {
    Series result;
    result.reserve(series.size());
    for (const double value : series) result.push_back(test(value) ? 1.0 : 0.0);
    return result;
}

/// Above a tenth of the largest density; a tenth itself, as standby schedules have at
/// night, is not.
bool is_occupied(double share) {
    return share > decisions::least_occupied + 1e-9;
}

Series open_gate(const Effect& effect, const Surroundings& around) {
    constexpr Hours day{decisions::day_begins, decisions::day_ends},
        night{decisions::day_ends, decisions::day_begins};
    switch (effect.gate) {
        case Gate::occupied:
            return where(occupation_of(around), is_occupied);
        case Gate::unoccupied:
            return where(occupation_of(around),
                         [](double share) { return !is_occupied(share); });
        case Gate::day:
            return shares_of(day, around);
        case Gate::night:
            return shares_of(night, around);
        case Gate::weekend:
            return weekdays(around, 5, 6);
        case Gate::weekday:
            return weekdays(around, 0, 4);
        case Gate::heating_season:
            return where(week_means(around),
                         [](double theta) { return theta < decisions::heats_below; });
        case Gate::cooling_season:
            return where(week_means(around),
                         [](double theta) { return theta > decisions::cools_above; });
        case Gate::on_days:
            return on_days(effect, around);
        case Gate::eu_summer_time:
            return in_summer_time("eu", around);
        case Gate::us_summer_time:
            return in_summer_time("us", around);
        default:
            return each_step(around, [](std::size_t) { return 1.0; });
    }
}

}  // namespace

std::vector<double> gate_of(const Effect& effect, const Surroundings& around) {
    Series gate = open_gate(effect, around);
    const Series of_hours = shares_of(effect.hours, around);
    for (std::size_t k = 0; k < gate.size(); ++k) {
        if (effect.weekday >= 0 && around.calendar[k].weekday != effect.weekday)
            gate[k] = 0;
        if (gate[k] != 0) gate[k] *= of_hours[k];
    }
    return gate;
}

}  // namespace bemcal::effects
