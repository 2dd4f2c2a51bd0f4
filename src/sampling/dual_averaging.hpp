/// The step size that reaches a target acceptance: Nesterov's dual averaging as Hoffman
/// and Gelman 2014 use it (JMLR 15, section 3.2, gamma = 0.05, t0 = 10, kappa = 0.75).
#pragma once

namespace bemcal::sampling {

class DualAveraging {
  public:
    explicit DualAveraging(double target) : target_(target) {}
    /// Forgets; steps are drawn towards ten times this one, to try large steps early.
    void restart(double step);
    /// The next step to try, after a transition with that mean acceptance probability.
    double learn(double acceptance);
    double averaged_step() const;

  private:
    double target_;
    double centre_ = 0, mean_shortfall_ = 0, averaged_log_step_ = 0;
    int count_ = 0;
};

}  // namespace bemcal::sampling
