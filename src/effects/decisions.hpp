/// Numbers that decide what effects may be and what they follow, each with its unit,
/// what it decides, and where it comes from. README.md of loop has them as a table,
/// with the test at each one's edge ('Numbers that decide').
#pragma once

#include <cstddef>

namespace bemcal::effects::decisions {

// Coefficients

/// A fit may take so many times what is plausible. Judgement: beyond the gate's 1.5.
inline constexpr double times_plausible = 2;
/// A factor takes away no more. Judgement: something is left to divide by.
inline constexpr double most_taken_away = 0.95;
/// Most of a coefficient on schedules. Judgement.
inline constexpr double most_of_another_day = 1.5;
/// Numbers of a refinement stay within [prior sd]. Judgement: beyond, it stands for
/// something else.
inline constexpr double reach_of_structure = 2.5;
/// Range of a coefficient that is written into a job [prior sd]. Judgement.
inline constexpr double reach_of_declared = 4;
/// Values of a profile that shapes regimes. Judgement: time; the error is under 3 %.
inline constexpr int most_levels = 12;

// What effects follow

/// Of a series of the weather: with more missing it is none. Judgement.
inline constexpr double most_missing = 0.1;
/// Indoors, for temperature differences [degC]. Judgement.
inline constexpr double base_temperature = 20;
/// Steps of the sun on the sunniest window [W/m2]. Judgement: a quarter of a kelvin of
/// set-point.
inline constexpr double sun_step = 50;
/// Of the sun that a room had an hour ago, what still warms it. Judgement: a time
/// constant of three to four hours.
inline constexpr double kept_of_sun = 0.75;
/// Least of the wind about its mean. Judgement: some leaks are left.
inline constexpr double least_excess_of_wind = -0.6;
/// Of a year's hours: with fewer in the weather, its mean is that of all weather.
/// Judgement: less has no summer or no winter.
inline constexpr double least_of_year = 0.5;
/// The ground's time constant [h]. Judgement: 60 days.
inline constexpr double lag_of_ground = 1440;
/// Of the largest density of people: more is occupied. Judgement: schedules keep a
/// tenth at night.
inline constexpr double least_occupied = 0.1;
/// Gates of day and night [h]. Judgement.
inline constexpr int day_begins = 7;
/// The same [h]. Judgement.
inline constexpr int day_ends = 19;
/// Week's mean outdoors of the heating season [degC]. Judgement.
inline constexpr double heats_below = 12;
/// Week's mean outdoors of the cooling season [degC]. Judgement.
inline constexpr double cools_above = 16;
/// Days of a weekday, of which the most frequent stands for it. Judgement.
inline constexpr std::size_t nearest_days = 9;
/// Steps of a row that repeat after a week: it is a schedule. Judgement.
inline constexpr double least_repeated = 0.7;
/// A function of a share takes away no more. Judgement: something is left to divide by.
inline constexpr double least_of_function = -0.9;

}  // namespace bemcal::effects::decisions
