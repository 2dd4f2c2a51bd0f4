/// A model simulated with every run of hours that a schedule may have on one kind of
/// days.
#pragma once

#include "loop/baseline.hpp"
#include "physics/week_hours.hpp"

#include <functional>
#include <span>
#include <vector>

namespace bemcal::loop {

/// The hours of a schedule of the case that has numbered ones, on the steps of the
/// training period.
class ScheduleHours {
  public:
    ScheduleHours(const LoopData& data, std::size_t profile);

    std::size_t profile() const { return profile_; }
    std::size_t numbered_row() const { return numbered_row_; }
    double low() const { return low_; }    ///< outside of its hours
    double high() const { return high_; }  ///< within them
    /// High in these hours, low in others. [n_steps]
    std::vector<double> row_of(const physics::WeekHours& hours) const;
    /// What a run on one kind of days adds to the low. [n_steps]
    std::vector<double> added_by(const physics::DailyRun& run,
                                 physics::DayKind kind) const;

  private:
    std::vector<double> levels_of(const physics::WeekHours& hours, double low,
                                  double high) const;

    std::size_t profile_, numbered_row_ = 0;
    double low_ = 0, high_ = 1;
    std::vector<int> numbers_;  ///< [n_steps] of physics::numbered_hours
};

/// A model whose schedule has these hours.
struct HourModel {
    const BuiltModel& built;
    const ScheduleHours& schedule;
    physics::WeekHours hours;
};

/// Called with a run and what the channels would read, NaN where that cannot be
/// simulated.
using SeeRun =
    std::function<void(const physics::DailyRun& run, std::span<const double> predicted)>;

/// Runs that begin and end so many hours apart, within both ends.
struct RunGrid {
    int from = 0, last_from = 24;
    int until = 0, last_until = 24;
    int apart = 1;  ///< [h], a divisor of 24
};

/// Simulates the model, its unknowns at x, with all runs of a grid on one kind of days,
/// each once. Several runs share a plan: they differ by hours at their ends.
/// Does nothing where all changes of an input are taken by effects.
void try_runs(const HourModel& model, const std::vector<kernel::Channel>& channels,
              physics::DayKind kind, const RunGrid& grid, std::span<const double> x,
              const SeeRun& see);

}  // namespace bemcal::loop
