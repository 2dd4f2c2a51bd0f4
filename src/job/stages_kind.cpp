/// The kind "stages": each stage's periods, parameters, ranges, held values and fit;
/// validation periods; studies to compare with. Checks names and ranges.
/// Source: paper 2.
/// A stage has one objective, so NSGA-II is no method here. Rules among stages are
/// checked by `make_staged`. Of a [simulator] an emulator of its runs is calibrated.
#include "calibration/emulated_calibration.hpp"
#include "calibration/staged.hpp"
#include "description/result_names.hpp"
#include "description/words.hpp"
#include "job/fit_keys.hpp"
#include "job/hourly_outputs.hpp"
#include "job/kind.hpp"
#include "job/names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using calibration::OptimisationOptions;
using calibration::StagedOptions;
using schema::Type;

using schema::required;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"stages\"", "",
     "A calibration in stages: each calibrates some parameters on some periods, and "
     "hands on what it finds."},
    {"study.stage", "[[study.stage]]", "", "One of them, in their order."},
    {"study.ranges", "ranges = {NAME = [0.1, 1.5]}", "",
     "Ranges of this stage, within the parameters' own.", true},
    {"study.set", "set = {NAME = 0.5}", "",
     "Parameters that have this value in this stage and those that start from it.", true},
    {"study.validation", "[[study.validation]]", "",
     "A period that judges what they found."},
};

constexpr schema::Key keys[] = {
    {"study", "stage", Type::tables, "", "", 0, 0, "[[study.stage]]"},
    {"study", "validation", Type::tables, "", "", 0, 0, "[[study.validation]]"},
    {"study", "at_once", Type::flag, "", "true", 0, 0,
     "Beside the stages all of their parameters are calibrated at once, on all of their "
     "periods."},
    {"study", "at_once_evaluations", Type::integer, "", "", 1, 1e9,
     "Its budget; default: that of all stages together."},
    {"study", "accuracy", Type::number, "", "0.35", 0, 1e9,
     "Of the sensor, in the meter's unit; the share of readings within it is told."},
    {"study", "independent_hours", Type::number, "h", "0", 0, 8760,
     "With objective = \"likelihood\": errors nearer than this count as one, and the "
     "priors of what is calibrated count beside them; 0: every reading counts, and no "
     "prior does."},
    {"study", "beside", Type::texts, "", "", 0, 0,
     "Names of studies above (posterior, optimisation, screening) whose mean or best "
     "point is judged on the same periods."},
    {"study", "meters", Type::texts, "", "", 0, 0,
     "Names of the meters that the stages fit; default: all with readings."},
    {"study", "method", Type::choice, "swarm_then_pattern|swarm|pattern",
     "swarm_then_pattern", 0, 0,
     "Of every stage: particle swarm with constriction on a mesh, then Hooke-Jeeves "
     "pattern search; or one of them alone."},
    {"study.stage", "name", Type::text, "", required, 0, 0, ""},
    {"study.stage", "periods", Type::texts, "", required, 0, 0,
     "It calibrates on these, taken together."},
    {"study.stage", "parameters", Type::texts, "", required, 0, 0,
     "It calibrates these; the others keep the values carried over."},
    {"study.stage", "from", Type::text, "", "", 0, 0,
     "Stage whose values it starts from, or \"initial\"; default: the one before."},
    {"study.stage", "around", Type::number, "-", "", 0, 100,
     "Range: this share of the value carried over, up and down, within the parameter's; "
     "default: the parameter's."},
    {"study.stage", "ranges", Type::table, "", "", 0, 0, "[study.ranges]"},
    {"study.stage", "set", Type::table, "", "", 0, 0, "[study.set]"},
    {"study.stage", "evaluations", Type::integer, "", "", 1, 1e9,
     "These and the following default to the study's."},
    {"study.stage", "seed", Type::integer, "", "", 0, 1e15, ""},
    {"study.stage", "meters", Type::texts, "", "", 0, 0, ""},
    {"study.stage", "meter_weights", Type::numbers, "-", "", 0, 1e9, ""},
    {"study.stage", "objective", Type::choice, "percent|fraction|likelihood|rmsd", "", 0,
     0, ""},
    {"study.validation", "period", Type::text, "", required, 0, 0,
     "That no stage calibrates on."},
    {"study.validation", "stage", Type::text, "", "", 0, 0,
     "Whose values it is judged with; default: the last."},
};

