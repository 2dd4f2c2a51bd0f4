/// Whether a batch that has run to its end has also succeeded: failed points against the
/// share the job accepts, and targets that were missed.
#pragma once

#include "base/error.hpp"
#include "store/result_file.hpp"
#include "study/stage.hpp"

#include <string>
#include <vector>

namespace bemcal::run {

class Verdict {
  public:
    explicit Verdict(double max_failed_share) : max_failed_share_(max_failed_share) {}

    /// A stage that does not know its number of simulations counts items.
    void count(const study::Stage& stage, const std::vector<study::ItemAnswer>& answers);
    /// Targets that a result says were missed (datasets `shortfall`).
    void take_shortfalls(const std::vector<study::Dataset>& datasets);

    ExitCode code() const;  ///< data before not_reached
    std::vector<std::string> sentences() const;

  private:
    bool is_over_budget() const { return n_failed_ > max_failed_share_ * n_points_; }

    double max_failed_share_;
    double n_points_ = 0, n_failed_ = 0;
    std::string first_error_;
    std::vector<std::string> shortfalls_;
};

/// The dataset that tells of a missed target. \param sentence  not empty
study::Dataset shortfall_dataset(const study::Stage& stage, const std::string& sentence);

}  // namespace bemcal::run
