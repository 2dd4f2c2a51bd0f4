/// How runs of another program are shared between a design over its parameters' ranges
/// and rounds where the study has come to so far.
#pragma once

#include <algorithm>

namespace bemcal::study {

class RunsBudget {
  public:
    explicit RunsBudget(int n_runs)
        : of_round_(std::max(2, n_runs / 8)),
          design_(std::max(4, n_runs - n_rounds * of_round_)) {}
    int design() const { return design_; }
    int of_round() const { return of_round_; }
    int all() const { return design_ + n_rounds * of_round_; }

  private:
    static constexpr int n_rounds = 3;
    int of_round_, design_;
};

}  // namespace bemcal::study