/// What a stage minimises, and how: from the study's keys.
OptimisationOptions read_fit(const schema::Section& section, std::uint64_t seed) {
    OptimisationOptions fit;
    fit.method = section.choice_as<calibration::OptimisationMethod>("method");
    fit.objective = section.choice_as<calibration::Objective>("objective");
    fit.cv_weight = section.number("cv_weight");
    fit.r2_weight = section.number("r2_weight");
    fit.meters = section.texts("meters");
    fit.meter_weights = section.numbers("meter_weights");
    fit.resolution = section.choice_as<calibration::ObjectiveResolution>("resolution");
    fit.evaluations = static_cast<std::size_t>(section.integer("evaluations"));
    fit.n_particles = static_cast<int>(section.integer("n_particles"));
    fit.restart = section.flag("restart");
    fit.seed = seed;
    return fit;
}

std::vector<calibration::NamedRange> read_ranges(const schema::Section& stage) {
    std::vector<calibration::NamedRange> ranges;
    if (!stage.has("ranges")) return ranges;
    const schema::Section table = stage.table("ranges", "study.ranges");
    for (const schema::Entry& entry : table.root().entries) {
        const schema::Key row{
            "study.ranges", "", schema::Type::numbers, "", nullptr, -1e300, 1e300, ""};
        std::vector<double> ends;
        for (const schema::Entry& end : table.node(entry.key).entries)
            ends.push_back(schema::checked_number(end.node, row, table.where(entry.key)));
        if (ends.size() != 2 || !(ends[0] < ends[1]))
            table.fail(entry.key, "expected two rising numbers: [0.1, 1.5]");
        ranges.push_back({entry.key, ends[0], ends[1]});
    }
    return ranges;
}

std::vector<calibration::NamedValue> read_set(const schema::Section& stage) {
    std::vector<calibration::NamedValue> set;
    if (!stage.has("set")) return set;
    const schema::Section table = stage.table("set", "study.set");
    const schema::Key row{"study.set", "", schema::Type::number, "", nullptr, -1e300,
                          1e300,       ""};
    for (const schema::Entry& entry : table.root().entries)
        set.push_back({entry.key, schema::checked_number(table.node(entry.key), row,
                                                         table.where(entry.key))});
    return set;
}

/// What the stage says of its own; the rest is the study's.
void read_own_fit(const schema::Section& stage, OptimisationOptions& fit) {
    stage.number_if("evaluations", fit.evaluations);
    stage.number_if("seed", fit.seed);
    if (stage.has("meters")) {
        fit.meters = stage.texts("meters");
        fit.meter_weights.clear();
    }
    if (stage.has("meter_weights")) fit.meter_weights = stage.numbers("meter_weights");
    if (stage.has("objective"))
        fit.objective = stage.choice_as<calibration::Objective>("objective");
}

calibration::CalibrationStage read_stage(const schema::Section& stage,
                                         const std::string& before,
                                         const OptimisationOptions& fit,
                                         double independent_hours) {
    calibration::CalibrationStage read;
    read.name = stage.text("name");
    description::check_name(stage, "name", description::Named::study, read.name);
    if (read.name == calibration::initial_values || read.name == calibration::all_at_once)
        stage.fail_value("name", "stands for something else; expected another name");
    read.from = stage.has("from") ? stage.text("from") : before;
    read.periods = stage.texts("periods");
    read.parameters = stage.texts("parameters");
    if (stage.has("around")) read.around = stage.number("around");
    read.ranges = read_ranges(stage);
    read.set = read_set(stage);
    read.fit = fit;
    read_own_fit(stage, read.fit);
    read.independent_hours = independent_hours;
    return read;
}

/// Ranges within the parameter's own, which is what its description admits.
void check_ranges(const schema::Section& stage, const calibration::CalibrationStage& read,
                  const study::Case& building) {
    for (const calibration::NamedRange& range : read.ranges) {
        const auto found = std::ranges::find(building.parameters, range.parameter,
                                             &physics::Parameter::name);
        if (found == building.parameters.end()) continue;  // the study says so itself
        if (range.least < found->least || range.most > found->most)
            stage.fail("ranges",
                       fmt::format("{} goes from {} to {}; expected a part of "
                                   "the parameter's range, {} to {}",
                                   range.parameter, schema::plain(range.least),
                                   schema::plain(range.most), schema::plain(found->least),
                                   schema::plain(found->most)));
    }
}

