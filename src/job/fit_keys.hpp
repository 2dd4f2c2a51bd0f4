/// Keys of the kinds that fit a building's meters by an optimiser: what is minimised, and
/// for how long.
#pragma once

#include "calibration/optimisation_options.hpp"
#include "schema/section.hpp"

namespace bemcal::job {

inline constexpr schema::Key fit_keys[] = {
    {"study", "objective", schema::Type::choice, "percent|fraction|likelihood|rmsd",
     "percent", 0, 0,
     "Summed over the meters: cv_weight CV(RMSE) + r2_weight (1 - R2), CV(RMSE) in per "
     "cent (as paper 2 prints it) or as a fraction; likelihood: minus the log likelihood "
     "of independent normal errors; rmsd: root mean square."},
    {"study", "cv_weight", schema::Type::number, "-", "0.7", 0, 1e6, ""},
    {"study", "r2_weight", schema::Type::number, "-", "0.3", 0, 1e6, ""},
    {"study", "meter_weights", schema::Type::numbers, "-", "", 0, 1e9,
     "One for each name in meters; default: 1."},
    {"study", "resolution", schema::Type::choice, "own|monthly", "own", 0, 0,
     "Readings are compared as they are, or by calendar month."},
    {"study", "evaluations", schema::Type::integer, "", "5000", 1, 1e9, "The budget."},
    {"study", "n_particles", schema::Type::integer, "", "32", 2, 100000, "Of a swarm."},
    {"study", "restart", schema::Type::flag, "", "true", 0, 0,
     "Of swarm_then_pattern: goes on from the best point with some parameters drawn "
     "anew, again and again until the budget is spent; false: ends after the first "
     "pattern search, as GenOpt does."},
};

/// Throws UserError at the section's meter_weights: not one for each of the names in
/// meters, negative, or 0 for all.
void check_weights(const schema::Section& section,
                   const calibration::OptimisationOptions& fit);

}  // namespace bemcal::job
