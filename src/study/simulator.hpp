/// Something that answers points with numbers: our model over a period, paper 1's single
/// hour, another program.
#pragma once

#include "study/case.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::study {

struct Output {
    std::string name, unit;
};

/// Const means shareable: `evaluate` is called by many threads at once.
class Simulator {
  public:
    virtual ~Simulator() = default;
    virtual const std::vector<physics::Parameter>& parameters() const = 0;
    virtual const std::vector<Output>& outputs() const = 0;
    /// Whether a point takes seconds: then an item should hold few.
    virtual bool is_slow() const { return false; }
    /// \param points    [n x parameters]
    /// \param answers   [n x outputs], NaN in the rows of failed points
    /// \param failures  [n] reasons, empty = none
    virtual void evaluate(const Matrix& points, Matrix& answers,
                          std::vector<std::string>& failures) const = 0;
    /// Whether a failed point may succeed when it is done again: not where its numbers
    /// alone decide.
    virtual bool failures_may_pass() const { return false; }
};

}  // namespace bemcal::study
