/// Answers points with heating plus cooling energy of paper 1's single hour. Fixed inputs
/// keep their value, the others vary over their ranges.
/// Source: paper 1, step 1 and Table 2, by `office_hour_energy`.
/// The fast kernel is not used. An impossible box is a failed point.
#include "physics/office_hour.hpp"
#include "sensitivity/simulators.hpp"

#include <cmath>

namespace bemcal::sensitivity {
namespace {

using Fixed = std::vector<std::pair<std::string, double>>;

class OfficeHourSimulator : public study::Simulator {
  public:
    OfficeHourSimulator(const Fixed& fixed,
                        const physics::OfficeHourAssumptions& assumptions)
        : assumptions_(assumptions) {
        const auto inputs = physics::office_hour_inputs();
        inputs_.resize(inputs.size());
        std::vector<bool> is_fixed(inputs.size());
        for (const auto& [name, value] : fixed) {
            inputs_[physics::office_hour_input_number(name)] = value;
            is_fixed[physics::office_hour_input_number(name)] = true;
        }
        for (std::size_t k = 0; k < inputs.size(); ++k)
            if (!is_fixed[k]) vary(k, inputs[k]);
    }

    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }

    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, 1);
        failures.assign(points.rows, {});
        std::vector<double> inputs = inputs_;
        for (std::size_t r = 0; r < points.rows; ++r) {
            for (std::size_t k = 0; k < varied_.size(); ++k)
                inputs[varied_[k]] = points(r, k);
            answers(r, 0) = physics::office_hour_energy(inputs, assumptions_);
            if (std::isnan(answers(r, 0))) failures[r] = "the box is impossible";
        }
    }

  private:
    void vary(std::size_t number, const physics::OfficeHourInput& input) {
        varied_.push_back(number);
        physics::Parameter parameter;
        parameter.name = input.name;
        parameter.unit = input.unit;
        parameter.least = input.least;
        parameter.most = input.most;
        parameter.nominal = (input.least + input.most) / 2;
        parameters_.push_back(std::move(parameter));
    }

    physics::OfficeHourAssumptions assumptions_;
    std::vector<double> inputs_;       ///< fixed values in their places
    std::vector<std::size_t> varied_;  ///< number of the input that each parameter is
    std::vector<physics::Parameter> parameters_;
    std::vector<study::Output> outputs_{{"energy", "kWh"}};
};

}  // namespace

std::shared_ptr<const study::Simulator> make_office_hour_simulator(
    const Fixed& fixed, const physics::OfficeHourAssumptions& assumptions) {
    return std::make_shared<OfficeHourSimulator>(fixed, assumptions);
}

}  // namespace bemcal::sensitivity
