/// Lets a posterior sample the shape of effects: each column of a function's basis, and
/// each day on which a step may begin, enters as an effect of its own behind the others,
/// with a parameter for its coefficient.
/// Source: hierarchical normal coefficients (Gelman et al., Bayesian Data Analysis). Left
/// out: a function's mean over training, which its effect's coefficient or another
/// parameter has.
#include "study/sampled_shapes.hpp"

#include "effects/loads.hpp"
#include "effects/steps.hpp"
#include "functions/basis.hpp"
#include "physics/derived.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

using effects::DeclaredEffects;
using effects::Effect;

/// Of the logarithm of a size. Judgement: half to double.
constexpr double sd_log_size = 0.7;
/// Of the range that is said of a size, in spreads; its prior has none.
constexpr double reach_of_size = 4;
/// Of a value from that given, in spreads: its largest standard deviation beforehand.
/// Where training hardly comes, a function of mean square 1 could do anything.
constexpr double most_deviation = 2;

std::vector<double> column_of(const Matrix& of, std::size_t c) {
    std::vector<double> values(of.rows);
    for (std::size_t r = 0; r < of.rows; ++r) values[r] = of(r, c);
    return values;
}

/// Columns with which no point strays further.
Matrix held_in(Matrix columns) {
    double most = 0;
    for (std::size_t p = 0; p < columns.rows; ++p) {
        double variance = 0;
        for (const double value : columns.row(p)) variance += value * value;
        most = std::max(most, std::sqrt(variance));
    }
    for (double& value : columns.values)
        value *= std::min(1.0, most_deviation / std::max(most, most_deviation));
    return columns;
}

/// What is put behind the declared effects, and what samples it.
struct Shapes {
    struct Function {
        std::size_t parent, first;  ///< effects: its own, that of its first column
        double spread;
    };
    struct Day {
        std::size_t parent, first;  ///< effects: the step's, that of its first day
        int within;
    };
    DeclaredEffects declared;
    std::vector<Function> functions{};
    std::vector<Day> days{};

    void add(Effect effect) {
        declared.effects.push_back(std::move(effect));
        declared.coefficients.push_back(0);
    }
};

void add_columns(const SampledFunction& function, const Effect& parent, Shapes& shapes) {
    for (std::size_t c = 0; c < function.columns.cols; ++c) {
        Effect part = parent;
        part.name = part.column = fmt::format("{} {}", function.name, c + 1);
        shapes.declared.functions.push_back(
            {parent.hook,
             part.column,
             {{function.driver, function.points, column_of(function.columns, c)}},
             true});
        shapes.add(std::move(part));
    }
}

/// Functions of an effect that have a spread.
void add_functions(std::size_t parent, const DeclaredEffects::Functions& at,
                   const effects::FunctionDrivers& drivers, Shapes& shapes,
                   std::vector<SampledFunction>& functions) {
    const Effect effect = shapes.declared.effects[parent];
    for (const effects::DriverFunction& one : at.functions) {
        if (!one.is_sampled()) continue;
        functions.push_back(
            {fmt::format("{} by {}", effect.name, one.driver),
             effects::name_of(effect.hook), one.driver, effects::unit_of(effect.hook),
             one.points, one.values,
             held_in(functions::basis_at(one.driver, one.points, drivers.at(one.driver))
                         .at_points)});
        shapes.functions.push_back({parent, shapes.declared.effects.size(), one.spread});
        add_columns(functions.back(), effect, shapes);
    }
}

/// The step itself begins after the last day on which it may.
void add_days(const DeclaredEffects::Day& day, Shapes& shapes) {
    constexpr double day_in_years = physics::day_s / effects::elapsed_year_s;
    const Effect step = shapes.declared.effects[day.effect];
    shapes.declared.effects[day.effect].shape.at += day.within * day_in_years;
    shapes.days.push_back({day.effect, shapes.declared.effects.size(), day.within});
    for (int d = -day.within; d < day.within; ++d) {
        Effect part = step;
        part.name = fmt::format("{}: day {}", step.name, d);
        part.shape.form = effects::Form::within;
        part.shape.at = step.shape.at + d * day_in_years;
        part.shape.until = step.shape.at + (d + 1) * day_in_years;
        shapes.add(std::move(part));
    }
}

/// Series of the steps behind the warm-up.
effects::FunctionDrivers drivers_in(const Case& building, const physics::Drive& drive) {
    const DeclaredEffects& declared = *building.declared_effects;
    const auto loads = declared.follow_loads()
                           ? effects::loads_of(building.building, drive)
                           : effects::no_loads(drive);
    effects::FunctionDrivers drivers = effects::function_drivers(
        effects::surroundings_of(declared, loads, drive, building.weather));
    for (auto& [name, all] : drivers)
        for (std::vector<double>& series : all)
            series.erase(series.begin(), series.begin() + drive.n_warm_up);
    return drivers;
}

Shapes shapes_of(const Case& building, const physics::Drive& drive,
                 std::vector<SampledFunction>& functions) {
    const DeclaredEffects& declared = *building.declared_effects;
    Shapes shapes{declared};
    const effects::FunctionDrivers drivers = drivers_in(building, drive);
    for (std::size_t k = 0; k < declared.effects.size(); ++k)
        for (const DeclaredEffects::Functions& at : declared.functions)
            if (at.column == declared.effects[k].column)
                add_functions(k, at, drivers, shapes, functions);
    for (const DeclaredEffects::Day& day : declared.days) add_days(day, shapes);
    return shapes;
}