void check_set(const schema::Section& stage, const calibration::CalibrationStage& read,
               const study::Case& building) {
    for (const calibration::NamedValue& each : read.set) {
        const auto found = std::ranges::find(building.parameters, each.parameter,
                                             &physics::Parameter::name);
        if (found == building.parameters.end()) continue;  // the study says so itself
        if (each.value < found->least || each.value > found->most)
            stage.fail("set", fmt::format("{} = {} is outside the parameter's range, {} "
                                          "to {}",
                                          each.parameter, schema::plain(each.value),
                                          schema::plain(found->least),
                                          schema::plain(found->most)));
    }
}

void check_names_of_stage(const schema::Section& stage, const BuildingNames& names) {
    const auto words = [&](const char* key) { return words_at(stage.root(), key); };
    stage.attempt_all(
        [&] { check_periods(stage, "periods", words("periods"), names); },
        [&] { check_parameters(stage, "parameters", words("parameters"), names); },
        [&] { check_meters(stage, "meters", words("meters"), names); });
}

void check_beside(const NamePlace& place) {
    const schema::Section& section = place.section;
    if (section.is_lost("study") ||
        std::ranges::count(place.above, "", &NamedStudy::name) > 0)
        return;
    for (const std::string& name : words_at(section.root(), "beside"))
        if (std::ranges::find(place.above, name, &NamedStudy::name) == place.above.end())
            section.fail("beside", fmt::format("no study above has the name \"{}\"; "
                                               "expected that of one",
                                               name));
}

void check_names(const NamePlace& place) {
    const schema::Section& section = place.section;
    section.attempt_all(
        [&] { check_beside(place); },
        [&] {
            section.attempt_each(section.tables("stage", "study.stage"),
                                 [&](const schema::Section& stage) {
                                     check_names_of_stage(stage, place.names);
                                 });
        },
        [&] {
            section.attempt_each(section.tables("validation", "study.validation"),
                                 [&](const schema::Section& validation) {
                                     check_periods(validation, "period",
                                                   words_at(validation.root(), "period"),
                                                   place.names);
                                 });
        });
}

std::vector<calibration::CalibrationStage> read_stages(const schema::Section& section,
                                                       std::uint64_t seed) {
    std::vector<calibration::CalibrationStage> stages;
    const OptimisationOptions fit = read_fit(section, seed);
    const double independent_hours = section.number("independent_hours");
    std::string before = calibration::initial_values;
    for (const schema::Section& stage : section.tables("stage", "study.stage")) {
        stages.push_back(read_stage(stage, before, fit, independent_hours));
        if (independent_hours > 0 &&
            stages.back().fit.objective != calibration::Objective::likelihood)
            section.fail("independent_hours",
                         "is of a likelihood; expected objective = \"likelihood\", or "
                         "leave it out");
        before = stages.back().name;
    }
    if (stages.empty())
        section.fail("stage",
                     "is missing; expected sections [[study.stage]], each with a "
                     "name, periods and parameters");
    return stages;
}

/// Results are stored by the period.
std::vector<calibration::ValidationPeriod> read_validation(
    const schema::Section& section, const std::string& last_stage) {
    std::vector<calibration::ValidationPeriod> periods;
    for (const schema::Section& each : section.tables("validation", "study.validation")) {
        const std::string period = each.text("period");
        if (std::ranges::find(periods, period, &calibration::ValidationPeriod::period) !=
            periods.end())
            each.fail_value("period",
                            "another [[study.validation]] has this period; expected "
                            "each once");
        periods.push_back({period, each.has("stage") ? each.text("stage") : last_stage});
    }
    return periods;
}

void read(const StudySource& source, StudySpec& study) {
    const schema::Section& section = source.section;
    StagedOptions options;
    options.stages = read_stages(section, source.seed);
    options.validation = read_validation(section, options.stages.back().name);
    options.at_once = section.flag("at_once");
    if (!options.at_once && section.has("at_once_evaluations"))
        section.fail("at_once_evaluations",
                     "is of at_once, which is false; leave it out");
    if (section.has("at_once_evaluations"))
        options.at_once_evaluations =
            static_cast<std::size_t>(section.integer("at_once_evaluations"));
    options.objective = section.choice_as<calibration::Objective>("objective");
    options.accuracy = section.number("accuracy");
    options.beside = section.texts("beside");
    options.simulator_runs = static_cast<int>(section.integer("runs"));
    study.options = std::move(options);
}

