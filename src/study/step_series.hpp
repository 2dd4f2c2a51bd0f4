/// Points simulated step by step, in one quantity: for what no sum over a period tells.
#pragma once

#include "kernel/batch.hpp"

#include <algorithm>
#include <vector>

namespace bemcal::study {

/// A point's series among those simulated with it.
class LaneSeries {
  public:
    LaneSeries(const double* values, std::size_t n_steps, std::size_t lanes)
        : values_(values), n_steps_(n_steps), lanes_(lanes) {}
    std::size_t size() const { return n_steps_; }
    double operator[](std::size_t step) const { return values_[step * lanes_]; }

  private:
    const double* values_;
    std::size_t n_steps_, lanes_;
};

/// Calls action(row, series) for each of the points [n x parameters]: power [W], or
/// temperature [degC], in each of the period's steps. An impossible point has no sense.
template <class Action>
void for_each_series(const kernel::Batch& batch, const Matrix& points,
                     physics::Quantity quantity, int n_steps, Action action) {
    const auto lanes = static_cast<std::size_t>(batch.lanes());
    const auto n = static_cast<std::size_t>(n_steps);
    const auto group = batch.make_group();
    std::vector<double> steps(n * lanes);
    for (std::size_t first = 0; first < points.rows; first += lanes) {
        const std::size_t count = std::min(lanes, points.rows - first);
        batch.prepare(points, first, count, *group);
        batch.warm_up(*group);
        batch.advance(*group, 0, n_steps, quantity, steps.data());
        for (std::size_t lane = 0; lane < count; ++lane)
            action(first + lane, LaneSeries(steps.data() + lane, n, lanes));
    }
}

}  // namespace bemcal::study
