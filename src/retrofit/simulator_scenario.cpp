/// Applies a retrofit's changes to what another program is run with.
/// Follows from `changed`, as of our own numbers; effects are scaled as the loop does.
/// Whether the program's model holds with such numbers, only a run shows.
#include "retrofit/simulator_scenario.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::retrofit {
namespace {

bool has_effect(const std::vector<study::GivenEffect>& effects, const std::string& name) {
    return std::ranges::find(effects, name, &study::GivenEffect::name) != effects.end();
}

std::string no_effect(const std::string& name,
                      const std::vector<study::GivenEffect>& effects) {
    std::vector<std::string> found;
    found.reserve(effects.size());
    for (const study::GivenEffect& effect : effects)
        found.push_back("effect." + effect.name);
    if (found.empty())
        return fmt::format("effect.{} was not found, nor any other effect", name);
    return fmt::format("effect.{} was not found; expected {}", name,
                       fmt::join(found, " or "));
}

/// The effects of that name times a factor.
void scale(const std::string& name, double by, std::vector<study::GivenEffect>& effects) {
    std::vector<double> scales;
    scales.reserve(effects.size());
    for (const study::GivenEffect& effect : effects)
        scales.push_back(effect.name == name ? by : 1);
    effects = study::scaled(effects, scales);
}

}  // namespace

std::string words_of(const Limits& limits, const physics::Parameter& parameter) {
    return fmt::format("{:g} to {:g}{}", limits.least, limits.most,
                       parameter.unit == "-" ? "" : " " + parameter.unit);
}

SimulatorInput after(SimulatorInput input, const SimulatorScenario& scenario) {
    for (const SimulatorChange& change : scenario.changes)
        if (!change.effect.empty()) {
            scale(change.effect, changed(1, change.by, change.amount), input.effects);
        } else {
            double& value = input.values[change.parameter];
            value = changed(value, change.by, change.amount);
        }
    return input;
}

std::string beyond_limits(const SimulatorInput& before, const SimulatorScenario& scenario,
                          const std::vector<physics::Parameter>& parameters,
                          std::span<const Limits> limits) {
    const std::vector<double> values = after(before, scenario).values;
    for (const SimulatorChange& change : scenario.changes) {
        const std::size_t k = change.parameter;
        if (!change.effect.empty() ||
            (values[k] >= limits[k].least && values[k] <= limits[k].most))
            continue;
        return fmt::format("{} would be {:g}; expected {}", parameters[k].name, values[k],
                           words_of(limits[k], parameters[k]));
    }
    return {};
}

std::string missing_effect(const SimulatorScenario& scenario,
                           const std::vector<study::GivenEffect>& found) {
    for (const SimulatorChange& change : scenario.changes)
        if (!change.effect.empty() && !has_effect(found, change.effect))
            return no_effect(change.effect, found);
    return {};
}

}  // namespace bemcal::retrofit
