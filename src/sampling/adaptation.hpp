/// What a walker learns in its warm-up: step sizes all the way, its metric in windows
/// that double, as Stan does (reference manual, "HMC algorithm parameters": 75
/// transitions to arrive, windows of 25, 50, 100, ..., 50 for the last step size; shorter
/// warm-ups in the ratio 15 : 75 : 10).
///
/// A random walk learns its covariance from all windows so far, since its points follow
/// each other closely, and its scale without a restart.
#pragma once

#include "sampling/dual_averaging.hpp"
#include "sampling/walker.hpp"

#include <vector>

namespace bemcal::sampling {

/// The transitions, counted from 0, after which a window ends; the first starts at
/// `begin`.
struct Windows {
    int begin = 0;
    std::vector<int> ends;
};
Windows windows_of(int n_warm_up);

class Adaptation {
  public:
    Adaptation(const Walker& walker, const SamplerOptions& options);
    /// After each transition. True: the metric is a new one, for which nuts finds its
    /// step size again before restart().
    bool learn(Walker& walker);
    /// Starts from the walker's step sizes.
    void restart(const Walker& walker);
    /// Fixes the step sizes.
    void finish(Walker& walker) const;

  private:
    bool learn_metric(Walker& walker);

    Windows windows_;
    std::size_t next_window_ = 0;
    int n_transitions_ = 0;
    std::vector<DualAveraging> step_sizes_;
    RunningCovariance covariance_;
    bool keeps_first_;  ///< the metric of the curvature, until a window can better it
};

}  // namespace bemcal::sampling
