/// What a walker learns in its warm-up: step sizes after each transition, the metric in
/// windows that double.
/// Source: Stan's reference manual, windowed adaptation, used for all methods;
/// acceptances 0.8, 0.234 and 0.44 by method. Temperatures are tuned in ladder_meeting;
/// nothing is learnt after the warm-up.
#include "sampling/adaptation.hpp"

#include <cmath>

namespace bemcal::sampling {
namespace {

double target_of(const SamplerOptions& options) {
    constexpr double targets[] = {0.8, 0.234, 0.44};
    if (options.target_acceptance > 0) return options.target_acceptance;
    return targets[static_cast<int>(options.method)];
}

}  // namespace

Windows windows_of(int n_warm_up) {
    constexpr int least_transitions = 20;
    if (n_warm_up < least_transitions) return {n_warm_up, {}};
    const bool is_short = n_warm_up < 75 + 25 + 50;
    const int arrival = is_short ? n_warm_up * 3 / 20 : 75;
    const int last = n_warm_up - (is_short ? n_warm_up / 10 : 50);
    Windows windows{arrival, {}};
    int size = is_short ? last - arrival : 25;
    for (int end = arrival; end < last; size *= 2) {
        // The window takes in the next where that would not fit.
        end = end + 3 * size > last ? last : end + size;
        windows.ends.push_back(end - 1);
    }
    return windows;
}

Adaptation::Adaptation(const Walker& walker, const SamplerOptions& options)
    : windows_(windows_of(options.n_warm_up)),
      step_sizes_(walker.scales.size(), DualAveraging(target_of(options))),
      covariance_(walker.metric.size(), walker.metric.shape()),
      keeps_first_(climbs_first(options)) {}

void Adaptation::restart(const Walker& walker) {
    for (std::size_t i = 0; i < step_sizes_.size(); ++i)
        step_sizes_[i].restart(walker.scales[i]);
}

bool Adaptation::learn(Walker& walker) {
    for (std::size_t i = 0; i < step_sizes_.size(); ++i)
        walker.scales[i] = step_sizes_[i].learn(walker.acceptances[i]);
    const bool is_new = learn_metric(walker);
    ++n_transitions_;
    return is_new;
}

bool Adaptation::learn_metric(Walker& walker) {
    if (n_transitions_ < windows_.begin || next_window_ == windows_.ends.size())
        return false;
    covariance_.add(walker.metric.real_part(walker.current.x));
    if (n_transitions_ < windows_.ends[next_window_]) return false;
    ++next_window_;
    const bool is_walk = walker.method == Method::random_walk;
    const int least_each = is_walk ? 10 : 3;
    if (keeps_first_ && !covariance_.is_full(least_each)) {
        covariance_.forget();
        return false;
    }
    if (walker.method != Method::gibbs)
        walker.metric.set_covariance(covariance_.regularised(least_each));
    if (!is_walk) covariance_.forget();
    return true;
}

void Adaptation::finish(Walker& walker) const {
    for (std::size_t i = 0; i < step_sizes_.size(); ++i)
        walker.scales[i] = step_sizes_[i].averaged_step();
}

}  // namespace bemcal::sampling
