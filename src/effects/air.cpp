/// Moist air, sky and ground by the hour: each series is a formula mapped over the
/// weather.
/// Source: WMO Guide 2008, 4.B (Magnus, for dew points); Clark and Allen 1978 with
/// Walton's clouds (sky). The ground is a lagged mean with an assumed 60 days.
/// Missing values stay missing; frost (saturation over ice) is left out.
#include "effects/air.hpp"

#include "base/nan.hpp"
#include "effects/decisions.hpp"
#include "physics/calendar.hpp"
#include "physics/moist_air.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace bemcal::effects {
namespace {

using physics::Weather;

constexpr double stefan_boltzmann = 5.670374e-8;  // [W/(m2 K4)]
constexpr double kelvin = 273.15;
constexpr std::size_t year_h = 8760;
constexpr double missing = nan;

/// Magnus formula over water [Pa].
double magnus(double theta) {
    return 611.2 * std::exp(17.62 * theta / (243.12 + theta));
}

double dew_point(double theta, double relative_humidity) {
    const double ratio = std::max(relative_humidity, 1.0) / 100;
    const double x = std::log(ratio * magnus(theta) / 611.2);
    return 243.12 * x / (17.62 - x);
}

template <class Formula>
std::vector<double> each_hour(const Weather& weather, Formula formula) {
    std::vector<double> values(weather.theta_e.size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = formula(k);
    return values;
}

/// Moves the state towards a value by one hour; a missing value moves nothing.
double lagged(double state, double value) {
    const double weight = 1 - std::exp(-1 / decisions::lag_of_ground);
    return std::isnan(value) ? state : state + weight * (value - state);
}

double mean_of(const std::vector<double>& values) {
    double sum = 0, n = 0;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        sum += value;
        n += 1;
    }
    return n > 0 ? sum / n : missing;
}

}  // namespace

double sky_temperature(double infrared) {
    return std::pow(infrared / stefan_boltzmann, 0.25) - kelvin;
}

double sky_infrared(double theta, double relative_humidity, double cloud_cover) {
    const double n = 10 * cloud_cover;
    const double clear =
        0.787 + 0.764 * std::log((dew_point(theta, relative_humidity) + kelvin) / 273);
    const double clouds = 1 + 0.0224 * n - 0.0035 * n * n + 0.00028 * n * n * n;
    return clear * clouds * stefan_boltzmann * std::pow(theta + kelvin, 4);
}

std::vector<double> moisture_series(const Weather& weather) {
    if (weather.relative_humidity.empty()) return {};
    const double pressure = physics::standard_pressure(weather.site.elevation);
    return each_hour(weather, [&](std::size_t k) {
        const double saturated = physics::saturation_pressure(weather.theta_e[k]);
        return 1000 * physics::humidity_ratio(
                          weather.relative_humidity[k] / 100 * saturated, pressure);
    });
}

std::vector<double> sky_difference_series(const Weather& weather) {
    const bool measured = !weather.infrared.empty();
    if (!measured && (weather.relative_humidity.empty() || weather.cloud_cover.empty()))
        return {};
    return each_hour(weather, [&](std::size_t k) {
        const double theta = weather.theta_e[k];
        const double infrared = measured
                                    ? weather.infrared[k]
                                    : sky_infrared(theta, weather.relative_humidity[k],
                                                   weather.cloud_cover[k]);
        return infrared > 0 ? theta - sky_temperature(infrared) : missing;
    });
}

std::vector<double> ground_series(const Weather& weather) {
    const std::vector<double>& theta_e = weather.theta_e;
    double state = mean_of(theta_e);
    const std::size_t year = std::min(year_h, theta_e.size());
    for (int repeats = 0; repeats < 3; ++repeats)
        for (std::size_t k = 0; k < year; ++k) state = lagged(state, theta_e[k]);
    return each_hour(weather,
                     [&](std::size_t k) { return state = lagged(state, theta_e[k]); });
}

std::vector<double> yearly_mean_series(const Weather& weather) {
    struct Year {
        double sum = 0, n = 0;
    };
    std::map<int, Year> years;
    const auto year_of = [&](std::size_t k) {
        const auto begin = weather.axis.begin_of(static_cast<int>(k));
        return physics::calendar_step(begin).year;
    };
    for (std::size_t k = 0; k < weather.theta_e.size(); ++k) {
        Year& year = years[year_of(k)];
        year.sum += weather.theta_e[k];
        year.n += 1;
    }
    const double of_all = mean_of(weather.theta_e);
    return each_hour(weather, [&](std::size_t k) {
        const Year& year = years[year_of(k)];
        return year.n < decisions::least_of_year * year_h ? of_all : year.sum / year.n;
    });
}

}  // namespace bemcal::effects
