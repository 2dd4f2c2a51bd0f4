/// The search for the hours of schedules, with which the model explains the readings
/// best.
#pragma once

#include "loop/hour_trials.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace bemcal::loop {

/// A run, what it costs, and where the parameters go with it.
struct TriedRun {
    physics::DailyRun run;
    double cost;  ///< -2 log likelihood with priors, that of the run among them
    std::vector<double> x;
};

/// -2 log likelihood by the noise, with what the parameters' priors add.
double cost_of(const LoopData& data, const std::vector<ChannelNoise>& noise,
               const Standing& standing);

/// A schedule that is searched: its hours so far, and those from which it departs.
struct SearchedSchedule {
    ScheduleHours schedule;
    physics::WeekHours hours, from;
};

/// -2 log prior of a run in place of another.
using CostOfRun =
    std::function<double(const physics::DailyRun& run, const physics::DailyRun& from)>;

/// Which runs are simulated: all of them, or every second hour's first, then those beside
/// the best of these.
enum class Tries { all, near_the_best };

class HourSearch {
  public:
    /// \param standing  with the hours so far, which are those of the place's drive
    HourSearch(const LoopData& data, const Place& place, const Standing& standing,
               std::vector<SearchedSchedule> schedules, CostOfRun prior, Tries tries);

    /// Runs of a schedule on one kind of days are simulated, the best calibrated, and the
    /// best of these taken if it is better than that so far.
    /// \param from_prior  also with the parameters at their prior's means
    /// \return what was tried, as it was before that; none where none can be simulated
    std::vector<TriedRun> improve(std::size_t schedule, physics::DayKind kind,
                                  bool from_prior);

    /// With better hours errors are smaller, and alike for shorter.
    void settle_noise();

    const Standing& standing() const { return standing_; }
    const physics::WeekHours& hours(std::size_t schedule) const {
        return schedules_[schedule].hours;
    }

  private:
    std::vector<TriedRun> tried_from(const Standing& standing, std::size_t schedule,
                                     physics::DayKind kind) const;
    const physics::DailyRun& run_so_far(std::size_t schedule,
                                        physics::DayKind kind) const;
    double prior_of(const physics::DailyRun& run, std::size_t schedule,
                    physics::DayKind kind) const;
    std::optional<Standing> at_prior() const;
    void take_best(const std::vector<TriedRun>& best, std::size_t schedule,
                   physics::DayKind kind);
    Standing calibrated(std::size_t schedule, const physics::WeekHours& hours,
                        const std::vector<double>& start) const;

    const LoopData& data_;
    Place place_;  ///< with the hours so far
    Standing standing_;
    std::vector<SearchedSchedule> schedules_;
    CostOfRun prior_;
    Tries tries_;
};

}  // namespace bemcal::loop
