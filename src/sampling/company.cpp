/// Evaluates what the coroutines wait for, as many points together as the density likes,
/// first come, first served, and resumes them.
/// Plain scheduling without a source. One thread only: cores are used by running several
/// calls.
#include "sampling/company.hpp"

#include <algorithm>

namespace bemcal::sampling {

Company::Company(Density& density, bool gradients)
    : density_(density), gradients_(gradients) {
    points_.cols = density.dimension();
}

void Company::run() {
    while (!waiting_.empty()) {
        const auto count =
            std::min(waiting_.size(), std::max<std::size_t>(density_.width(), 1));
        const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
        group_.assign(waiting_.begin(), end);
        waiting_.erase(waiting_.begin(), end);
        evaluate_group();
        for (const Request& request : group_) request.caller.resume();
    }
}

void Company::evaluate_group() {
    points_.rows = group_.size();
    points_.values.resize(points_.rows * points_.cols);
    for (std::size_t k = 0; k < group_.size(); ++k)
        std::ranges::copy(group_[k].point->x, points_.row(k).begin());
    density_.evaluate(points_, gradients_, values_);
    for (std::size_t k = 0; k < group_.size(); ++k) answer(k, *group_[k].point);
}

void Company::answer(std::size_t row, Point& point) const {
    point.prior = values_.prior[row];
    point.likelihood = values_.likelihood[row];
    if (!gradients_) return;
    std::ranges::copy(values_.prior_gradient.row(row), point.prior_gradient.begin());
    std::ranges::copy(values_.likelihood_gradient.row(row),
                      point.likelihood_gradient.begin());
}

}  // namespace bemcal::sampling
