/// What is odd about the readings of a job's meters, and what is done about it: every
/// finding becomes a line of the decisions, with dates and numbers.
///
/// Corrected is what is certain by the thresholds of stats/data_*.hpp, everything else is
/// stated and kept; the job overrules both. Leaves out what needs a model: a factor
/// between 0.5 and 2, a schedule that does not fit.
#pragma once

#include "checks/data_readings.hpp"
#include "input/series.hpp"
#include "study/case.hpp"

namespace bemcal::checks {

/// What is done with readings that a check doubts.
enum class Handling { check, keep, missing };
enum class StepHandling { check, keep };

struct CheckOptions {
    Handling zeros = Handling::check;
    Handling constant = Handling::check;
    StepHandling steps = StepHandling::check;
    int zero_run_h = 24, constant_run_h = 24;  ///< longer runs are stated
};

struct Finding {
    std::string finding, action;
};

/// The readings for stats/data_*.hpp; `values` must stay. The steps divide a day.
DataSeries data_series(const std::vector<double>& values, const physics::TimeAxis& axis,
                       physics::Quantity quantity);

/// Zeros that mean missing, constant fills and steps of the unit, in a meter's readings
/// as they stand in the file; masked and corrected there. Of steps that do not divide a
/// day nothing is found.
std::vector<Finding> check_series(input::RegularSeries& series,
                                  physics::Quantity quantity,
                                  const CheckOptions& options);

/// The same of readings over an hour apart, up to a day: a fortnight of one value or
/// more.
std::vector<Finding> check_days(input::RegularSeries& series, physics::Quantity quantity,
                                const CheckOptions& options);

/// Summer time and lag of the days of each meter read by hours or finer, against the
/// schedules and the declared electrical loads; stated only.
void check_clocks(study::Case& building);

/// Days without any sun though it is up at noon; stated.
void check_weather_sun(study::Case& building);

/// Measured sunshine against the sun; stated where it is half an hour off or more.
void check_weather_clock(study::Case& building);

/// Meters that show the same, or a fixed share of it, in over 90 % of their readings;
/// stated at both.
void check_shared_meters(std::vector<study::Case>& buildings);

}  // namespace bemcal::checks
