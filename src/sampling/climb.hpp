/// Where a chain starts: it climbs from a draw of the prior to the mode above it, and
/// takes its first metric from the curvature there. A likelihood of thousands of readings
/// is so much narrower than its prior that a warm-up from the prior spends nearly all of
/// its gradients on the way.
///
/// L-BFGS with backtracking (Nocedal and Wright 2006, algorithms 7.4 and 3.1) in the real
/// coordinates; the Hessian by central differences of the gradient, over about
/// a standard deviation to each side, so that kinks average out. Where unknowns lie far
/// from each other in scale, or hang together closely, a climb ends thousands of nats
/// below the mode; so another follows from there by the new metric, and again, until one
/// rises by less than a nat. Each chain climbs from its own start: chains that end on
/// different modes still show that there are several.
#pragma once

#include "sampling/walker.hpp"

namespace bemcal::sampling {

/// Moves the walker's current point to the mode above it; sets the metric to the inverse
/// of the negative Hessian there, each of its standard deviations at most 4.
Task<> climb(Walker& walker);

/// To a random point at the metric's distance, so that chains start dispersed.
Task<> leave_mode(Walker& walker);

}  // namespace bemcal::sampling
