/// Reads [[scenario]], what a retrofit changes of a building, and the [[study]] of kind
/// "retrofit": whose points it takes, occupied hours, limits of comfort.
/// Follows from targets as of parameters; insulation is thickness over conductivity.
/// Numbers set by links or layers are refused. Ranges are checked as described here, and
/// for each point in `scenario`. Costs are left out.
#include "job/readers.hpp"
#include "physics/derived.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using retrofit::ChangeBy;
using retrofit::Scenario;
using retrofit::ScenarioChange;

/// How a change says what becomes of the number.
struct Way {
    const char* key;
    ChangeBy by;
};
constexpr Way ways[] = {{"value", ChangeBy::value},
                        {"factor", ChangeBy::factor},
                        {"offset", ChangeBy::offset},
                        {"insulation", ChangeBy::resistance}};

const Way& way_of(const schema::Section& section) {
    const Way* found = nullptr;
    for (const Way& way : ways) {
        if (!section.has(way.key)) continue;
        if (found != nullptr)
            section.fail(way.key, fmt::format("stands beside {}; expected one of value, "
                                              "factor, offset and insulation",
                                              found->key));
        found = &way;
    }
    if (found == nullptr)
        section.fail("target",
                     "has no change; expected value, factor, offset or insulation");
    return *found;
}

ScenarioChange read_change(const schema::Section& section, const study::Case& building) {
    ScenarioChange change;
    for (const std::string& path : section.texts("target"))
        for (const physics::Target& target : at_key(section, "target", [&] {
                 return physics::resolve(building.building, path);
             }))
            change.targets.push_back(target);
    for (const physics::Target& target : change.targets)
        if (physics::is_derived(building.building, target))
            section.fail("target",
                         fmt::format("{} follows from others, by a [[link]] or from "
                                     "layers; expected one of those in its place",
                                     field_of(target).key));
    const Way& way = way_of(section);
    change.by = way.by;
    change.amount = section.number(way.key);
    if (change.by == ChangeBy::resistance) {
        change.amount /= section.number("conductivity");
        for (const physics::Target& target : change.targets)
            if (std::string_view(field_of(target).key) != "u_value")
                section.fail("insulation", fmt::format("is added to a u_value, not to {}",
                                                       field_of(target).key));
    }
    for (const physics::Target& target : change.targets) {
        const physics::Field& field = field_of(target);
        const double number =
            retrofit::changed(physics::number_at(building.building, target), change);
        if (number < field.least || number > field.most)
            section.fail_value(
                way.key,
                fmt::format("makes {} = {:g}: expected {:g} to {:g} {} ({})", field.key,
                            number, field.least, field.most, field.unit, field.sentence));
    }
    return change;
}

Scenario read_scenario(const schema::Section& section, const study::Case& building) {
    Scenario scenario;
    scenario.name = section.text("name");
    for (const schema::Section& each : section.tables("change", "scenario.change"))
        scenario.changes.push_back(read_change(each, building));
    if (section.has("heating_carrier"))
        scenario.heating_carrier = section.choice_as<physics::Carrier>("heating_carrier");
    return scenario;
}

std::vector<Scenario> read_scenarios(const schema::Section& root,
                                     const study::Case& building) {
    std::vector<Scenario> scenarios;
    for (const schema::Section& section : root.tables("scenario", "scenario")) {
        scenarios.push_back(read_scenario(section, building));
        const auto same =
            std::ranges::count(scenarios, scenarios.back().name, &Scenario::name);
        if (same > 1) section.fail_value("name", "another scenario has this name");
    }
    if (scenarios.empty())
        root.fail("scenario",
                  "is missing; expected sections [[scenario]], which a study "
                  "of kind \"retrofit\" applies");
    return scenarios;
}

/// Whether a study of the kind finds points of a building's parameters.
bool finds_points(StudyKind kind) {
    return kind == StudyKind::posterior || kind == StudyKind::screening ||
           kind == StudyKind::grid;
}

/// The stage whose points are taken: of an earlier study.
std::string stage_of(const schema::Section& section, const Job& job, std::size_t number,
                     const study::Case& building) {
    const std::string of = section.text("of");
    for (std::size_t k = 0; k < number; ++k) {
        const StudySpec& study = job.studies[k];
        if (study.name != of) continue;
        if (!finds_points(study.kind))
            section.fail_value("of", "is no posterior, screening or grid");
        const bool is_pooled = study.kind == StudyKind::posterior &&
                               study.posterior.pooling != posterior::Pooling::none;
        return is_pooled ? of : building.name + "/" + of;
    }
    section.fail_value("of",
                       "no study above has this name; expected that of a "
                       "posterior, screening or grid");
}

/// The row of a schedule or series among the case's profiles.
int profile_of(const schema::Section& section, const study::Case& building) {
    if (!section.has("occupied")) return -1;
    const std::string name = section.text("occupied");
    std::vector<std::string> names;
    names.reserve(building.profiles.size());
    for (const physics::Profile& profile : building.profiles)
        names.push_back(profile.name);
    check_word(section, "occupied", name, names, "schedule");
    return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

}  // namespace

void read_retrofit(const schema::Section& root, const schema::Section& section,
                   std::size_t number, Job& job) {
    for (const study::Case& building : job.buildings) {
        retrofit::RetrofitOptions options;
        options.scenarios = read_scenarios(root, building);
        options.of = stage_of(section, job, number, building);
        section.number_if("n_predictive", options.n_points);
        options.occupied_profile = profile_of(section, building);
        options.too_cold = section.number("too_cold");
        options.too_warm = section.number("too_warm");
        job.studies[number].retrofits.push_back(std::move(options));
    }
}

}  // namespace bemcal::job
