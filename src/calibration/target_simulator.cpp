/// Answers points with single numbers of a building over a period (totals, months,
/// highest hours), and takes the same numbers from its meters.
/// Follows from what bills and meters show, as in paper 3.
/// Totals and months of a meter need all of its readings; a highest hour needs readings
/// by the hour or finer, but not all.
#include "calibration/target_simulator.hpp"

#include "base/nan.hpp"
#include "study/step_series.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

using physics::Interval;
using physics::is_temperature;
using physics::Quantity;

/// The quantities that a statistic asks for, each once.
std::vector<Quantity> asked(const std::vector<OutputSpec>& specs, Statistic statistic) {
    std::vector<Quantity> found;
    for (const OutputSpec& spec : specs)
        if (spec.statistic == statistic && std::ranges::count(found, spec.quantity) == 0)
            found.push_back(spec.quantity);
    return found;
}

std::size_t place_of(const std::vector<Quantity>& quantities, Quantity quantity) {
    return static_cast<std::size_t>(std::ranges::find(quantities, quantity) -
                                    quantities.begin());
}

/// The highest mean over an hour [W or degC].
double highest_hour(const study::LaneSeries& steps, std::size_t steps_per_hour) {
    double highest = -std::numeric_limits<double>::infinity();
    const std::size_t n_hours = steps.size() / steps_per_hour;
    for (std::size_t hour = 0; hour < n_hours; ++hour) {
        double sum = 0;
        for (std::size_t s = 0; s < steps_per_hour; ++s)
            sum += steps[hour * steps_per_hour + s];
        highest = std::max(highest, sum / static_cast<double>(steps_per_hour));
    }
    return highest;
}

class TargetSimulator : public study::Simulator {
  public:
    TargetSimulator(const study::Case& building, const study::Period& period,
                    std::vector<OutputSpec> specs)
        : building_(building.building),
          drive_(study::drive_of(building, period)),
          batch_(building_, building.parameters, drive_),
          specs_(std::move(specs)),
          request_{
              asked(specs_, Statistic::period), asked(specs_, Statistic::months), {}},
          peaks_(asked(specs_, Statistic::peak)),
          n_steps_(study::axis_of(building, period).n_steps),
          steps_per_hour_(static_cast<std::size_t>(3600 / building.step_s)) {
        for (const OutputSpec& spec : specs_) {
            std::vector<study::Output> outputs = outputs_of(spec, building, period);
            std::ranges::move(outputs, std::back_inserter(outputs_));
        }
    }

    const std::vector<physics::Parameter>& parameters() const override {
        return batch_.parameters();
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }
    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override;

  private:
    Matrix peaks_of(const Matrix& points) const;
    void add_peaks(const Matrix& points, std::size_t column, Matrix& peaks) const;
    std::vector<double> row_of(const kernel::PointAnswer& answer,
                               std::span<const double> peaks) const;

    physics::Building building_;
    physics::Drive drive_;
    kernel::Batch batch_;
    std::vector<OutputSpec> specs_;
    kernel::Request request_;
    std::vector<Quantity> peaks_;
    std::vector<study::Output> outputs_;
    int n_steps_;
    std::size_t steps_per_hour_;
};

/// \param answers  gets the answers [n x outputs]
void TargetSimulator::evaluate(const Matrix& points, Matrix& answers,
                               std::vector<std::string>& failures) const {
    answers = Matrix(points.rows, outputs_.size(), nan);
    failures.assign(points.rows, {});
    const auto found = batch_.evaluate(points, request_);
    const Matrix peaks = peaks_of(points);
    for (std::size_t r = 0; r < found.size(); ++r) {
        failures[r] = found[r].failure;
        if (failures[r].empty())
            std::ranges::copy(row_of(found[r], peaks.row(r)), answers.row(r).begin());
    }
}

std::vector<double> TargetSimulator::row_of(const kernel::PointAnswer& answer,
                                            std::span<const double> peaks) const {
    const auto n_months = static_cast<std::ptrdiff_t>(batch_.n_months());
    std::vector<double> row;
    row.reserve(outputs_.size());
    for (const OutputSpec& spec : specs_) {
        if (spec.statistic == Statistic::period)
            row.push_back(answer.annual[place_of(request_.annual, spec.quantity)]);
        if (spec.statistic == Statistic::peak)
            row.push_back(peaks[place_of(peaks_, spec.quantity)]);
        if (spec.statistic != Statistic::months) continue;
        const auto first =
            answer.monthly.begin() +
            static_cast<std::ptrdiff_t>(place_of(request_.monthly, spec.quantity)) *
                n_months;
        row.insert(row.end(), first, first + n_months);
    }
    return row;
}

