/// Answers points with a building's totals over a period (means of a temperature), by the
/// fast kernel.
/// Follows from `Batch`; a point that fails is a row of NaN with its reason.
/// Leaves out months and peaks (`target_simulator`), and series by step.
#include "base/nan.hpp"
#include "sensitivity/simulators.hpp"

#include <algorithm>

namespace bemcal::sensitivity {
namespace {

std::vector<study::Output> outputs_of(const std::vector<physics::Quantity>& quantities) {
    std::vector<study::Output> outputs;
    outputs.reserve(quantities.size());
    for (const auto quantity : quantities)
        outputs.push_back({physics::name_of(quantity), physics::unit_of(quantity)});
    return outputs;
}

class BatchSimulator : public study::Simulator {
  public:
    BatchSimulator(const study::Case& building, const study::Period& period,
                   std::vector<physics::Quantity> quantities)
        : building_(building.building),
          drive_(study::drive_of(building, period)),
          batch_(building_, building.parameters, drive_),
          outputs_(outputs_of(quantities)),
          request_{std::move(quantities), {}, {}} {}

    const std::vector<physics::Parameter>& parameters() const override {
        return batch_.parameters();
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }

    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, outputs_.size(), nan);
        failures.assign(points.rows, {});
        const auto found = batch_.evaluate(points, request_);
        for (std::size_t r = 0; r < found.size(); ++r) {
            failures[r] = found[r].failure;
            if (failures[r].empty())
                std::ranges::copy(found[r].annual, answers.row(r).begin());
        }
    }

  private:
    physics::Building building_;
    physics::Drive drive_;
    kernel::Batch batch_;
    std::vector<study::Output> outputs_;
    kernel::Request request_;
};

}  // namespace

std::shared_ptr<const study::Simulator> make_batch_simulator(
    const study::Case& building, const study::Period& period,
    std::vector<physics::Quantity> quantities) {
    return std::make_shared<BatchSimulator>(building, period, std::move(quantities));
}

}  // namespace bemcal::sensitivity
