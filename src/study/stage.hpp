/// A stage of the plan: independent items, and what follows from their answers.
///
/// Stages are pure: they know no ranks, threads, files or terminal. An item's answer
/// depends on its index, the stage and the job's seed only. `run/` computes the items, in
/// any order, on any rank; `conclude` sees all of them in item order.
#pragma once

#include "base/matrix.hpp"

#include <memory>
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
};

class Stage {
  public:
    virtual ~Stage() = default;
    virtual std::string name() const = 0;  ///< "office/sensitivity": unique in the job
    virtual int n_items() const = 0;
    virtual long long n_simulations() const = 0;   ///< over all items
    virtual std::size_t answer_bytes() const = 0;  ///< of one item, about: for the plan
    virtual ItemAnswer run(int item) const = 0;    ///< thread-safe
    virtual std::vector<Dataset> conclude(
        const std::vector<ItemAnswer>& answers) const = 0;
};

}  // namespace bemcal::study
