/// A particle swarm with constriction on a mesh, in which each particle follows the best
/// of its neighbours on a ring; it ends after `patience` generations without a better
/// point.
/// Source: Clerc and Kennedy 2002; Wetter's PSOCC on a mesh (GenOpt manual 3.1, 5.4).
/// Discrete variables are rounded, not coded in bits. One objective only.
#include "optimise/swarm.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::optimise {
namespace {

struct Particle {
    Position at, velocity;  ///< off the mesh
    Found best;             ///< on the mesh
};

double constriction(const SwarmOptions& options) {
    const double phi = options.cognitive + options.social;
    if (phi <= 4) return options.kappa;
    return 2 * options.kappa / std::abs(2 - phi - std::sqrt(phi * phi - 4 * phi));
}

std::vector<Particle> scattered(const Space& space, const SwarmOptions& options,
                                const Position& first, Stream& random) {
    std::vector<Particle> swarm(static_cast<std::size_t>(options.n_particles));
    for (Particle& particle : swarm) {
        particle.at = space.draw(random);
        for (std::size_t k = 0; k < space.size(); ++k)
            particle.velocity.push_back(options.most_velocity * space.highest(k) *
                                        (2 * random.uniform() - 1));
    }
    swarm[0].at = first;
    return swarm;
}

std::vector<Position> on_mesh(const Space& space, const std::vector<Particle>& swarm,
                              double mesh) {
    std::vector<Position> positions;
    positions.reserve(swarm.size());
    for (const Particle& particle : swarm)
        positions.push_back(space.snapped(particle.at, mesh));
    return positions;
}

void remember(std::vector<Particle>& swarm, const std::vector<Position>& positions,
              const Matrix& values) {
    for (std::size_t p = 0; p < swarm.size(); ++p) {
        Found& best = swarm[p].best;
        if (best.position.empty() || values(p, 0) < best.objectives[0])
            best = {positions[p], {values(p, 0)}};
    }
}

const Found& best_of(const std::vector<Particle>& swarm) {
    const auto better = [](const Particle& a, const Particle& b) {
        return a.best.objectives[0] < b.best.objectives[0];
    };
    return std::ranges::min_element(swarm, better)->best;
}

/// The best among a particle and its neighbours on the ring.
const Position& leader_of(const std::vector<Particle>& swarm, std::size_t p, int reach) {
    const auto n = static_cast<int>(swarm.size());
    const Found* leader = &swarm[p].best;
    for (int step = -reach; step <= reach; ++step) {
        const int other = ((static_cast<int>(p) + step) % n + n) % n;
        const Found& found = swarm[static_cast<std::size_t>(other)].best;
        if (found.objectives[0] < leader->objectives[0]) leader = &found;
    }
    return leader->position;
}

/// Where it meets an end of a range it stops there.
void move(const Space& space, const SwarmOptions& options, const Position& leader,
          Particle& particle, Stream& random) {
    const double chi = constriction(options);
    for (std::size_t k = 0; k < space.size(); ++k) {
        double& x = particle.at[k];
        double& v = particle.velocity[k];
        const double fastest = options.most_velocity * space.highest(k);
        v = chi *
            (v + options.cognitive * random.uniform() * (particle.best.position[k] - x) +
             options.social * random.uniform() * (leader[k] - x));
        v = std::clamp(v, -fastest, fastest);
        x += v;
        if (x >= 0 && x <= space.highest(k)) continue;
        x = std::clamp(x, 0.0, space.highest(k));
        v = 0;
    }
}

/// All follow what was known before the first of them moves.
void advance(const Space& space, const SwarmOptions& options,
             std::vector<Particle>& swarm, Stream& random) {
    std::vector<Position> leaders;
    leaders.reserve(swarm.size());
    for (std::size_t p = 0; p < swarm.size(); ++p)
        leaders.push_back(leader_of(swarm, p, options.neighbours));
    for (std::size_t p = 0; p < swarm.size(); ++p)
        move(space, options, leaders[p], swarm[p], random);
}

}  // namespace

sampling::Task<Found> swarm(Search& search, SwarmOptions options, Stream random,
                            Position first) {
    const Space& space = search.space();
    std::vector<Particle> particles = scattered(space, options, first, random);
    double best = std::numeric_limits<double>::infinity();
    int waited = 0;
    for (int g = 0; g < options.most_generations && waited < options.patience; ++g) {
        if (g > 0) advance(space, options, particles, random);
        const auto positions = on_mesh(space, particles, options.mesh);
        const Matrix values = co_await search.evaluate(positions);
        remember(particles, positions, values);
        const double now = best_of(particles).objectives[0];
        waited = now < best ? 0 : waited + 1;
        best = now;
    }
    co_return best_of(particles);
}

}  // namespace bemcal::optimise
