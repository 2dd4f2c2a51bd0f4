/// The search of one building, from its baseline on.
#pragma once

#include "loop/late_clock.hpp"
#include "loop/results.hpp"
#include "loop/under_way.hpp"

#include <memory>
#include <optional>

namespace bemcal::loop {

/// A baseline, with the hours that nobody wrote down where the case has such.
struct Begin {
    std::unique_ptr<const LoopData> data;  ///< with those hours
    Baseline baseline;
    std::vector<LearnedHours> hours;

    bool failed() const {
        return baseline.plain.fit.failed || baseline.chosen.fit.failed;
    }
};
Begin begin_search(const LoopData& written, UnderWay& under_way);

/// What the search found; or a clock, by which all of it is to be done again.
struct Ended {
    LoopResult result;
    std::optional<LateClock> late_clock{};
};
/// \param hours_late       of the meters' clocks, which were set
/// \param may_set_clock    whether late readings may be told from late schedules
Ended search_from(const LoopData& data, Baseline baseline,
                  std::vector<LearnedHours> hours, UnderWay& under_way,
                  int hours_late = 0, bool may_set_clock = true);

/// Whether a meter that is learned from has a reading in training.
bool has_training(const study::Case& building, const LoopOptions& options);

}  // namespace bemcal::loop
