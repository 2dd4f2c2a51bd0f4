/// One chain at one temperature: where it is, how it steps, and its transitions.
#pragma once

#include "sampling/chain.hpp"
#include "sampling/company.hpp"
#include "sampling/metric.hpp"
#include "sampling/task.hpp"
#include "sampling/trajectory.hpp"

#include <cstddef>
#include <vector>

namespace bemcal::sampling {

/// Which of a density's coordinates move how.
struct Coordinates {
    std::size_t dimension = 0;
    std::vector<std::size_t> real, whole;
    std::vector<int> levels;  ///< [dimension]
    std::vector<char> held;   ///< [dimension] of a climb
};
Coordinates coordinates_of(const Density& density);

struct Walker {
    Walker(Company& its_company, const Coordinates& its_coordinates,
           const SamplerOptions& options, double its_inverse_temperature,
           const Stream& its_random);

    Company& company;
    const Coordinates& coordinates;
    Method method;
    double inverse_temperature;
    Stream random;
    Point current, trial;
    Metric metric;
    std::vector<double> scales;       ///< step size; gibbs: of each real coordinate
    std::vector<double> acceptances;  ///< of the last transition, for each scale
    std::vector<double> step;         ///< [real coordinates] scratch
    Trajectory trajectory;            ///< nuts

    Company::Evaluation evaluate(Point& point) { return company.evaluate(point); }
    double log_density(const Point& point) const {
        return point.log_density(inverse_temperature);
    }
    /// Metropolis: goes to the evaluated trial, or stays; the probability of going.
    double decide();
};

/// What a transition was like.
struct Transition {
    double acceptance = 0;
    int n_steps = 0, depth = 0;
    bool diverging = false;
};

/// The whole transition by the walker's method: real coordinates, then whole numbers.
Task<Transition> transition_of(Walker& walker);

Task<Transition> nuts(Walker& walker);
Task<Transition> random_walk(Walker& walker);
Task<Transition> gibbs(Walker& walker);
/// Proposes another value for each whole-number coordinate, all equally likely.
Task<int> move_whole_numbers(Walker& walker);  ///< the number of evaluations

/// The step at which the acceptance of one leapfrog step crosses 0.8, by doubling or
/// halving (Hoffman and Gelman 2014, algorithm 4, with Stan's threshold).
Task<> find_step_size(Walker& walker);

}  // namespace bemcal::sampling
