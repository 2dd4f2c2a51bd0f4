/// A simulator whose answers are formulas: "power" = 2 lights + 3 devices, "heat" = 100
/// air
/// + 10 (set_point - 10) - power, and nothing follows "colour". It fails where the air is
/// above `fails_above`.
#pragma once

#include "study/simulator.hpp"

#include <limits>

namespace bemcal::test {

class AnalyticSimulator : public study::Simulator {
  public:
    explicit AnalyticSimulator(double fails_above = 1e9) : fails_above_(fails_above) {
        for (const char* name : {"lights", "devices", "air", "set_point", "colour"}) {
            physics::Parameter parameter;
            parameter.name = name;
            parameter.unit = "-";
            parameter.least = 0;
            parameter.most = 20;
            parameter.nominal = 5;
            parameters_.push_back(parameter);
        }
    }
    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }
    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, 2, std::numeric_limits<double>::quiet_NaN());
        failures.assign(points.rows, {});
        for (std::size_t r = 0; r < points.rows; ++r) {
            if (points(r, 2) > fails_above_) {
                failures[r] = "too much air";
                continue;
            }
            const double power = 2 * points(r, 0) + 3 * points(r, 1);
            answers(r, 0) = power;
            answers(r, 1) = 100 * points(r, 2) + 10 * (points(r, 3) - 10) - power;
        }
    }

  private:
    double fails_above_;
    std::vector<physics::Parameter> parameters_;
    std::vector<study::Output> outputs_{{"power", "kWh"}, {"heat", "kWh"}};
};

}  // namespace bemcal::test
