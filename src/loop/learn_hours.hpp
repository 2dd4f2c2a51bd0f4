/// Hours of schedules that nobody wrote down, learned from the readings by simulation.
#pragma once

#include "loop/baseline.hpp"
#include "physics/week_hours.hpp"

#include <array>
#include <string>
#include <vector>

namespace bemcal::loop {

/// A daily run, and how certain it is.
struct LearnedRun {
    physics::DailyRun run;
    double probability = 0;  ///< of this run among all
    /// What holds 90 % of the begins and of the ends, of runs that are not off.
    physics::DailyRun least, most;
};

struct LearnedHours {
    std::size_t profile = 0;  ///< of the case
    std::string name, use;
    physics::WeekHours usual;  ///< of its use, where the search began
    std::array<LearnedRun, physics::n_day_kinds> runs;
    double evidence = 0;  ///< of the hours learned of all schedules over the usual ones

    physics::WeekHours hours() const;
};

/// The schedules of case.unknown_hours with the usual hours, where a search begins.
std::vector<LearnedHours> usual_hours_of(const study::Case& building);

/// Learns the hours of these schedules: start and end by kind of day, one after the
/// other, until none changes.
/// \param standing  the model of any structure, calibrated with the hours so far, which
///                  are those of data.drive
std::vector<LearnedHours> learn_hours(const LoopData& data, const Standing& standing,
                                      std::vector<LearnedHours> so_far);

/// Whether both have the same hours, schedule by schedule.
bool have_same_hours(const std::vector<LearnedHours>& one,
                     const std::vector<LearnedHours>& other);

/// The case with these hours in its schedules.
study::Case with_hours(const study::Case& building,
                       const std::vector<LearnedHours>& learned);

/// "schedule work: Monday to Friday 8 to 19 h, ...; learned, nobody declared it".
std::string sentence_of(const LearnedHours& learned);

}  // namespace bemcal::loop