std::unique_ptr<study::Stage> stage_around(const std::string& name,
                                           const StagedOptions& staged, const Job& job) {
    calibration::EmulatedOptions options{"stages", staged.simulator_runs, job.seed, {}};
    for (const calibration::CalibrationStage& stage : staged.stages)
        options.periods.insert(options.periods.end(), stage.periods.begin(),
                               stage.periods.end());
    return calibration::make_emulated_calibration(
        name, job.buildings.at(0), job.hourly_simulator, options,
        [name, staged](const study::Case& building,
                       const calibration::MakePeriodModel& model) {
            return calibration::make_staged(name, building, staged, model);
        });
}

/// What stages name, and its ranges.
void check_values(const schema::Section& section, const StagedOptions& options,
                  const study::Case& building) {
    std::size_t next = 0;
    for (const schema::Section& stage : section.tables("stage", "study.stage")) {
        const calibration::CalibrationStage& read = options.stages[next++];
        check_ranges(stage, read, building);
        check_set(stage, read, building);
        check_weights(stage.has("meter_weights") ? stage : section, read.fit);
    }
}

/// What the stages cannot be made with, at the stage that it is of.
template <class Make>
void check_made(const schema::Section& section, Make make) {
    const std::vector<schema::Section> stages = section.tables("stage", "study.stage");
    description::at_key(section, "kind", [&] {
        try {
            make();
        } catch (const calibration::StageFault& fault) {
            if (fault.stage >= stages.size()) throw;  // all at once
            stages[fault.stage].fail("name", fault.what());
        }
    });
}

void check_building(const schema::Section& section, const StagedOptions& options,
                    const study::Case& building) {
    check_values(section, options, building);
    check_made(section, [&] { calibration::make_staged("checked", building, options); });
}

/// Its parameters are the program's, its meters those that the program has hours of.
void check_simulator(const StudyPlace& place, const StagedOptions& staged) {
    const schema::Section& section = place.section;
    check_hourly_outputs(place, section.texts("meters"));
    check_nominal(place, "stages start from it");
    const study::Case building = calibration::case_of_simulator(
        place.job.buildings[0], *place.job.hourly_simulator);
    const BuildingNames names = names_of(building);
    for (const schema::Section& stage : section.tables("stage", "study.stage"))
        check_names_of_stage(stage, names);
    check_values(section, staged, building);
    check_made(section, [&] { stage_around("checked", staged, place.job); });
}

void check(const StudyPlace& place, StudySpec& study) {
    const auto& options = study.as<StagedOptions>();
    if (place.job.simulator) return check_simulator(place, options);
    check_no_runs(place.section);
    for (const study::Case& building : place.job.buildings)
        check_building(place.section, options, building);
}

Stages stages(const StudySpec& study, const Job& job) {
    const auto& options = study.as<StagedOptions>();
    if (job.hourly_simulator)
        return only(stage_around(stage_name(study, job.buildings.at(0)), options, job));
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return calibration::make_staged(std::move(name), building, options);
    });
}

void cost(const StudyStage& stage, Effort& effort) {
    if (stage.job.simulator) return;  // its runs are what takes time
    effort.rounds = effort.simulations /
                    (stage.stage.n_items() * calibration::points_per_staged_item);
}

std::vector<Fitted> fitted(const StudySpec& study, const study::Case&) {
    std::vector<Fitted> all;
    for (const calibration::CalibrationStage& stage : study.as<StagedOptions>().stages)
        for (const std::string& period : stage.periods)
            all.push_back({period, stage.fit.meters});
    return all;
}

}  // namespace

extern const Kind stages_kind{.word = "stages",
                              .sections = {sections},
                              .keys = {keys, fit_keys, emulated_hours_keys},
                              .takes_twin = true,
                              .read = read,
                              .check_names = check_names,
                              .check = check,
                              .stages = stages,
                              .cost = cost,
                              .fitted = fitted};

}  // namespace bemcal::job
