/// What a calibration in stages (staged.hpp) is given.
#pragma once

#include "calibration/optimisation_options.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace bemcal::calibration {

struct NamedRange {
    std::string parameter;
    double least, most;
};

struct NamedValue {
    std::string parameter;
    double value;
};

inline constexpr const char* initial_values = "initial";  ///< the building as described

struct CalibrationStage {
    std::string name;
    std::string from = initial_values;    ///< or a stage before it
    std::vector<std::string> periods;     ///< of the case; not empty
    std::vector<std::string> parameters;  ///< of the case; not empty
    double around = 0;                    ///< range: this share of the value carried
                                          ///< over, up and down; 0 = the parameter's
    std::vector<NamedRange> ranges{};     ///< instead of these
    std::vector<NamedValue> set{};        ///< held at these from this stage on
    /// Of a likelihood: errors nearer than this count as one [h], and the priors of what
    /// is calibrated count beside them; 0: every reading counts, and no prior.
    double independent_hours = 0;
    OptimisationOptions fit{};  ///< objective, meters, method, budget, seed
};

/// A period that no stage sees, judged with the values of one.
struct ValidationPeriod {
    std::string period, stage;
};

inline constexpr const char* all_at_once = "at_once";
inline constexpr int points_per_staged_item = 16;

struct StagedOptions {
    std::vector<CalibrationStage> stages;
    std::vector<ValidationPeriod> validation;
    /// Beside the stages: all of their parameters calibrated at once, on all of their
    /// periods, from the initial values; evaluations, 0 = those of all stages together.
    bool at_once = true;
    std::size_t at_once_evaluations = 0;
    Objective objective = Objective::percent;  ///< of at_once, where stages' differ
    int simulator_runs = 80;                   ///< of another program, where there is one
    double accuracy = 0.35;                    ///< of the sensor [unit of the meter]
    /// Studies above whose best point (of a posterior the mean) is judged, too.
    std::vector<std::string> beside;
};

}  // namespace bemcal::calibration
