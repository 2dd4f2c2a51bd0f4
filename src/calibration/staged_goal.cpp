/// Computes the objective of one stage: the error sums of its periods taken together,
/// meters by weight; of a likelihood also priors, and errors near in time as one.
/// Source: paper 2, eq. 1-4, by `objective_term`.
/// NSGA-II, and priors on discrete parameters, are left out.
#include "calibration/staged_goal.hpp"

#include "base/nan.hpp"
#include "calibration/meter_goal.hpp"
#include "physics/interval_hours.hpp"

#include <algorithm>
#include <stdexcept>

namespace bemcal::calibration {
namespace {

/// Sums over periods taken together.
void add(const kernel::ErrorSums& some, kernel::ErrorSums& all) {
    using Sums = kernel::ErrorSums;
    for (double Sums::* part :
         {&Sums::n, &Sums::error, &Sums::square, &Sums::simulated,
          &Sums::simulated_square, &Sums::product, &Sums::n_relative, &Sums::relative})
        all.*part += some.*part;
}

bool is_read(const std::vector<const PeriodModel*>& models, std::size_t meter) {
    return std::ranges::any_of(models, [&](const PeriodModel* model) {
        return study::has_reading(model->readings()[meter].values);
    });
}

/// Meters of those names, or all that are read.
std::vector<std::size_t> chosen_meters(const study::Case& building,
                                       const CalibrationStage& stage,
                                       const std::vector<const PeriodModel*>& models) {
    std::vector<std::size_t> chosen = meters_named(building, stage.fit.meters);
    for (std::size_t m = 0; stage.fit.meters.empty() && m < building.meters.size(); ++m)
        if (is_read(models, m)) chosen.push_back(m);
    if (chosen.empty())
        throw std::invalid_argument("the stage " + stage.name + " has no meter in " +
                                    building.name + " that is read");
    return chosen;
}

/// Of what the stage calibrates; the others have no part.
std::vector<stats::Prior> counted_priors(const study::Case& building,
                                         const CalibrationStage& stage) {
    std::vector<stats::Prior> priors(building.parameters.size(),
                                     {stats::PriorKind::fixed});
    if (stage.independent_hours <= 0) return priors;
    for (std::size_t k = 0; k < building.priors.size(); ++k)
        if (building.priors[k].values.empty() &&
            std::ranges::find(stage.parameters, building.parameters[k].name) !=
                stage.parameters.end())
            priors[k] = building.priors[k].prior;
    return priors;
}

}  // namespace

StageGoal::StageGoal(const study::Case& building, const PeriodModels& models,
                     const CalibrationStage& stage)
    : fit_(stage.fit), priors_(counted_priors(building, stage)) {
    for (const std::string& name : stage.periods)
        models_.push_back(models.at(name).get());
    meters_ = chosen_meters(building, stage, models_);
    for (const PeriodModel* model : models_) asked_.push_back(model->some(meters_));
    for (const std::size_t m : meters_) {
        const double hours = hours_of(building.meters[m].interval, building.step_s);
        share_.push_back(stage.independent_hours > 0
                             ? std::min(1.0, hours / stage.independent_hours)
                             : 1);
    }
    for (std::size_t p = 0; p < stage.periods.size(); ++p)
        for (std::size_t m = 0; m < meters_.size(); ++m)
            if (!study::has_reading(asked_[p].request.readings[m].values))
                throw std::invalid_argument("the meter " +
                                            building.meters[meters_[m]].name +
                                            " has no reading in " + stage.periods[p] +
                                            ", a period of the stage " + stage.name);
    if (!fit_.meter_weights.empty() && fit_.meter_weights.size() != meters_.size())
        throw std::invalid_argument("the stage " + stage.name +
                                    " needs a weight for each of its meters");
}

double StageGoal::objective_of(
    const std::vector<const kernel::PointAnswer*>& answers) const {
    double sum = 0;
    for (std::size_t m = 0; m < meters_.size(); ++m) {
        kernel::ErrorSums own, monthly;
        for (const kernel::PointAnswer* answer : answers) {
            add(answer->errors[m], own);
            add(answer->monthly_errors[m], monthly);
        }
        const study::MeterFit fit =
            study::fit_of(asked_[0].request.readings[m], own, monthly);
        const bool is_monthly = fit_.resolution == ObjectiveResolution::monthly;
        const double weight = fit_.meter_weights.empty() ? 1 : fit_.meter_weights[m];
        sum +=
            weight * share_[m] * objective_term(is_monthly ? fit.monthly : fit.own, fit_);
    }
    return sum;
}

double StageGoal::minus_log_prior(std::span<const double> point) const {
    double sum = 0;
    for (std::size_t k = 0; k < point.size(); ++k)
        if (priors_[k].kind != stats::PriorKind::fixed)
            sum -= priors_[k].log_density(point[k]);
    return sum;
}

std::vector<double> StageGoal::evaluate(const Matrix& points,
                                        std::vector<std::string>& failures) const {
    std::vector<std::vector<kernel::PointAnswer>> answers;
    answers.reserve(models_.size());
    for (std::size_t p = 0; p < models_.size(); ++p)
        answers.push_back(models_[p]->evaluate(points, asked_[p]));
    std::vector<double> values(points.rows, nan);
    failures.assign(points.rows, {});
    for (std::size_t r = 0; r < points.rows; ++r) {
        std::vector<const kernel::PointAnswer*> of_point;
        of_point.reserve(answers.size());
        for (const auto& period : answers) {
            if (failures[r].empty()) failures[r] = period[r].failure;
            of_point.push_back(&period[r]);
        }
        if (failures[r].empty())
            values[r] = objective_of(of_point) + minus_log_prior(points.row(r));
    }
    return values;
}

}  // namespace bemcal::calibration
