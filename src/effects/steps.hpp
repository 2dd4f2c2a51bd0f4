/// Series over the steps of a drive, by calendar and clock: what drivers and gates share.
#pragma once

#include "effects/surroundings.hpp"
#include "physics/calendar.hpp"

#include <vector>

namespace bemcal::effects {

/// Of Driver::elapsed and its thresholds.
inline constexpr double elapsed_year_s = 365.25 * physics::day_s;

/// value(k) at every step k.
template <class Value>
std::vector<double> each_step(const Surroundings& around, Value value) {
    std::vector<double> series(static_cast<std::size_t>(around.drive->n_steps()));
    for (std::size_t k = 0; k < series.size(); ++k) series[k] = value(k);
    return series;
}

/// Hour of the day at which a step begins [h].
double clock_of(const Surroundings& around, std::size_t step);

/// 1 from one weekday to another, both included (0 = Monday), else 0.
std::vector<double> weekdays(const Surroundings& around, int first, int last);

/// Share of each step's time that lies in these hours of the day. [n_steps]
std::vector<double> shares_of(const Hours& hours, const Surroundings& around);

/// Density of people over its largest [n_steps]: of the loads named people or occupants,
/// else of all that follow a profile; empty where there are none.
std::vector<double> occupation_of(const Surroundings& around);

/// 0 of none.
double mean_of_known(const std::vector<double>& values);

/// The series over `largest`; empty where that is not above 0.
std::vector<double> over(const std::vector<double>& series, double largest);

}  // namespace bemcal::effects
