/// The no-U-turn sampler: a transition that doubles its trajectory until it turns back,
/// and the search for a first step size.
/// Source: Hoffman and Gelman 2014 (algorithm 4 for the step size, Stan's threshold 0.8);
/// Betancourt 2017. Weights and U-turns are left to trajectory, whole numbers to
/// metropolis. Not Stan's: it asks for one density at a time, and here chains go in
/// lockstep, a simulation of each in a lane.
#include "sampling/leapfrog.hpp"

#include <cmath>
#include <utility>

namespace bemcal::sampling {
namespace {

/// Grows the trajectory at one end until it has twice its length; false: it must end.
Task<bool> grow(Walker& walker) {
    Trajectory& tree = walker.trajectory;
    tree.begin_subtree(walker.random);
    const double step_size = tree.direction() * walker.scales[0];
    while (!tree.subtree_is_complete()) {
        begin_step(walker, tree.edge(), step_size);
        co_await walker.evaluate(tree.edge().point);
        finish_step(walker, tree.edge(), step_size);
        if (!tree.add_leaf(walker.random)) co_return false;
    }
    co_return tree.join(walker.random);
}

}  // namespace

Task<Transition> nuts(Walker& walker) {
    Trajectory& tree = walker.trajectory;
    draw_leaf(walker, tree.root());
    tree.begin();
    bool goes_on = true;
    while (goes_on && tree.may_grow()) goes_on = co_await grow(walker);
    std::swap(walker.current, tree.sample());
    walker.acceptances[0] = tree.mean_acceptance();
    co_return Transition{tree.mean_acceptance(), tree.n_steps(), tree.depth(),
                         tree.diverging()};
}

Task<> find_step_size(Walker& walker) {
    constexpr int most_tries = 60;
    Leaf& leaf = walker.trajectory.root();
    double& step_size = walker.scales[0];
    double factor = 1;
    for (int k = 0; k < most_tries; ++k) {
        draw_leaf(walker, leaf);
        const double energy = leaf.energy;
        begin_step(walker, leaf, step_size);
        co_await walker.evaluate(leaf.point);
        finish_step(walker, leaf, step_size);
        const double wanted = energy - leaf.energy > std::log(0.8) ? 2 : 0.5;
        if (factor == 1) factor = wanted;
        if (wanted != factor) break;
        step_size *= factor;
    }
}

}  // namespace bemcal::sampling
