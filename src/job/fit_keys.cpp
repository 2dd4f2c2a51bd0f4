/// Checks what the schema cannot say of keys that fit meters: a weight for each name,
/// none below 0, one above. Follows from the objective, a sum over the meters by their
/// weights. Leaves out whether the meters are there (`learning`, `names`).
#include "job/fit_keys.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

void check_weights(const schema::Section& section,
                   const calibration::OptimisationOptions& fit) {
    const std::vector<double>& weights = fit.meter_weights;
    if (weights.empty()) return;
    if (fit.meters.size() != weights.size())
        section.fail("meter_weights",
                     fmt::format("has {} numbers, but meters has {} names; expected one "
                                 "for each",
                                 weights.size(), fit.meters.size()));
    if (!std::ranges::all_of(weights, [](double weight) { return weight >= 0; }))
        section.fail("meter_weights", "expected no negative number");
    if (std::ranges::all_of(weights, [](double weight) { return weight == 0; }))
        section.fail("meter_weights",
                     "is 0 for all, so that nothing is fitted; expected one above 0");
}

}  // namespace bemcal::job
