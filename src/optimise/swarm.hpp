/// Particle swarm with constriction, on a mesh.
///
/// Clerc and Kennedy 2002, IEEE Trans. Evol. Comput. 6(1): velocities are contracted by
/// chi = 2 kappa / |2 - phi - sqrt(phi^2 - 4 phi)|, phi = cognitive + social > 4. Each
/// particle follows the best point of its neighbours on a ring. Particles are evaluated
/// at the nearest point of the mesh (Wetter's PSOCC on a mesh, GenOpt manual 3.1, section
/// 5.4), where a pattern search can go on. GenOpt codes discrete variables in binary
/// digits; here a particle has a real number for each, rounded to one of the table.
#pragma once

#include "optimise/search.hpp"
#include "sampling/task.hpp"

namespace bemcal::optimise {

struct SwarmOptions {
    int n_particles = 32;
    int most_generations = 1000000;
    int patience = 20;  ///< generations without a better point that end it
    double cognitive = 2.05, social = 2.05, kappa = 1;
    int neighbours = 2;          ///< on each side of a particle
    double most_velocity = 0.5;  ///< of the range in a generation
    double mesh = 0x1p-12;       ///< of the range; 0 = none
};

/// The best point. The first particle starts at `first`, the others anywhere.
sampling::Task<Found> swarm(Search& search, SwarmOptions options, Stream random,
                            Position first);

}  // namespace bemcal::optimise
