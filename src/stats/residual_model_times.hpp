/// When a meter was read: stretches of readings one interval apart, and how long after
/// the last reading each stretch begins.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::stats {

struct ReadingTimes {
    /// Readings [begin, end), counted without those missing; the first is at `row`.
    struct Stretch {
        std::size_t begin, end, row;
        std::size_t gap;  ///< place in `gaps` of the time since the reading before
    };
    std::vector<Stretch> stretches;
    /// The different times between successive readings [intervals]; the first two places
    /// are `start` (no reading before) and `unit` (1).
    std::vector<std::size_t> gaps;
    static constexpr std::size_t start = 0, unit = 1;

    std::size_t n_present() const { return stretches.empty() ? 0 : stretches.back().end; }
};

/// \param measured  NaN = missing
ReadingTimes reading_times(std::span<const double> measured);

}  // namespace bemcal::stats
