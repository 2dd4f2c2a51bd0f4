/// Failed points, in an item's answer and over all answers of a stage.
#pragma once

#include "study/stage.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// A run of points of a stage.
struct PointRun {
    std::size_t first = 0, n = 0;
};

/// Of points that follow `first_point`; an empty reason = none.
std::vector<Failure> failures_of_points(std::span<const std::string> reasons,
                                        std::size_t first_point);

/// Appends an answer's own, and, where its item failed as a whole, all of its points.
void append_failures(const ItemAnswer& answer, PointRun points,
                     std::vector<Failure>& failures);

}  // namespace bemcal::study
