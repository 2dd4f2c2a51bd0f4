/// Computes what an optimisation minimises of meters over a period: a weighted sum of
/// paper 2's error, RMSD or minus log likelihood; for NSGA-II the error of each meter.
/// Source: paper 2, eq. 1-4, with CV(RMSD) in per cent as printed, or as a fraction.
/// Errors count as independent. Single numbers are in `target_goal`, several periods in
/// `staged_goal`.
#include "calibration/meter_goal.hpp"

#include "base/nan.hpp"
#include "calibration/candidates.hpp"
#include "study/bias.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bemcal::calibration {
namespace {

bool is_in(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// The case with the named parameters only; the others stay nominal.
study::Case with_parameters(const study::Case& building,
                            const std::vector<std::string>& names) {
    if (names.empty()) return building;
    study::Case chosen = building;
    chosen.parameters.clear();
    chosen.priors.clear();
    for (std::size_t k = 0; k < building.parameters.size(); ++k) {
        if (!is_in(names, building.parameters[k].name)) continue;
        chosen.parameters.push_back(building.parameters[k]);
        if (!building.priors.empty()) chosen.priors.push_back(building.priors[k]);
    }
    if (chosen.parameters.size() != names.size())
        throw std::invalid_argument(building.name +
                                    " does not have each of the parameters named once");
    return chosen;
}

std::size_t period_index(const study::Case& building, const std::string& name) {
    const study::Period* period = &study::period_of(building, name);
    return static_cast<std::size_t>(period - building.periods.data());
}

/// Meters that are chosen, by their index in the case.
std::vector<std::size_t> chosen_meters(const study::Case& building,
                                       const std::vector<std::string>& names,
                                       const std::vector<kernel::Readings>& readings) {
    std::vector<std::size_t> chosen = meters_named(building, names);
    for (const std::size_t m : chosen)
        if (!study::has_reading(readings[m].values))
            throw std::invalid_argument("the meter " + building.meters[m].name +
                                        " has no reading in the period");
    for (std::size_t m = 0; names.empty() && m < building.meters.size(); ++m)
        if (study::has_reading(readings[m].values)) chosen.push_back(m);
    if (chosen.empty())
        throw std::invalid_argument(building.name + " has no meter to be fitted");
    return chosen;
}

double minus_log_likelihood(const stats::FitMetrics& metrics) {
    const double variance = std::max(metrics.rmse * metrics.rmse, 1e-24);
    return 0.5 * metrics.n * (std::log(2 * std::numbers::pi * variance) + 1);
}

}  // namespace

std::vector<std::size_t> meters_named(const study::Case& building,
                                      const std::vector<std::string>& names) {
    std::vector<std::size_t> found;
    found.reserve(names.size());
    for (const std::string& name : names) {
        const auto meter = std::ranges::find(building.meters, name, &study::Meter::name);
        if (meter == building.meters.end())
            throw std::invalid_argument(building.name + " has no meter \"" + name + "\"");
        const auto m = static_cast<std::size_t>(meter - building.meters.begin());
        if (std::ranges::find(found, m) != found.end())
            throw std::invalid_argument("the meter \"" + name + "\" is named twice");
        found.push_back(m);
    }
    return found;
}

double weighted_error(const stats::FitMetrics& metrics,
                      const OptimisationOptions& options) {
    const double scale = options.objective == Objective::percent ? 100 : 1;
    const double unexplained =
        metrics.n < 3 ? 0 : (std::isnan(metrics.r2) ? 1 : 1 - metrics.r2);
    return options.cv_weight * scale * stats::relative_error(metrics) +
           options.r2_weight * unexplained;
}

double objective_term(const stats::FitMetrics& metrics,
                      const OptimisationOptions& options) {
    if (options.objective == Objective::rmsd) return metrics.rmse;
    return options.objective == Objective::likelihood ? minus_log_likelihood(metrics)
                                                      : weighted_error(metrics, options);
}

MeterGoal::MeterGoal(const study::Case& building, const OptimisationOptions& options)
    : options_(options),
      building_(with_parameters(building, options.parameters)),
      period_(period_index(building_, options.period)) {
    models_.reserve(building_.periods.size());
    for (const study::Period& period : building_.periods)
        models_.push_back(own_period_model(building_, period));
    const auto& readings = models_.at(period_)->readings();
    meters_ = chosen_meters(building_, options.meters, readings);
    asked_ = models_[period_]->some(meters_);
    if (!options.meter_weights.empty() && options.meter_weights.size() != meters_.size())
        throw std::invalid_argument("expected a weight for each of the meters");
}

std::vector<optimise::Variable> MeterGoal::variables() const {
    std::vector<optimise::Variable> variables;
    variables.reserve(parameters().size());
    for (std::size_t k = 0; k < parameters().size(); ++k) {
        const physics::Parameter& parameter = parameters()[k];
        optimise::Variable variable{
            parameter.least, parameter.most, {}, parameter.nominal};
        if (k < building_.priors.size()) variable.values = building_.priors[k].values;
        variables.push_back(std::move(variable));
    }
    return variables;
}

std::vector<std::string> MeterGoal::objectives() const {
    if (options_.method != OptimisationMethod::nsga2) return {"f"};
    std::vector<std::string> names;
    names.reserve(meters_.size());
    for (const std::size_t m : meters_) names.push_back(building_.meters[m].name);
    return names;
}

std::vector<std::string> MeterGoal::units() const {
    const bool is_share = options_.method == OptimisationMethod::nsga2;
    return std::vector<std::string>(objectives().size(), is_share ? "%" : "1");
}

double MeterGoal::error_of(const stats::FitMetrics& metrics) const {
    if (options_.errors == MeterError::cv_rmse)
        return 100 * stats::relative_error(metrics);
    if (options_.errors == MeterError::absolute) return 100 * std::abs(metrics.nmbe);
    return metrics.nmbe >= 0 ? 100 * metrics.nmbe : nan;
}

std::vector<double> MeterGoal::objectives_of(const kernel::PointAnswer& answer) const {
    std::vector<double> errors;
    double sum = 0;
    for (std::size_t m = 0; m < meters_.size(); ++m) {
        const study::MeterFit fit = study::fit_of(
            asked_.request.readings[m], answer.errors[m], answer.monthly_errors[m]);
        const bool is_monthly = options_.resolution == ObjectiveResolution::monthly;
        const stats::FitMetrics& metrics = is_monthly ? fit.monthly : fit.own;
        errors.push_back(error_of(metrics));
        const double weight =
            options_.meter_weights.empty() ? 1 : options_.meter_weights[m];
        sum += weight * objective_term(metrics, options_);
    }
    return options_.method == OptimisationMethod::nsga2 ? errors
                                                        : std::vector<double>{sum};
}

Matrix MeterGoal::evaluate(const Matrix& points,
                           std::vector<std::string>& failures) const {
    const auto answers = models_[period_]->evaluate(points, asked_);
    Matrix values(points.rows, objectives().size(), nan);
    failures.assign(points.rows, {});
    for (std::size_t r = 0; r < answers.size(); ++r) {
        failures[r] = answers[r].failure;
        if (failures[r].empty())
            std::ranges::copy(objectives_of(answers[r]), values.row(r).begin());
    }
    return values;
}

std::string MeterGoal::shortfall_of(std::span<const double> best) const {
    return study::bias_beyond(building_, period_,
                              models_[period_]->fits_at(best, period_, meters_));
}

void MeterGoal::describe(std::span<const double> best,
                         study::DatasetBuilder& datasets) const {
    Matrix points = study::nominal_row(parameters());
    points.values.insert(points.values.end(), best.begin(), best.end());
    points.rows = 2;
    add_candidate_names(building_, datasets);
    add_candidates({building_, models_, options_.hourly_outputs}, points, datasets);
}

}  // namespace bemcal::calibration
