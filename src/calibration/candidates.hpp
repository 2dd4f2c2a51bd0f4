/// The nominal building beside the best one found: metrics and series of every meter in
/// every period, for the results of screenings and optimisations.
#pragma once

#include "calibration/screening_plan.hpp"
#include "study/datasets.hpp"

#include <memory>
#include <vector>

namespace bemcal::calibration {

/// A case, ready for the kernel in each of its periods.
struct CandidateCase {
    const study::Case& building;
    const std::vector<std::unique_ptr<PeriodModel>>& models;  ///< [periods]
    const std::vector<physics::Quantity>& hourly_outputs;     ///< stored by step
};

/// Names of meters, periods, candidates.
void add_candidate_names(const study::Case& building, study::DatasetBuilder& datasets);

/// \param points  [2 x parameters] nominal and best, simulated here by the plain model
void add_candidates(const CandidateCase& plan, const Matrix& points,
                    study::DatasetBuilder& datasets);

}  // namespace bemcal::calibration
