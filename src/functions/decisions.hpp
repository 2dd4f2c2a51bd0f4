/// Numbers that decide which functions join and what shape they may have, each with its
/// unit, what it decides, and where it comes from. README.md of loop has them as a
/// table, with the test at each one's edge ('Numbers that decide').
#pragma once

#include <cstddef>

namespace bemcal::functions::decisions {

// Shapes of functions

/// Hours of a day as near are alike [h]. Judgement.
inline constexpr double hours_alike = 3;
/// Of the variance that kinds of days share. Judgement.
inline constexpr double share_of_all_days = 0.5;
/// Points of a smooth curve. Judgement.
inline constexpr long most_knots = 8;
/// Of the driver beside the hour. Judgement.
inline constexpr long most_knots_of_hours = 5;
/// Knots as near are alike [knots]. Judgement.
inline constexpr double knots_alike = 3;
/// Of the values beyond the outer knots at each end. Judgement: extremes are one day's.
inline constexpr double share_beyond_knots = 0.01;
/// Of the prior's variance, by the columns kept. Judgement.
inline constexpr double kept_variance = 0.97;
/// Training up to here: a level may be a season [a]. Judgement: a season repeats once.
inline constexpr double years_that_show_seasons = 2;
/// Of the level a year before, in what goes on then. Judgement: either is as likely.
inline constexpr double share_of_season = 0.5;

// Which functions join

/// Functions of a search. Judgement: time.
inline constexpr std::size_t most_functions = 12;
/// Pairs kept after the first pass. Judgement: memory.
inline constexpr std::size_t most_candidates = 16;
/// Of a parameter without a prior [1/sd2]. Judgement: next to nothing.
inline constexpr double least_precision = 1e-6;
/// Of a function: twice the typical size [typical size2]. Judgement.
inline constexpr double most_variance = 4;
/// Below it a function is nothing [typical size2]. Judgement.
inline constexpr double least_variance = 1e-6;
/// Of scores over independent errors. Judgement: below it errors would be opposite.
inline constexpr double least_scatter = 0.01;
/// Rounds in which all variances are found anew. Judgement: time.
inline constexpr int variance_sweeps = 3;

}  // namespace bemcal::functions::decisions
