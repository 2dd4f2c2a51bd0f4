/// What the loop found, and the datasets and the summary that say so.
#pragma once

#include "loop/found.hpp"
#include "loop/found_function.hpp"
#include "loop/learn_hours.hpp"
#include "loop/portrait.hpp"
#include "loop/power.hpp"
#include "loop/stored_loop.hpp"
#include "study/stage.hpp"

namespace bemcal::loop {

/// A line of the search's log: a candidate that was judged, or why the search ended.
struct LoggedStep {
    std::string effect, verdict;
    double gain = 0, threshold = 0, score = 0;
    std::vector<double> error{};  ///< [channels]
};

struct LoopResult {
    Baseline baseline;
    Standing last;                         ///< with effects
    std::vector<Found> found;              ///< [last.model.effects]
    std::vector<FoundFunction> functions;  ///< those of baseline.place
    std::vector<LearnedHours> hours;       ///< that nobody wrote down; plain lacks them
    std::vector<LoggedStep> log;
    PowerTable power;
    std::vector<study::PlaceEffect> of_the_place;  ///< where the options ask for them
    Localisation before, after;
    std::vector<Unexplained> unexplained;
    std::vector<std::pair<std::string, double>> candidates;  ///< of the last step
    std::vector<Named> undecided;  ///< names of what passed there and did not join
    /// Evidence of the best candidate that did not pass over what noise alone would show,
    /// at least 1: how much more than noise what the model cannot say moves its unknowns.
    double misfit = 1;
    int hours_late = 0;  ///< of the meters' clocks, which predictions follow
    std::vector<study::DataDecision> decisions;  ///< of periods
};

/// All that is stored of it but what models predict: no errors, no coverage.
/// \param stage  "BUILDING/STUDY"
StoredLoop without_predictions(const std::string& stage, const LoopData& written,
                               const LoopData& data, const LoopResult& result);

/// \param written  the building as the job has it, which is the plain one
study::Conclusion conclude_loop(const std::string& stage, const LoopData& written,
                                const LoopData& data, const LoopResult& result);

}  // namespace bemcal::loop
