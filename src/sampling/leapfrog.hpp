/// Hamilton's dynamics in leapfrog steps, in coordinates whitened by the walker's metric:
/// reversible and volume-preserving (Neal 2011, arXiv:1206.1901, section 2.3).
#pragma once

#include "sampling/walker.hpp"

namespace bemcal::sampling {

/// Force and energy of a leaf whose point is evaluated.
void complete(Walker& walker, Leaf& leaf);
/// The walker's current point with a momentum drawn anew.
void draw_leaf(Walker& walker, Leaf& leaf);
/// A step: half a kick and the drift, `co_await walker.evaluate(leaf.point)`,
/// finish_step.
void begin_step(Walker& walker, Leaf& leaf, double step_size);
void finish_step(Walker& walker, Leaf& leaf, double step_size);

}  // namespace bemcal::sampling
