/// Writes the parts of a model as sections of a job, with the values at which it was
/// calibrated.
/// Follows from effects/job_section, which has the lines. The effects found are not here:
/// each has its own section, with what speaks for it. Functions come first, as in the
/// model: where effects do not add up, each acts on what stands before it.
#include "loop/job_parts.hpp"

#include "effects/job_section.hpp"
#include "effects/placement.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using Parts = std::vector<StoredLoop::JobPart>;

/// The number of an unknown, as it was calibrated.
effects::CoefficientBelief belief_of(const study::FitUnknown& unknown, double x,
                                     double sd) {
    return {unknown.within(x), sd, unknown.least, unknown.most};
}

std::vector<std::string> paths_of(const Place& place,
                                  const physics::Parameter& parameter) {
    std::vector<std::string> paths;
    paths.reserve(parameter.targets.size());
    for (const physics::Target& target : parameter.targets)
        paths.push_back(physics::path_of(place.building, target));
    return paths;
}

std::string_view name_of(const effects::Refinement::Number& number) {
    return number.name;
}
std::string_view name_of(const effects::Refinement::Always& always) {
    return always.effect.name;
}

bool is_of_job(const LoopData& data, const physics::Parameter& parameter) {
    return std::ranges::find(data.building.parameters, parameter.name,
                             &physics::Parameter::name) != data.building.parameters.end();
}

/// What a described structure has of that name: a number, or an effect.
template <class Part>
const Part* found_in(const study::Case& building,
                     std::vector<Part> effects::Refinement::* parts,
                     std::string_view name) {
    for (const std::size_t index : building.structure)
        for (const Part& part : effects::refinements()[index].*parts)
            if (name_of(part) == name) return &part;
    return nullptr;
}

/// Parameters of the place that the job has not in its lists, and the effects of its
/// structure; none that does nothing here, as a job could not say it.
void add_structure(const LoopData& data, const Place& place, const Standing& last,
                   const std::vector<double>& deviations, Parts& parts) {
    const auto belief = [&](std::size_t k) {
        return belief_of(last.built.unknowns[k], last.fit.at.x[k], deviations[k]);
    };
    const auto add_effect = [&](const effects::Effect& effect, std::size_t k) {
        if (!effects::objection(effect, *place.surroundings))
            parts.push_back({"structure", effects::job_section_of(effect, belief(k),
                                                                  data.training().from)});
    };
    const std::size_t n = place.parameters.size();
    for (std::size_t k = 0; k < n; ++k) {
        const physics::Parameter& parameter = place.parameters[k];
        if (const auto* own =
                found_in(data.building, &effects::Refinement::effects, parameter.name))
            add_effect(own->effect, k);
        else if (!is_of_job(data, parameter) ||
                 found_in(data.building, &effects::Refinement::numbers, parameter.name))
            parts.push_back({"structure",
                             effects::parameter_section_of(
                                 parameter.name, paths_of(place, parameter), belief(k))});
    }
    for (std::size_t k = 0; k < place.always.size(); ++k)
        add_effect(place.always[k].effect, n + k);
}

}  // namespace

Parts job_parts_of(const LoopData& data, const Place& place, const Standing& last,
                   const std::vector<double>& deviations,
                   const std::vector<LearnedHours>& hours,
                   const std::vector<FoundFunction>& functions) {
    Parts parts;
    for (const FunctionsAtHook& one : by_hook(functions))
        parts.push_back({"functions", effects::job_section_of(one.at, one.functions)});
    add_structure(data, place, last, deviations, parts);
    for (const LearnedHours& learned : hours)
        parts.push_back(
            {"hours", effects::schedule_section_of(learned.name, learned.hours())});
    std::erase_if(parts, [](const auto& part) { return part.section.empty(); });
    return parts;
}

}  // namespace bemcal::loop
