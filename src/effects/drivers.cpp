/// The series that effects follow, and the gates that let them through: one function for
/// each driver that is not a series already.
/// Plain definitions, our own: base 20 degC, day 7 to 19 h, occupied above a tenth of the
/// largest density, heating below and cooling above 12 and 16 degC as a week's mean.
/// People are known by the load's name; moist air and sky are left to air.
#include "effects/drivers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace bemcal::effects {
namespace {

using Series = std::vector<double>;
using std::chrono::seconds;

constexpr double base_temperature = 20;
constexpr double year_s = 365.25 * 86400;

std::size_t size_of(const Surroundings& around) {
    return static_cast<std::size_t>(around.drive->n_steps());
}

template <class Value>
Series each(const Surroundings& around, Value value) {
    Series series(size_of(around));
    for (std::size_t k = 0; k < series.size(); ++k) series[k] = value(k);
    return series;
}

/// Hour of the day at which a step begins [h].
double clock_of(const Surroundings& around, std::size_t step) {
    const auto begin = around.drive->axis.begin_of(static_cast<int>(step));
    const auto day = std::chrono::floor<std::chrono::days>(begin);
    return static_cast<double>((begin - day).count()) / 3600;
}

Series weekdays(const Surroundings& around, int first, int last) {
    return each(around, [&](std::size_t k) {
        const int weekday = around.calendar[k].weekday;
        return first <= weekday && weekday <= last ? 1.0 : 0.0;
    });
}

Series wind_and_difference(const Surroundings& around) {
    if (around.wind.empty()) return {};
    return each(around, [&](std::size_t k) {
        return around.wind[k] * std::abs(base_temperature - around.drive->theta_e[k]);
    });
}

Series relative_wind(const Surroundings& around) {
    if (around.wind.empty() || !(around.mean_wind > 0)) return {};
    constexpr double least = -0.6;  ///< so that no share of leaks takes all of them
    return each(around, [&](std::size_t k) {
        return std::max(around.wind[k] / around.mean_wind - 1, least);
    });
}

Series over(const Series& series, double largest) {
    if (!(largest > 0)) return {};
    Series share = series;
    for (double& value : share) value /= largest;
    return share;
}

Series over_largest(const Series& series) {
    if (series.empty()) return {};
    return over(series, *std::max_element(series.begin(), series.end()));
}

struct Weight {
    int plane;
    double area;
};

/// The planes that an effect on all facades sees: of windows for apertures, else of
/// opaque elements in the sun.
std::vector<Weight> facades_of(const Effect& effect, const physics::Building& building) {
    std::vector<Weight> weights;
    for (const physics::Zone& zone : building.zones) {
        if (effect.hook == Hook::aperture)
            for (const physics::Window& window : zone.windows)
                weights.push_back({window.plane, window.area});
        else
            for (const physics::Surface& surface : zone.surfaces)
                if (surface.in_sun && surface.boundary == physics::outdoors)
                    weights.push_back({surface.plane, surface.area});
    }
    return weights;
}

/// Irradiance on the effect's facade, or the mean over all by area.
Series sun_of(const Effect& effect, const Surroundings& around) {
    const Matrix& irradiance = around.drive->irradiance;
    std::vector<Weight> weights{{effect.place, 1}};
    if (effect.place < 0) weights = facades_of(effect, *around.building);
    if (effect.place >= static_cast<int>(irradiance.rows)) return {};
    double area = 0;
    Series sun(size_of(around));
    for (const Weight& weight : weights) {
        const auto row = irradiance.row(static_cast<std::size_t>(weight.plane));
        for (std::size_t k = 0; k < sun.size(); ++k) sun[k] += weight.area * row[k];
        area += weight.area;
    }
    if (!(area > 0)) return {};
    for (double& value : sun) value /= area;
    return sun;
}

bool is_people(const physics::Load& load) {
    std::string name = load.name;
    for (char& letter : name)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return name.find("people") != std::string::npos ||
           name.find("occup") != std::string::npos;
}

template <class Counts>
Series density_of(const Surroundings& around, Counts counts) {
    Series density(size_of(around));
    for (const physics::Zone& zone : around.building->zones)
        for (const physics::Load& load : zone.loads) {
            if (!counts(load)) continue;
            for (std::size_t k = 0; k < density.size(); ++k)
                density[k] +=
                    zone.floor_area * around.drive->at(load.density, static_cast<int>(k));
        }
    return density;
}

Series elapsed_of(const Surroundings& around) {
    return each(around, [&](std::size_t k) {
        const auto begin = around.drive->axis.begin_of(static_cast<int>(k));
        return static_cast<double>((begin - around.from).count()) / year_s;
    });
}

Series column_of(const Effect& effect, const Surroundings& around) {
    const auto found = around.columns.find(effect.column);
    return found == around.columns.end() ? Series{} : found->second;
}

/// Drivers that follow the calendar alone.
Series of_calendar(const Effect& effect, const Surroundings& around) {
    switch (effect.driver) {
        case Driver::hour:
            return each(around, [&](std::size_t k) { return clock_of(around, k); });
        case Driver::weekend:
            return weekdays(around, 5, 6);
        case Driver::saturday:
            return weekdays(around, 5, 5);
        case Driver::sunday:
            return weekdays(around, 6, 6);
        case Driver::day_of_year:
            return each(around, [&](std::size_t k) {
                return around.calendar[k].day_of_year - 1 + clock_of(around, k) / 24;
            });
        case Driver::elapsed:
            return elapsed_of(around);
        case Driver::constant_temperature:
            return each(around, [&](std::size_t) { return effect.shape.at; });
        default:
            return each(around, [](std::size_t) { return 1.0; });
    }
}

/// Mean of theta_e over the seven days before each step ends.
Series week_means(const Surroundings& around) {
    const Series& theta_e = around.drive->theta_e;
    const auto week = static_cast<std::size_t>(7 * 86400 / around.drive->axis.step_s);
    double sum = 0;
    return each(around, [&](std::size_t k) {
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
    return each(around, [&](std::size_t k) {
        const bool inside = std::any_of(ranges.begin(), ranges.end(), [&](const auto& r) {
            return r.contains(around.calendar[k]);
        });
        return inside ? 1.0 : 0.0;
    });
}

Series in_summer_time(const char* rule, const Surroundings& around) {
    return each(around, [&](std::size_t k) {
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
    return share > 0.1 + 1e-9;
}

Series open_gate(const Effect& effect, const Surroundings& around) {
    constexpr Hours day{7, 19}, night{19, 7};
    const auto in = [&](const Hours& hours) {
        return each(around, [&](std::size_t k) {
            return share_of(hours, around, static_cast<int>(k));
        });
    };
    switch (effect.gate) {
        case Gate::occupied:
            return where(occupation_of(around), is_occupied);
        case Gate::unoccupied:
            return where(occupation_of(around),
                         [](double share) { return !is_occupied(share); });
        case Gate::day:
            return in(day);
        case Gate::night:
            return in(night);
        case Gate::weekend:
            return weekdays(around, 5, 6);
        case Gate::weekday:
            return weekdays(around, 0, 4);
        case Gate::heating_season:
            return where(week_means(around), [](double theta) { return theta < 12; });
        case Gate::cooling_season:
            return where(week_means(around), [](double theta) { return theta > 16; });
        case Gate::on_days:
            return on_days(effect, around);
        case Gate::eu_summer_time:
            return in_summer_time("eu", around);
        case Gate::us_summer_time:
            return in_summer_time("us", around);
        default:
            return each(around, [](std::size_t) { return 1.0; });
    }
}

/// Share of [begin, end) that lies in [from, until).
double overlap(double begin, double end, const Hours& hours) {
    if (hours.from > hours.until)
        return 1 - overlap(begin, end, {hours.until, hours.from});
    const double common = std::min(end, hours.until) - std::max(begin, hours.from);
    return std::max(common, 0.0) / (end - begin);
}

}  // namespace

double share_of(const Hours& hours, const Surroundings& around, int step) {
    const double begin = clock_of(around, static_cast<std::size_t>(step));
    return overlap(begin, begin + around.drive->axis.step_s / 3600.0, hours);
}

std::vector<double> occupation_of(const Surroundings& around) {
    Series people = over_largest(density_of(around, is_people));
    if (!people.empty()) return people;
    return over_largest(density_of(
        around, [](const physics::Load& load) { return load.density.profile >= 0; }));
}

bool same_facade(const physics::Building& building, int plane, int other) {
    const physics::Plane& a = building.planes[static_cast<std::size_t>(plane)];
    const physics::Plane& b = building.planes[static_cast<std::size_t>(other)];
    return a.tilt == b.tilt && a.azimuth == b.azimuth;
}

std::vector<double> driver_of(const Effect& effect, const Surroundings& around) {
    const Series& theta_e = around.drive->theta_e;
    switch (effect.driver) {
        case Driver::theta_e:
            return theta_e;
        case Driver::temperature_to_base:
            return each(around,
                        [&](std::size_t k) { return base_temperature - theta_e[k]; });
        case Driver::root_of_difference:
            return each(around, [&](std::size_t k) {
                return std::sqrt(std::abs(base_temperature - theta_e[k]));
            });
        case Driver::sky_difference:
            return around.sky_difference;
        case Driver::wind:
            return around.wind;
        case Driver::relative_wind:
            return relative_wind(around);
        case Driver::wind_and_difference:
            return wind_and_difference(around);
        case Driver::sun_horizontal:
            return around.sun_horizontal;
        case Driver::sun_on_facade:
        case Driver::bright:
            return sun_of(effect, around);
        case Driver::moisture:
            return around.moisture;
        case Driver::ground:
            return around.ground;
        case Driver::occupied:
            return occupation_of(around);
        case Driver::heating_load:
            return over(around.model.heating, around.model.most_heating);
        case Driver::cooling_load:
            return over(around.model.cooling, around.model.most_cooling);
        case Driver::column:
            return column_of(effect, around);
        default:
            return of_calendar(effect, around);
    }
}

std::vector<double> gate_of(const Effect& effect, const Surroundings& around) {
    Series gate = open_gate(effect, around);
    for (std::size_t k = 0; k < gate.size(); ++k) {
        if (effect.weekday >= 0 && around.calendar[k].weekday != effect.weekday)
            gate[k] = 0;
        if (gate[k] != 0) gate[k] *= share_of(effect.hours, around, static_cast<int>(k));
    }
    return gate;
}

}  // namespace bemcal::effects
