/// Computes how far a point is from single numbers: the distance of errors in per cent,
/// as a grid measures it; for NSGA-II the error of each, signed or not.
/// Source: paper 3's plane of errors, and its comparison with NSGA-II.
/// Readings by time are in `meter_goal`. Where a point is slow, the best is not run
/// again.
#include "calibration/target_goal.hpp"

#include "base/nan.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

std::size_t column_of(const std::vector<study::Output>& outputs,
                      const std::string& name) {
    const auto found = std::ranges::find(outputs, name, &study::Output::name);
    if (found == outputs.end())
        throw std::invalid_argument(
            fmt::format("the simulator has no output \"{}\"", name));
    return static_cast<std::size_t>(found - outputs.begin());
}

/// Places of the named parameters, of all where none is named.
std::vector<std::size_t> places_of(const std::vector<physics::Parameter>& all,
                                   const std::vector<std::string>& names) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (names.empty() || std::ranges::count(names, all[k].name) > 0)
            places.push_back(k);
    if (places.empty() || (!names.empty() && places.size() != names.size()))
        throw std::invalid_argument("each parameter must be there and be named once");
    return places;
}

}  // namespace

TargetGoal::TargetGoal(const TargetAim& aim, const OptimisationOptions& options)
    : aim_(aim),
      options_(options),
      varied_(places_of(aim.simulator->parameters(), options.parameters)) {
    if (aim.targets.empty()) throw std::invalid_argument("there are no targets");
    if (options.method == OptimisationMethod::nsga2 &&
        options.errors == MeterError::cv_rmse)
        throw std::invalid_argument(
            "errors = \"cv_rmse\" is of readings, and a target is one number; expected "
            "absolute or signed");
    for (const GridTarget& target : aim.targets) {
        columns_.push_back(column_of(aim.simulator->outputs(), target.output));
        if (!std::isfinite(target.measured) || target.measured == 0)
            throw std::invalid_argument(fmt::format(
                "the target {} is {}: errors are in per cent of it; expected a number "
                "other than 0",
                target.output, target.measured));
    }
    for (const std::size_t k : varied_)
        parameters_.push_back(aim.simulator->parameters()[k]);
}

std::vector<optimise::Variable> TargetGoal::variables() const {
    std::vector<optimise::Variable> variables;
    variables.reserve(varied_.size());
    for (const std::size_t k : varied_) {
        const physics::Parameter& parameter = aim_.simulator->parameters()[k];
        optimise::Variable variable{
            parameter.least, parameter.most, {}, parameter.nominal};
        if (k < aim_.values.size()) variable.values = aim_.values[k];
        variables.push_back(std::move(variable));
    }
    return variables;
}

std::vector<std::string> TargetGoal::objectives() const {
    if (options_.method != OptimisationMethod::nsga2) return {"distance"};
    std::vector<std::string> names;
    names.reserve(aim_.targets.size());
    for (const GridTarget& target : aim_.targets) names.push_back(target.output);
    return names;
}

std::vector<std::string> TargetGoal::units() const {
    return std::vector<std::string>(objectives().size(), "%");
}

Matrix TargetGoal::whole(const Matrix& points) const {
    Matrix all = study::nominal_points(aim_.simulator->parameters(), points.rows);
    for (std::size_t r = 0; r < points.rows; ++r)
        for (std::size_t k = 0; k < varied_.size(); ++k)
            all(r, varied_[k]) = points(r, k);
    return all;
}

std::vector<double> TargetGoal::errors_of(std::span<const double> answer) const {
    std::vector<double> errors;
    errors.reserve(columns_.size());
    for (std::size_t t = 0; t < columns_.size(); ++t) {
        const double measured = aim_.targets[t].measured;
        errors.push_back(100 * (answer[columns_[t]] - measured) / std::abs(measured));
    }
    return errors;
}

/// The distance, with the scales where the job gives them; or of each target its error,
/// without its sign, or with it: then a point below any of them is not admitted.
std::vector<double> TargetGoal::objectives_of(const std::vector<double>& errors) const {
    if (options_.method == OptimisationMethod::nsga2) {
        std::vector<double> objectives = errors;
        const bool is_signed = options_.errors == MeterError::signed_;
        if (is_signed && std::ranges::min(errors) < 0) std::ranges::fill(objectives, nan);
        for (double& error : objectives) error = std::abs(error);
        return objectives;
    }
    double square = 0;
    for (std::size_t t = 0; t < errors.size(); ++t) {
        const double scale = aim_.targets[t].scale > 0 ? aim_.targets[t].scale : 1;
        square += errors[t] * errors[t] / (scale * scale);
    }
    return {std::sqrt(square)};
}

Matrix TargetGoal::whole(std::span<const double> point) const {
    Matrix row(1, point.size());
    std::ranges::copy(point, row.values.begin());
    return whole(row);
}

Matrix TargetGoal::evaluate(const Matrix& points,
                            std::vector<std::string>& failures) const {
    Matrix answers, values(points.rows, objectives().size(), nan);
    aim_.simulator->evaluate(whole(points), answers, failures);
    for (std::size_t r = 0; r < points.rows; ++r)
        if (failures[r].empty())
            std::ranges::copy(objectives_of(errors_of(answers.row(r))),
                              values.row(r).begin());
    return values;
}

void TargetGoal::describe(std::span<const double> best,
                          study::DatasetBuilder& datasets) const {
    std::vector<std::string> names, units;
    std::vector<double> measured;
    for (std::size_t t = 0; t < columns_.size(); ++t) {
        names.push_back(aim_.targets[t].output);
        units.push_back(aim_.simulator->outputs()[columns_[t]].unit);
        measured.push_back(aim_.targets[t].measured);
    }
    datasets.texts("target", "target", std::move(names));
    datasets.texts("target_unit", "target", std::move(units));
    datasets.vector("target_measured", "target", std::move(measured));
    datasets.vector("nearest_parameters", "parameter", {best.begin(), best.end()});
    if (aim_.simulator->is_slow()) return;
    Matrix answer;
    std::vector<std::string> failures;
    aim_.simulator->evaluate(whole(best), answer, failures);
    datasets.vector("nearest_target_error", "target", errors_of(answer.row(0)));
}

}  // namespace bemcal::calibration
