/// What an optimisation (optimisation.hpp) minimises, by which method, and how long.
#pragma once

#include "calibration/grid_options.hpp"
#include "physics/meters.hpp"
#include "study/simulator.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::calibration {

enum class OptimisationMethod { swarm_then_pattern, swarm, pattern, nsga2 };

/// What is minimised, summed over the meters with their weights. percent: CV(RMSD) in
/// per cent and R2 as a fraction, as paper 2 prints it; fraction: both as fractions;
/// likelihood: minus the log likelihood of independent normal errors, their standard
/// deviation at its most likely value; rmsd: their root mean square, in the meter's unit.
enum class Objective { percent, fraction, likelihood, rmsd };

/// Of nsga2, one objective for each meter. absolute, signed: of the total over the
/// period; signed is minimised among points that are not below the measured total;
/// cv_rmse: of the readings.
enum class MeterError { absolute, signed_, cv_rmse };

enum class ObjectiveResolution { own, monthly };  ///< of the readings that are compared

struct OptimisationOptions {
    OptimisationMethod method = OptimisationMethod::swarm_then_pattern;
    Objective objective = Objective::percent;
    double cv_weight = 0.7, r2_weight = 0.3;
    ObjectiveResolution resolution = ObjectiveResolution::own;
    MeterError errors = MeterError::absolute;
    std::string period;                   ///< empty = the first
    std::vector<std::string> parameters;  ///< empty = all; the others stay nominal
    std::vector<std::string> meters;      ///< empty = all with readings
    std::vector<double> meter_weights;    ///< of these meters; empty = 1 each
    std::size_t evaluations = 5000;       ///< the budget; not of nsga2
    int n_particles = 32;
    bool restart = true;  ///< swarm_then_pattern: on until the budget is spent
    int n_population = 100, n_generations = 50;  ///< of nsga2
    std::size_t points_per_item = 32;
    std::uint64_t seed = 0;
    /// Of nominal and best, stored by step.
    std::vector<physics::Quantity> hourly_outputs;
};

/// Numbers that a simulator is to hit.
struct TargetAim {
    std::shared_ptr<const study::Simulator> simulator;
    std::vector<GridTarget> targets;
    std::vector<std::vector<double>> values;  ///< of discrete parameters; empty = none
};

}  // namespace bemcal::calibration
