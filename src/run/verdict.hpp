/// Whether a batch that has run to its end has also succeeded: failed points against the
/// share the job accepts, stages of which nothing succeeded, and targets that were
/// missed.
#pragma once

#include "base/error.hpp"
#include "store/result_file.hpp"
#include "study/stage.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::run {

/// Whether an item may succeed when it is done again (--rerun-failed).
bool deserves_rerun(const study::Stage& stage, const study::ItemAnswer& answer);

class Verdict {
  public:
    explicit Verdict(double max_failed_share) : max_failed_share_(max_failed_share) {}

    /// A stage that does not know its number of simulations counts items.
    void count(const study::Stage& stage, const std::vector<study::ItemAnswer>& answers);
    /// Targets that a result says were missed (datasets `shortfall`).
    void take_shortfalls(const std::vector<study::Dataset>& datasets);

    /// To /run of the result, and back.
    void store(std::map<std::string, std::string>& run) const;
    void take_stored(const std::map<std::string, std::string>& run);

    int n_to_rerun() const { return n_to_rerun_; }
    ExitCode code() const;  ///< data before not_reached
    std::vector<std::string> sentences() const;

  private:
    std::vector<std::string> failures() const;

    double max_failed_share_;
    double n_points_ = 0, n_failed_ = 0;
    int n_to_rerun_ = 0;
    std::string first_error_;
    std::vector<std::string> lost_stages_;  ///< a sentence for each
    std::string stored_;                    ///< of the run that wrote a result
    std::vector<std::string> shortfalls_;
};

/// The datasets that tell of missed targets: the stage's, and those of what it found, one
/// for each study. \param sentence  of the stage; empty = none
std::vector<study::Dataset> shortfall_datasets(const study::Stage& stage,
                                               const std::string& sentence,
                                               const std::vector<study::Summary>& found);

/// The datasets that tell of items that failed as a whole; none where none did.
std::vector<study::Dataset> failed_item_datasets(
    const study::Stage& stage, const std::vector<study::ItemAnswer>& answers);

}  // namespace bemcal::run
