/// A stage of the plan: independent items, and what follows from their answers.
///
/// Stages are pure: they know no ranks, threads, files or terminal. An item's answer
/// depends on its index, the stage and the job's seed only. `run/` computes the items, in
/// any order, on any rank; `conclude` sees all of them in item order.
///
/// A stage may go on in rounds: when all of its items are answered, it can ask for more,
/// which depend on those answers (chains go on from their last state). What the items of
/// the next round need is handed to every rank.
#pragma once

#include "base/matrix.hpp"
#include "study/activity.hpp"
#include "study/summary.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::study {

struct Failure {
    long long point;  ///< index of the failed point in the stage
    std::string reason;
};

struct ItemAnswer {
    std::vector<double> values;
    std::vector<Failure> failures;  ///< points that failed; the item itself went on
    std::string error;              ///< the whole item failed: why; empty = none
};

/// One dataset of the result: values with named dimensions. Units and meaning stand in
/// the store's layout table under the last part of `path`.
struct Dataset {
    std::string path;               ///< "office/sensitivity/total_order"
    std::vector<std::string> dims;  ///< "output", "parameter", ...
    std::vector<std::size_t> shape;
    std::vector<double> values;  ///< row-major; empty where texts is used
    std::vector<std::string> texts;
    std::string unit{};  ///< where the table's does not say it; empty = the table's
};

/// A stage's result: for the file, and for those that go on with it. Either may be empty.
struct Conclusion {
    std::vector<Dataset> datasets;
    std::vector<Summary> summaries{};
};

/// The items that follow when all before are answered.
struct Round {
    int n_items = 0;             ///< so many more
    std::vector<double> needed;  ///< what their computation starts from
};

class Stage {
  public:
    virtual ~Stage() = default;
    virtual std::string name() const = 0;  ///< "office/sensitivity": unique in the job
    /// On rank 0, before the first item: what the stages before it have found.
    virtual void see(const std::vector<Summary>& found) { static_cast<void>(found); }
    virtual int n_items() const = 0;              ///< of the first round
    virtual long long n_simulations() const = 0;  ///< over all items
    /// What n_simulations and failed points count.
    virtual const char* counts() const { return "simulations"; }
    virtual std::size_t answer_bytes() const = 0;  ///< of one item, about: for the plan
    virtual ItemAnswer run(int item) const = 0;    ///< thread-safe
    /// After a round, on rank 0, from the answers of all rounds so far; none: it is done.
    virtual std::optional<Round> next_round(const std::vector<ItemAnswer>&) const {
        return std::nullopt;
    }
    /// Every rank, before the items of that round. Its first item is `first_item`.
    virtual void begin_round(int first_item, const Round& round) {
        static_cast<void>(first_item);
        static_cast<void>(round);
    }
    /// Whether n_simulations are spread over rounds, or not known.
    virtual bool has_rounds() const { return n_simulations() == 0; }
    /// What the items of this round are.
    virtual const char* items_are() const { return "items"; }
    /// Of the items that run here, and of the rounds before. Called by the main thread
    /// while items run, never with next_round or begin_round.
    virtual Activity activity() const { return {}; }
    virtual Conclusion conclude(const std::vector<ItemAnswer>& answers) const = 0;
    /// Of a study of a simulator whose answer is one point: the values of all of the
    /// simulator's parameters; empty = it is none.
    virtual std::vector<double> best_point(const std::vector<ItemAnswer>&) const {
        return {};
    }
    /// Whether a failed point may succeed when it is done again: not where its input
    /// alone decides. (A whole item that fails always may.)
    virtual bool failures_may_pass() const { return false; }
    /// Why an answer that an earlier run left does not hold any more (a file that it read
    /// has changed), in a sentence; empty = it holds.
    virtual std::string outdated(int item, const ItemAnswer& answer) const {
        static_cast<void>(item);
        static_cast<void>(answer);
        return {};
    }
    /// A target that was not reached, in a sentence ("not converged: ..."); empty = none.
    /// The result is written all the same; the exit code says so.
    virtual std::string shortfall(const std::vector<ItemAnswer>&) const { return {}; }
};

using Stages = std::vector<std::unique_ptr<Stage>>;

}  // namespace bemcal::study
