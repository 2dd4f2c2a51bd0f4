/// Where a chain starts: it climbs from a draw of the prior to the mode above it, and
/// takes its first metric from the curvature there. A likelihood of thousands of readings
/// is so much narrower than its prior that a warm-up from the prior spends nearly all of
/// its gradients on the way.
///
/// L-BFGS with backtracking (Nocedal and Wright 2006, algorithms 7.4 and 3.1) in the real
/// coordinates; the Hessian by central differences of the gradient, over about
/// a standard deviation to each side, so that kinks average out. Each chain climbs from
/// its own start: chains that end on different modes still show that there are several.
#pragma once

#include "sampling/walker.hpp"

namespace bemcal::sampling {

/// Moves the walker's current point uphill until it hardly rises.
Task<> climb(Walker& walker);

/// Sets the metric to the inverse of the negative Hessian at the current point, each of
/// its standard deviations at most `widest`; then leaves for a random point at that
/// distance, so that chains start dispersed.
Task<> learn_curvature(Walker& walker);

}  // namespace bemcal::sampling
