/// Something that answers points with numbers: our model over a period, paper 1's single
/// hour, later another program.
#pragma once

#include "physics/office_hour.hpp"
#include "study/case.hpp"

#include <memory>
#include <string>
#include <utility>
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

/// A case over a period: totals of the quantities over it [kWh], for a temperature its
/// mean.
std::shared_ptr<const Simulator> make_batch_simulator(
    const Case& building, const Period& period,
    std::vector<physics::Quantity> quantities);

/// Paper 1's hour (physics/office_hour.hpp): its inputs less the fixed ones are the
/// parameters, heating plus cooling energy is the output. Throws std::invalid_argument
/// for a name that is not one of the 19.
std::shared_ptr<const Simulator> make_office_hour_simulator(
    const std::vector<std::pair<std::string, double>>& fixed,
    const physics::OfficeHourAssumptions& assumptions = {});

}  // namespace bemcal::study
