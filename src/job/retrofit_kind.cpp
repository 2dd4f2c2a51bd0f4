/// The kind "retrofit", and [[scenario]], what it changes of a building: whose points it
/// takes, occupied hours, limits of comfort.
/// Follows from targets as of parameters; insulation is thickness over conductivity.
/// Numbers set by links or layers are refused. Ranges are checked as described here, and
/// for each point in `scenario`. Costs are left out.
/// Of a [simulator] it is the program that runs before and after (`simulator_scenarios`).
#include "description/words.hpp"
#include "job/hourly_outputs.hpp"
#include "job/kind.hpp"
#include "job/kinds.hpp"
#include "job/names.hpp"
#include "job/scenarios.hpp"
#include "job/simulator_scenarios.hpp"
#include "physics/derived.hpp"
#include "retrofit/retrofit.hpp"
#include "retrofit/simulator_retrofit.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using retrofit::ChangeBy;
using retrofit::RetrofitOptions;
using retrofit::Scenario;
using retrofit::ScenarioChange;
using retrofit::SimulatorRetrofitOptions;
using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"retrofit\"", "",
     "What each [[scenario]] would save, over the points that a study above has found."}};

constexpr schema::Key keys[] = {
    {"study", "of", Type::text, "", nullptr, 0, 0,
     "Name of a posterior, screening or grid above, whose draws or best points the "
     "scenarios are applied to; of a [simulator] of a posterior, screening or loop."},
    {"study", "n_predictive", Type::integer, "", "", 1, 1000000,
     "So many of them at most; default: 200, of a [simulator] 20, for each of them it runs "
     "before and after every scenario."},
    {"study", "period", Type::text, "", "", 0, 0, "Default: the first."},
    {"study", "occupied", Type::text, "", "", 0, 0,
     "[[schedule]] by which hours count as too cold or too warm, from 0.5 on; default: "
     "all hours."},
    {"study", "too_cold", Type::number, "degC", "19", -50, 100,
     "An occupied hour below it (by 0.05 K) is too cold."},
    {"study", "too_warm", Type::number, "degC", "26", -50, 100,
     "An occupied hour above it (by 0.05 K) is too warm."},
};

/// Points that are taken by default. A program runs for each before and after every
/// scenario: with one scenario 20 points take half the runs of a posterior (80). Of 20
/// draws the median is sure to 0.3 of their standard deviation.
constexpr int usual_points = 200, usual_points_of_simulator = 20;

