/// A leapfrog step in whitened coordinates: half a kick, drift, half a kick; and a leaf's
/// energy.
/// Source: Neal 2011, section 2.3. Whole numbers do not move; divergence is judged by the
/// trajectory.
#include "sampling/leapfrog.hpp"

#include "sampling/normal.hpp"

namespace bemcal::sampling {
namespace {

void kick(Leaf& leaf, double half_step) {
    for (std::size_t i = 0; i < leaf.momentum.size(); ++i)
        leaf.momentum[i] += half_step * leaf.force[i];
}

void weigh(const Walker& walker, Leaf& leaf) {
    double twice_kinetic = 0;
    for (const double p : leaf.momentum) twice_kinetic += p * p;
    leaf.energy = 0.5 * twice_kinetic - walker.log_density(leaf.point);
}

}  // namespace

void complete(Walker& walker, Leaf& leaf) {
    walker.metric.whiten_gradient(leaf.point, walker.inverse_temperature, leaf.force);
    weigh(walker, leaf);
}

void draw_leaf(Walker& walker, Leaf& leaf) {
    leaf.point = walker.current;
    fill_standard_normal(walker.random, leaf.momentum);
    complete(walker, leaf);
}

void begin_step(Walker& walker, Leaf& leaf, double step_size) {
    kick(leaf, step_size / 2);
    walker.metric.move(leaf.point.x, step_size, leaf.momentum);
}

void finish_step(Walker& walker, Leaf& leaf, double step_size) {
    walker.metric.whiten_gradient(leaf.point, walker.inverse_temperature, leaf.force);
    kick(leaf, step_size / 2);
    weigh(walker, leaf);
}

}  // namespace bemcal::sampling
