/// Leads a calibration from stage to stage: values carried over or held, ranges, an
/// optimiser, its best point. Made anew and told the same, it is where it was.
/// Source: paper 2, with branches that give a season values of its own.
/// It simulates nothing (`staged_goal` does), and never goes back to a stage.
#include "calibration/staged_path.hpp"

#include "base/nan.hpp"
#include "calibration/method.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bemcal::calibration {
namespace {

constexpr std::uint32_t staged_stream = 0x73746167;

struct Range {
    double least, most;
};

/// The stage's range, or the share around the value carried over, within the parameter's
/// own.
Range range_of(const CalibrationStage& stage, const physics::Parameter& parameter,
               double carried) {
    const auto given =
        std::ranges::find(stage.ranges, parameter.name, &NamedRange::parameter);
    if (given != stage.ranges.end()) return {given->least, given->most};
    const double reach = stage.around * std::abs(carried);
    if (!(reach > 0)) return {parameter.least, parameter.most};
    const double least = std::max(parameter.least, carried - reach),
                 most = std::min(parameter.most, carried + reach);
    return least < most ? Range{least, most} : Range{parameter.least, parameter.most};
}

}  // namespace

StagedPath::StagedPath(const std::vector<physics::Parameter>& parameters,
                       const std::vector<study::ParameterPrior>& priors,
                       const std::vector<CalibrationStage>& stages)
    : parameters_(parameters),
      priors_(priors),
      stages_(stages),
      nominal_(study::nominal_point(parameters)) {
    begin_stage();
}

const std::vector<double>& StagedPath::carried(const std::string& from) const {
    for (std::size_t s = 0; s + 1 < found_.size(); ++s)
        if (stages_[s].name == from) return found_[s].value;
    return nominal_;
}

/// Also writes the range to the record.
optimise::Variable StagedPath::variable_of(std::size_t k, StageFound& found) const {
    const Range range = range_of(stages_[stage()], parameters_[k], found.start[k]);
    found.least[k] = range.least;
    found.most[k] = range.most;
    optimise::Variable variable{
        range.least, range.most, {}, std::clamp(found.start[k], range.least, range.most)};
    if (k < priors_.size()) variable.values = priors_[k].values;
    return variable;
}

void StagedPath::begin_stage() {
    found_.emplace_back();
    const CalibrationStage& stage = stages_[found_.size() - 1];
    StageFound& found = found_.back();
    found.start = carried(stage.from);
    for (const NamedValue& each : stage.set)
        for (std::size_t k = 0; k < parameters_.size(); ++k)
            if (parameters_[k].name == each.parameter) found.start[k] = each.value;
    found.value = found.start;
    found.least.assign(parameters_.size(), nan);
    found.most = found.least;
    varied_.clear();
    std::vector<optimise::Variable> variables;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
        if (std::ranges::find(stage.parameters, parameters_[k].name) ==
            stage.parameters.end())
            continue;
        varied_.push_back(k);
        variables.push_back(variable_of(k, found));
    }
    optimise::Limits limits;
    limits.evaluations = stage.fit.evaluations;
    optimiser_ = std::make_unique<optimise::Optimiser>(
        optimise::Space(std::move(variables)), 1, limits,
        method_of(stage.fit,
                  staged_stream + static_cast<std::uint32_t>(found_.size() - 1)));
}

Matrix StagedPath::next_points() const {
    const Matrix varied = optimiser_->next_points();
    Matrix points(varied.rows, parameters_.size());
    for (std::size_t r = 0; r < points.rows; ++r) {
        std::ranges::copy(found_.back().start, points.row(r).begin());
        for (std::size_t k = 0; k < varied_.size(); ++k)
            points(r, varied_[k]) = varied(r, k);
    }
    return points;
}

/// Where every point failed, the values carried over stay.
void StagedPath::take_best() {
    StageFound& found = found_.back();
    found.n_evaluated = optimiser_->n_evaluated();
    const Matrix best = optimiser_->found_points();
    if (best.rows == 0 || !std::isfinite(optimiser_->found()[0].objectives[0])) return;
    found.objective = optimiser_->found()[0].objectives[0];
    for (std::size_t k = 0; k < varied_.size(); ++k) found.value[varied_[k]] = best(0, k);
}

void StagedPath::tell(const std::vector<double>& objectives) {
    Matrix values(objectives.size(), 1);
    values.values = objectives;
    optimiser_->tell(values);
    if (optimiser_->next_points().rows > 0) return;
    take_best();
    if (found_.size() < stages_.size()) begin_stage();
}

}  // namespace bemcal::calibration