ScenarioChange read_change(const schema::Section& section, const study::Case& building) {
    ScenarioChange change;
    for (const std::string& path : section.texts("target"))
        for (const physics::Target& target : description::at_key(section, "target", [&] {
                 return physics::resolve(building.building, path);
             }))
            change.targets.push_back(target);
    for (const physics::Target& target : change.targets)
        if (physics::is_derived(building.building, target))
            section.fail("target",
                         fmt::format("{} follows from others, by a [[link]] or from "
                                     "layers; expected one of those in its place",
                                     field_of(target).key));
    const Way way = read_way(section);
    change.by = way.by;
    change.amount = way.amount;
    if (change.by == ChangeBy::resistance)
        for (const physics::Target& target : change.targets)
            if (std::string_view(field_of(target).key) != "u_value")
                section.fail("insulation", fmt::format("is added to a u_value, not to {}",
                                                       field_of(target).key));
    for (const physics::Target& target : change.targets) {
        const physics::NumberInfo info = physics::info_of(building.building, target);
        const double number = retrofit::changed(
            physics::number_at(building.building, target), change.by, change.amount);
        if (!(number >= info.least && number <= info.most))
            section.fail_value(
                way.key,
                fmt::format("makes {} = {:g}: expected {:g} to {:g} {} ({})", info.name,
                            number, info.least, info.most, info.unit, info.sentence));
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
    each_scenario(root, [&](const schema::Section& section) {
        scenarios.push_back(read_scenario(section, building));
    });
    return scenarios;
}

/// "screening, posterior or grid"
std::string kinds_with_points() {
    return words_of_kinds([](const Kind& kind) { return kind.points_of != nullptr; });
}

/// The study whose points are taken is one above.
void check_names(const NamePlace& place) {
    const schema::Section& section = place.section;
    const auto found =
        std::ranges::find(place.above, section.text("of"), &NamedStudy::name);
    if (found != place.above.end()) {
        if (found->kind != nullptr && found->kind->points_of == nullptr)
            section.fail_value("of", "is no " + kinds_with_points());
        return;
    }
    if (section.is_lost("study") ||
        std::ranges::count(place.above, "", &NamedStudy::name))
        throw schema::Follows();
    section.fail_value(
        "of", "no study above has this name; expected that of a " + kinds_with_points());
}

/// The study whose points are taken.
const StudySpec& study_named(const std::string& name, const Job& job) {
    return *std::ranges::find(job.studies, name, &StudySpec::name);
}

/// The building that its points are of.
study::Case case_of_points(const StudySpec& study, const study::Case& building) {
    return study.kind->case_of == nullptr ? building
                                          : study.kind->case_of(study, building);
}

/// The row of a schedule or series among the case's profiles.
int profile_of(const schema::Section& section, const study::Case& building) {
    if (!section.has("occupied")) return -1;
    const std::string name = section.text("occupied");
    const std::vector<std::string> names = description::names_of(building.profiles);
    description::check_word(section, "occupied", name, names, "schedule");
    return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

void read(const StudySource& source, StudySpec& study) {
    study.period = source.section.text("period");
}

/// All but the stage whose points are taken.
void read_setting(const schema::Section& section, const study::Case& building,
                  retrofit::Setting& setting) {
    section.number_if("n_predictive", setting.n_points);
    setting.occupied_profile = profile_of(section, building);
    setting.too_cold = section.number("too_cold");
    setting.too_warm = section.number("too_warm");
}

RetrofitOptions options_of(const StudyPlace& place, const StudySpec& of,
                           const study::Case& building) {
    const schema::Section& section = place.section;
    RetrofitOptions options;
    options.scenarios = read_scenarios(place.root, building);
    options.of = of.kind->points_of(of, building);
    options.n_points = usual_points;
    read_setting(section, building, options);
    return options;
}

/// The study above whose points are taken, around the program.
const StudySpec& study_around(const StudyPlace& place, const StudySpec& study) {
    const schema::Section& section = place.section;
    const std::string words =
        words_of_kinds([](const Kind& kind) { return kind.points_around != nullptr; });
    const std::string of = section.text("of");
    for (const StudySpec& above : place.job.studies) {
        if (&above == &study) break;
        if (above.name != of) continue;
        if (above.kind->points_around == nullptr)
            section.fail_value("of",
                               fmt::format("has no points of a [simulator] with hours; "
                                           "expected the name of a {}",
                                           words));
        return above;
    }
    section.fail_value("of", "no study above has this name; expected that of a " + words);
}

/// Hours outside the limits are counted where the program gives a room's temperature.
void check_comfort(const schema::Section& section, const study::HourlySimulator& program,
                   const study::Case& building) {
    for (const study::Meter& meter : building.meters)
        if (physics::is_temperature(meter.quantity) &&
            std::ranges::find(program.meters(), meter.name) != program.meters().end())
            return;
    section.refuse({"occupied", "too_cold", "too_warm"},
                   "is of a room's temperature, of which the [simulator] has no hours; "
                   "expected a [[simulator.hourly]] of a meter of air_temperature");
}

/// A loop has one point, with the effects that it found.
void check_simulator(const StudyPlace& place, StudySpec& study) {
    check_hourly_outputs(place, {});
    const StudySpec& of = study_around(place, study);
    const study::Case& building = place.job.buildings[0];
    const study::HourlySimulator& program = *place.job.hourly_simulator;
    check_comfort(place.section, program, building);
    SimulatorRetrofitOptions options;
    options.of = of.kind->points_around(of, building);
    options.n_points = usual_points_of_simulator;
    read_setting(place.section, building, options);
    if (of.kind->finds_effects) options.n_points = 1;
    options.limits = limits_of_scenarios(place.root, program.parameters());
    options.scenarios = read_simulator_scenarios(place.root, program.parameters(),
                                                 options.limits, of.kind->finds_effects);
    study.options = std::move(options);
}

/// Scenarios name numbers of a building, so each building has options of its own.
struct Retrofits {
    std::string of;  ///< name of the study whose points are taken
    std::vector<RetrofitOptions> options;
};

void check(const StudyPlace& place, StudySpec& study) {
    if (place.job.simulator) return check_simulator(place, study);
    Retrofits retrofits{place.section.text("of"), {}};
    const StudySpec& of = study_named(retrofits.of, place.job);
    retrofits.options.reserve(place.job.buildings.size());
    for (const study::Case& building : place.job.buildings)
        retrofits.options.push_back(options_of(place, of, case_of_points(of, building)));
    study.options = std::move(retrofits);
}

Stages stages(const StudySpec& study, const Job& job) {
    if (job.hourly_simulator) {
        const study::Case& building = job.buildings.at(0);
        return only(retrofit::make_simulator_retrofit(
            stage_name(study, building), building, job.hourly_simulator,
            period_of(building, study.period), study.as<SimulatorRetrofitOptions>()));
    }
    const auto& retrofits = study.as<Retrofits>();
    const StudySpec& of = study_named(retrofits.of, job);
    auto options = retrofits.options.begin();
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return retrofit::make_retrofit(std::move(name), case_of_points(of, building),
                                       period_of(building, study.period), *options++);
    });
}

/// Of a program an item is a run.
void cost(const StudyStage& stage, Effort& effort) {
    if (stage.job.simulator) effort.rounds = effort.simulations / stage.stage.n_items();
}

}  // namespace

extern const Kind retrofit_kind{.word = "retrofit",
                                .sections = {sections},
                                .keys = {keys},
                                .takes_twin = true,
                                .read = read,
                                .check_names = check_names,
                                .check = check,
                                .stages = stages,
                                .cost = cost};

}  // namespace bemcal::job