/// Numbers that parameters have moved since the description was read stay.
void keep_numbers(const std::vector<physics::Parameter>& parameters,
                  const physics::Building& before, physics::Building& building) {
    for (const physics::Parameter& parameter : parameters)
        for (const physics::Target& target : parameter.targets)
            physics::number_at(building, target) = physics::number_at(before, target);
    physics::derive(building);
}

/// \return its index
std::size_t add_parameter(physics::Parameter parameter, ParameterPrior prior,
                          Case& building) {
    building.parameters.push_back(std::move(parameter));
    building.priors.push_back(std::move(prior));
    return building.parameters.size() - 1;
}

physics::Parameter led_to(const physics::Coefficient& effect, double nominal) {
    return {
        effect.name,    effect.unit, effect.least, effect.most, physics::Effect::replace,
        effect.targets, nominal};
}

/// The parameter that leads to the coefficient of an effect; their number where none
/// does.
std::size_t leading_to(const physics::Coefficient& effect, const Case& building) {
    const auto leads = [&](const physics::Parameter& parameter) {
        return std::ranges::any_of(parameter.targets, [&](const physics::Target& target) {
            return physics::is_same_number(target, effect.targets.at(0));
        });
    };
    const auto found = std::ranges::find_if(building.parameters, leads);
    return static_cast<std::size_t>(found - building.parameters.begin());
}

void sample(const SampledFunction& function, const Shapes::Function& shape,
            Case& building) {
    const physics::Coefficient& parent = building.building.effects.at(shape.parent);
    if (const std::size_t k = leading_to(parent, building);
        k < building.parameters.size())
        throw std::invalid_argument(fmt::format(
            "{} varies the coefficient of {}, whose values are sampled already, by their "
            "spread; expected one of the two",
            building.parameters[k].name, parent.name));
    const std::size_t size =
        add_parameter({function.size_name(),
                       function.unit,
                       0,
                       reach_of_size * shape.spread,
                       physics::Effect::replace,
                       {},
                       shape.spread},
                      {stats::lognormal_prior(shape.spread, sd_log_size), {}}, building);
    for (std::size_t c = 0; c < function.columns.cols; ++c) {
        physics::Coefficient& column = building.building.effects.at(shape.first + c);
        column.part_of = shape.parent;
        add_parameter(led_to(column, 0), {stats::normal_prior(0, 1), {}, size}, building);
    }
}

/// The parameter that has the coefficient of a step; one that is fixed where none has.
std::size_t parameter_of(const physics::Coefficient& effect, Case& building) {
    if (const std::size_t k = leading_to(effect, building);
        k < building.parameters.size()) {
        const physics::Parameter& parameter = building.parameters[k];
        if (parameter.effect != physics::Effect::replace)
            throw std::invalid_argument(fmt::format(
                "{} varies the coefficient of {} by a factor or an offset, and the day of "
                "that effect is sampled; expected a parameter that is the coefficient",
                parameter.name, effect.name));
        return k;
    }
    const double value = physics::number_at(building.building, effect.targets.at(0)) /
                         effect.targets[0].weight;
    return add_parameter(led_to(effect, value), {stats::fixed_prior(value), {}},
                         building);
}

void sample(const Shapes::Day& day, Case& building) {
    const physics::Coefficient parent = building.building.effects.at(day.parent);
    const std::size_t size = parameter_of(parent, building);
    const double coefficient = building.parameters[size].nominal;
    const double reach = day.within;
    const std::size_t moment = add_parameter(
        {parent.name + ": day", "d", -reach, reach, physics::Effect::replace, {}, 0},
        {stats::uniform_prior(-reach, reach), {}}, building);
    for (int d = -day.within; d < day.within; ++d) {
        const StepShare step{size, moment, static_cast<double>(d)};
        auto& part = building.building.effects.at(
            day.first + static_cast<std::size_t>(d + day.within));
        part.part_of = day.parent;
        add_parameter(led_to(part, coefficient * step.share(0)),
                      {stats::fixed_prior(0), {}, std::nullopt, step}, building);
    }
}

void set_to_nominal(Case& building) {
    const physics::Building before = building.building;
    physics::apply(before, building.parameters, nominal_point(building.parameters),
                   building.building);
}

}  // namespace

bool has_sampled_shapes(const Case& building) {
    if (!building.declared_effects) return false;
    const DeclaredEffects& declared = *building.declared_effects;
    return !declared.days.empty() ||
           std::ranges::any_of(declared.functions,
                               &DeclaredEffects::Functions::are_sampled);
}

Case with_sampled_shapes(Case building, const Period& period,
                         std::vector<SampledFunction>& functions) {
    functions.clear();
    if (!has_sampled_shapes(building)) return building;
    const physics::Drive drive = drive_of(building, period);
    Shapes shapes = shapes_of(building, drive, functions);
    const physics::Building before = building.building;
    DeclaredEffects& declared = shapes.declared;
    building.building =
        effects::building_with(declared, drive, building.weather, declared.n_rows);
    keep_numbers(building.parameters, before, building.building);
    building.profiles.resize(declared.first_row + declared.n_rows,
                             effects::empty_row(building.weather));
    building.declared_effects =
        std::make_shared<const DeclaredEffects>(std::move(declared));
    building.priors = priors_of(building);
    for (std::size_t k = 0; k < functions.size(); ++k)
        sample(functions[k], shapes.functions[k], building);
    for (const Shapes::Day& day : shapes.days) sample(day, building);
    set_to_nominal(building);
    return building;
}

}  // namespace bemcal::study
