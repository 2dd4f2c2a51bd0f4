/// An effect as it is declared in a job.
#pragma once

#include "effects/driver_functions.hpp"
#include "physics/calendar.hpp"

#include <array>
#include <span>
#include <string>

namespace bemcal::effects {

/// Keys of the days of the week, Monday first.
inline constexpr std::array weekday_keys{"monday", "tuesday",  "wednesday", "thursday",
                                         "friday", "saturday", "sunday"};
/// "south", "roof": the effect's only facade.
std::string facade_key(const Effect& effect);

/// What is believed of a coefficient.
struct CoefficientBelief {
    double mean = 0, sd = 0;  ///< sd = 0: it is fixed
    double least = 0, most = 1;
};

/// [[effect]] with this coefficient, and its [[parameter]] with a prior unless it is
/// fixed, in TOML, which a reader makes the same effect of; of other hours than declared
/// the lines of their [[schedule]].
/// \param from   where `elapsed` is 0: the first step of training
/// \param taken  names that the job's effects have already: it gets another one
std::string job_section_of(const Effect& effect, const CoefficientBelief& coefficient,
                           physics::Seconds from,
                           std::span<const std::string> taken = {});
/// What the section calls it, as long as that is not taken.
std::string name_in_job(const Effect& effect);

/// [[effect]] that brings functions at a hook, with a coefficient of 1.
std::string job_section_of(const Effect& at,
                           const std::vector<DriverFunction>& functions);

/// [[parameter]] of these numbers, with its value and a prior about it.
std::string parameter_section_of(const std::string& name,
                                 const std::vector<std::string>& paths,
                                 const CoefficientBelief& belief);

/// Lines of a [[schedule]] with these hours.
std::string schedule_section_of(const std::string& schedule,
                                const physics::WeekHours& hours);

/// Such lines as a [[schedule]] of their own; any other section as it is.
std::string as_tables(const std::string& section);

}  // namespace bemcal::effects
