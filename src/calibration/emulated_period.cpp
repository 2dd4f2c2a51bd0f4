/// Reads an emulated series as a model's readings of a period.
/// Follows from `SeriesEmulator`: the mean of the runs plus scores times components, of
/// the period's part alone.
/// The emulator's own error is left out: it is told beside the result.
#include "calibration/emulated_period.hpp"

#include "base/nan.hpp"
#include "kernel/plain_answer.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <utility>

namespace bemcal::calibration {
namespace {

class EmulatedPeriodModel : public PeriodModel {
  public:
    EmulatedPeriodModel(const study::Case& building, const study::Period& period,
                        const study::SeriesLayout& layout,
                        std::shared_ptr<const emulator::SeriesEmulator> emulator)
        : PeriodModel(building, period),
          parameters_(building.parameters),
          axis_(study::axis_of(building, period)),
          ranges_(layout.ranges(building, period)),
          emulator_(std::move(emulator)) {}

    std::vector<kernel::PointAnswer> evaluate(const Matrix& points,
                                              const AskedMeters& asked) const override {
        std::vector<kernel::PointAnswer> answers(points.rows);
        for (std::size_t r = 0; r < points.rows; ++r) {
            const std::vector<double> scores = scores_at(points.row(r));
            for (std::size_t k = 0; k < asked.meters.size(); ++k)
                kernel::add_errors(readings_at(scores, asked.meters[k]), axis_,
                                   asked.request.readings[k], answers[r]);
        }
        return answers;
    }
    study::CloseLook look(const study::Case&, const study::Period&,
                          std::span<const double> point,
                          const std::vector<physics::Quantity>& hourly) const override {
        study::CloseLook look;
        const std::vector<double> scores = scores_at(point);
        for (std::size_t m = 0; m < ranges_.size(); ++m)
            look.meters.push_back(
                study::compared(readings_at(scores, m), axis_, readings()[m]));
        look.hourly.assign(
            hourly.size(),
            std::vector<double>(static_cast<std::size_t>(axis_.n_steps), nan));
        return look;
    }

  private:
    /// A point that is moved off its range for a slope is read at the range's end.
    std::vector<double> scores_at(std::span<const double> point) const {
        std::vector<double> unit(point.size());
        for (std::size_t k = 0; k < unit.size(); ++k)
            unit[k] = std::clamp(study::on_scale(point[k], parameters_[k]), 0.0, 1.0);
        return emulator_->scores(unit);
    }
    std::vector<double> readings_at(const std::vector<double>& scores,
                                    std::size_t meter) const {
        const auto [first, size] = ranges_[meter];
        const emulator::SeriesComponents& parts = emulator_->parts();
        std::vector<double> readings(
            parts.mean.begin() + static_cast<std::ptrdiff_t>(first),
            parts.mean.begin() + static_cast<std::ptrdiff_t>(first + size));
        for (std::size_t c = 0; c < scores.size(); ++c) {
            const auto component = parts.components.row(c).subspan(first, size);
            for (std::size_t k = 0; k < size; ++k)
                readings[k] += scores[c] * component[k];
        }
        return readings;
    }

    std::vector<physics::Parameter> parameters_;
    physics::TimeAxis axis_;
    std::vector<emulator::ChannelRange> ranges_;  ///< [meters]
    std::shared_ptr<const emulator::SeriesEmulator> emulator_;
};

}  // namespace

std::unique_ptr<PeriodModel> emulated_period_model(
    const study::Case& building, const study::Period& period,
    const study::SeriesLayout& layout,
    std::shared_ptr<const emulator::SeriesEmulator> emulator) {
    return std::make_unique<EmulatedPeriodModel>(building, period, layout,
                                                 std::move(emulator));
}

}  // namespace bemcal::calibration
