/// Collects failed points: of a run of points from their reasons, of an answer its own.
/// An item that failed as a whole stands for all of its points.
/// Follows from `ItemAnswer`.
/// How many are too many, and whether one may pass, is decided elsewhere.
#include "study/failures.hpp"

namespace bemcal::study {

std::vector<Failure> failures_of_points(std::span<const std::string> reasons,
                                        std::size_t first_point) {
    std::vector<Failure> failures;
    for (std::size_t r = 0; r < reasons.size(); ++r)
        if (!reasons[r].empty())
            failures.push_back({static_cast<long long>(first_point + r), reasons[r]});
    return failures;
}

void append_failures(const ItemAnswer& answer, PointRun points,
                     std::vector<Failure>& failures) {
    failures.insert(failures.end(), answer.failures.begin(), answer.failures.end());
    for (std::size_t r = 0; !answer.error.empty() && r < points.n; ++r)
        failures.push_back({static_cast<long long>(points.first + r), answer.error});
}

}  // namespace bemcal::study
