/// The step size that reaches a target acceptance, by dual averaging.
/// Source: Hoffman and Gelman 2014, section 3.2, algorithm 5's lines on the step size.
/// Where it starts from is find_step_size's; one instance learns one scale.
#include "sampling/dual_averaging.hpp"

#include <cmath>

namespace bemcal::sampling {

void DualAveraging::restart(double step) {
    centre_ = std::log(10 * step);
    mean_shortfall_ = 0;
    averaged_log_step_ = std::log(step);
    count_ = 0;
}

double DualAveraging::learn(double acceptance) {
    constexpr double gamma = 0.05, t_0 = 10, kappa = 0.75;
    ++count_;
    const double share = 1 / (count_ + t_0);
    mean_shortfall_ += share * (target_ - acceptance - mean_shortfall_);
    const double log_step = centre_ - mean_shortfall_ * std::sqrt(count_) / gamma;
    averaged_log_step_ += std::pow(count_, -kappa) * (log_step - averaged_log_step_);
    return std::exp(log_step);
}

double DualAveraging::averaged_step() const {
    return std::exp(averaged_log_step_);
}

}  // namespace bemcal::sampling
