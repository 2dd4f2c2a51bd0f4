/// A meter's readings as the data checks see them: an even axis and what drives them.
#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace bemcal::checks {

/// Weather switches a heating meter off for months and brings it back; a meter of people
/// and machines has a base load; a temperature has neither a zero nor a scale.
enum class Driver { people, weather, temperature };

struct DataSeries {
    std::span<const double> values;  ///< even steps; NaN = missing
    int per_day = 24;                ///< steps of a day, whole
    int first_slot = 0;              ///< steps from midnight to the first one
    int first_weekday = 0;           ///< of the first one, 0 = Monday
    Driver driver = Driver::people;

    int size() const { return static_cast<int>(values.size()); }
    double at(int k) const { return values[static_cast<std::size_t>(k)]; }
    int slot(int k) const { return (first_slot + k) % per_day; }
    int weekday(int k) const { return (first_weekday + (first_slot + k) / per_day) % 7; }
    double hours(double steps) const { return steps * 24 / per_day; }
};

/// A stretch of readings with one value.
struct Run {
    int first = 0, n = 0;
    double value = 0;
};

/// Those that are not missing, in their order.
std::vector<double> known_of(std::span<const double> values);

/// Type 7 quantile of a sample in any order; NaN of none.
double quantile_of(std::vector<double> sample, double p);

}  // namespace bemcal::checks
