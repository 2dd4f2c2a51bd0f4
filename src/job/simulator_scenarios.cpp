/// Reads the scenarios of another program, and follows the ranges of its parameters
/// through their changes: what no point can reach is a mistake of the job.
/// Follows from targets by name; an effect is struck (value = 0) or scaled (factor).
/// Which effects there are only the loop shows, and whether a point leaves the limits
/// only the point.
#include "job/simulator_scenarios.hpp"

#include "description/read_simulator.hpp"
#include "description/words.hpp"
#include "job/scenarios.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {
namespace {

using retrofit::ChangeBy;
using retrofit::Limits;
using retrofit::SimulatorChange;
using retrofit::SimulatorScenario;

constexpr std::string_view effect_prefix = "effect.";
constexpr const char* unit_of_u_value = "W/(m2 K)";

/// Changes of one scenario, with what is left of the parameters' ranges.
class ChangeReader {
  public:
    ChangeReader(const std::vector<physics::Parameter>& parameters,
                 const std::vector<Limits>& limits, bool has_effects)
        : parameters_(parameters), limits_(limits), has_effects_(has_effects) {
        for (const physics::Parameter& parameter : parameters)
            reach_.push_back({std::min(parameter.least, parameter.nominal),
                              std::max(parameter.most, parameter.nominal)});
    }

    void read(const schema::Section& section, std::vector<SimulatorChange>& to) {
        const Way way = read_way(section);
        for (const std::string& target : section.texts("target"))
            to.push_back(target.starts_with(effect_prefix)
                             ? of_effect(section, way, target)
                             : of_parameter(section, way, target));
    }

  private:
    SimulatorChange of_effect(const schema::Section& section, const Way& way,
                              const std::string& target) const {
        if (!has_effects_)
            section.fail("target", fmt::format("\"{}\" is of a loop, and the study that "
                                               "`of` names is none; expected the name of "
                                               "a [[simulator.parameter]]",
                                               target));
        const bool strikes = way.by == ChangeBy::value && way.amount == 0;
        if (!strikes && way.by != ChangeBy::factor)
            section.fail_value(way.key,
                               "an effect that was found is struck or scaled; "
                               "expected value = 0, or factor");
        return {0, target.substr(effect_prefix.size()), way.by, way.amount};
    }

    SimulatorChange of_parameter(const schema::Section& section, const Way& way,
                                 const std::string& target) {
        const std::vector<std::string> names = description::names_of(parameters_);
        description::check_word(section, "target", target, names,
                                "[[simulator.parameter]]");
        const auto k =
            static_cast<std::size_t>(std::ranges::find(names, target) - names.begin());
        const std::string& unit = parameters_[k].unit;
        if (way.by == ChangeBy::resistance && unit != unit_of_u_value)
            section.fail(
                "insulation",
                fmt::format("is added to a U-value, and {} has the unit \"{}\"; expected "
                            "unit = \"{}\" of that [[simulator.parameter]], or "
                            "factor",
                            target, unit, unit_of_u_value));
        follow(section, way, k);
        return {k, {}, way.by, way.amount};
    }

    /// The ends of what the parameter may be, through the change.
    void follow(const schema::Section& section, const Way& way, std::size_t k) {
        Limits& reach = reach_[k];
        const double one = retrofit::changed(reach.least, way.by, way.amount),
                     other = retrofit::changed(reach.most, way.by, way.amount);
        reach = {std::min(one, other), std::max(one, other)};
        const Limits& limits = limits_[k];
        if (reach.least <= limits.most && reach.most >= limits.least) return;
        const std::string made =
            reach.least == reach.most
                ? fmt::format("{:g}", reach.least)
                : fmt::format("{:g} to {:g}", reach.least, reach.most);
        section.fail_value(way.key,
                           fmt::format("makes {} = {}: expected {}, or `limits` of that "
                                       "[[simulator.parameter]] around it",
                                       parameters_[k].name, made,
                                       retrofit::words_of(limits, parameters_[k])));
    }

    const std::vector<physics::Parameter>& parameters_;
    const std::vector<Limits>& limits_;
    bool has_effects_;
    std::vector<Limits> reach_;  ///< [parameters]
};

}  // namespace

std::vector<Limits> limits_of_scenarios(
    const schema::Section& root, const std::vector<physics::Parameter>& parameters) {
    const auto sections =
        root.table("simulator", "simulator").tables("parameter", "simulator.parameter");
    std::vector<Limits> limits;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const auto [least, most] =
            description::read_scenario_limits(sections[k], parameters[k]);
        limits.push_back({least, most});
    }
    return limits;
}

std::vector<SimulatorScenario> read_simulator_scenarios(
    const schema::Section& root, const std::vector<physics::Parameter>& parameters,
    const std::vector<Limits>& limits, bool has_effects) {
    std::vector<SimulatorScenario> scenarios;
    each_scenario(root, [&](const schema::Section& section) {
        SimulatorScenario scenario{section.text("name"), {}};
        ChangeReader reader(parameters, limits, has_effects);
        for (const schema::Section& each : section.tables("change", "scenario.change"))
            reader.read(each, scenario.changes);
        section.refuse({"heating_carrier"},
                       "is of a building's plant; expected changes of a "
                       "[[simulator.parameter]], as the program's model has its own");
        scenarios.push_back(std::move(scenario));
    });
    return scenarios;
}

}  // namespace bemcal::job