/// \return [n x peaks_]
Matrix TargetSimulator::peaks_of(const Matrix& points) const {
    Matrix peaks(points.rows, peaks_.size(), nan);
    for (std::size_t column = 0; column < peaks_.size(); ++column)
        add_peaks(points, column, peaks);
    return peaks;
}

void TargetSimulator::add_peaks(const Matrix& points, std::size_t column,
                                Matrix& peaks) const {
    const double unit = is_temperature(peaks_[column]) ? 1 : 1e-3;
    study::for_each_series(batch_, points, peaks_[column], n_steps_,
                           [&](std::size_t row, const study::LaneSeries& series) {
                               peaks(row, column) =
                                   unit * highest_hour(series, steps_per_hour_);
                           });
}

/// Readings of the period at an interval not coarser than wanted.
kernel::Readings readings_at(const study::Case& building, const study::Period& period,
                             std::size_t meter, Interval coarsest) {
    kernel::Readings readings = study::readings_of(building, period).at(meter);
    if (readings.interval > coarsest)
        throw std::invalid_argument(fmt::format(
            "{} is read by {} intervals; expected {} or finer",
            building.meters[meter].name, name_of(readings.interval), name_of(coarsest)));
    return readings;
}

/// Sums, or means, of readings over stretches that begin at these steps.
std::vector<double> gathered(const kernel::Readings& readings,
                             const physics::TimeAxis& axis,
                             const std::vector<int>& bounds) {
    const std::vector<int> own = physics::interval_bounds(axis, readings.interval);
    std::vector<double> sums(bounds.size() - 1, 0), steps(sums.size(), 0);
    for (std::size_t k = 0, at = 0; k < readings.values.size(); ++k) {
        while (own[k] >= bounds[at + 1]) ++at;
        const double n = is_temperature(readings.quantity) ? own[k + 1] - own[k] : 1;
        sums[at] += n * readings.values[k];
        steps[at] += n;
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
        if (is_temperature(readings.quantity)) sums[k] /= steps[k];
    return sums;
}

/// Missing ones are left out; NaN of none.
double highest_of(const std::vector<double>& values) {
    double highest = nan;
    for (const double value : values)
        if (!std::isnan(value) && !(value <= highest)) highest = value;
    return highest;
}

std::string month_name(physics::Seconds begin) {
    return physics::format_time(begin).substr(0, 7);
}

}  // namespace

std::vector<study::Output> outputs_of(const OutputSpec& spec, const study::Case& building,
                                      const study::Period& period) {
    const std::string name = physics::name_of(spec.quantity),
                      unit = physics::unit_of(spec.quantity);
    if (spec.statistic == Statistic::period) return {{name, unit}};
    if (spec.statistic == Statistic::peak)
        return {{"peak " + name, is_temperature(spec.quantity) ? unit : "kW"}};
    std::vector<study::Output> outputs;
    for (const auto begin :
         study::begins_of(study::axis_of(building, period), Interval::monthly))
        outputs.push_back({name + " " + month_name(begin), unit});
    return outputs;
}

std::shared_ptr<const study::Simulator> make_target_simulator(
    const study::Case& building, const study::Period& period,
    std::vector<OutputSpec> specs) {
    return std::make_shared<TargetSimulator>(building, period, std::move(specs));
}

std::vector<double> measured_outputs(const OutputSpec& spec, const study::Case& building,
                                     const study::Period& period, std::size_t meter) {
    const physics::TimeAxis axis = study::axis_of(building, period);
    const bool is_peak = spec.statistic == Statistic::peak;
    const Interval coarsest = is_peak                               ? Interval::hourly
                              : spec.statistic == Statistic::months ? Interval::monthly
                                                                    : Interval::annual;
    const auto readings = readings_at(building, period, meter, coarsest);
    std::vector<double> values =
        gathered(readings, axis,
                 coarsest == Interval::annual ? std::vector<int>{0, axis.n_steps}
                                              : physics::interval_bounds(axis, coarsest));
    if (is_peak) values = {highest_of(values)};
    const std::vector<study::Output> outputs = outputs_of(spec, building, period);
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]))
            throw std::invalid_argument(fmt::format(
                "{}: readings of {} are missing in {}; expected all of them, "
                "or the number itself as measured",
                outputs.at(k).name, building.meters[meter].name, period.name));
    return values;
}

}  // namespace bemcal::calibration
