/// Reads a [[study]] of kind "stages": each stage's periods, parameters, ranges, held
/// values and fit; validation periods; studies to compare with. Checks names and ranges.
/// Source: paper 2.
/// NSGA-II is refused, as a stage has one objective. Rules among stages are checked by
/// `make_staged`.
#include "job/readers.hpp"
#include "job/result_names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

constexpr const char* stage_schema = "study.calibration_stage";

/// What a stage minimises, and how: from the study's keys.
calibration::OptimisationOptions read_fit(const schema::Section& section,
                                          std::uint64_t seed) {
    calibration::OptimisationOptions fit;
    fit.method = section.choice_as<calibration::OptimisationMethod>("method");
    if (fit.method == calibration::OptimisationMethod::nsga2)
        section.fail_value("method",
                           "a stage has one objective; expected another method");
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
void read_own_fit(const schema::Section& stage, calibration::OptimisationOptions& fit) {
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
                                         const calibration::OptimisationOptions& fit,
                                         double independent_hours) {
    calibration::CalibrationStage read;
    read.name = stage.text("name");
    check_name(stage, "name", Named::study, read.name);
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

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const Named& one : all) names.push_back(one.name);
    return names;
}

void check_words(const schema::Section& section, const char* key,
                 const std::vector<std::string>& words,
                 const std::vector<std::string>& names, const std::string& what) {
    for (const std::string& word : words) check_word(section, key, word, names, what);
}

void check_stage(const schema::Section& stage, const calibration::CalibrationStage& read,
                 const study::Case& building) {
    check_words(stage, "periods", read.periods, names_of(building.periods),
                "period of " + building.name);
    check_words(stage, "parameters", read.parameters, names_of(building.parameters),
                "parameter of " + building.name);
    check_words(stage, "meters", read.fit.meters, names_of(building.meters),
                "meter of " + building.name);
    check_ranges(stage, read, building);
    check_set(stage, read, building);
}

}  // namespace

calibration::StagedOptions read_staged(const schema::Section& section,
                                       std::uint64_t seed) {
    calibration::StagedOptions options;
    const calibration::OptimisationOptions fit = read_fit(section, seed);
    const double independent_hours = section.number("independent_hours");
    std::string before = calibration::initial_values;
    for (const schema::Section& stage : section.tables("stage", stage_schema)) {
        options.stages.push_back(read_stage(stage, before, fit, independent_hours));
        if (independent_hours > 0 &&
            options.stages.back().fit.objective != calibration::Objective::likelihood)
            section.fail("independent_hours",
                         "is of a likelihood; expected objective = \"likelihood\", or "
                         "leave it out");
        before = options.stages.back().name;
    }
    if (options.stages.empty())
        section.fail("stage",
                     "is missing; expected sections [[study.stage]], each with a "
                     "name, periods and parameters");
    for (const schema::Section& validation :
         section.tables("validation", "study.validation"))
        options.validation.push_back(
            {validation.text("period"),
             validation.has("stage") ? validation.text("stage") : before});
    options.at_once = section.flag("at_once");
    if (section.has("at_once_evaluations"))
        options.at_once_evaluations =
            static_cast<std::size_t>(section.integer("at_once_evaluations"));
    options.accuracy = section.number("accuracy");
    options.beside = section.texts("beside");
    return options;
}

void check_staged(const schema::Section& section,
                  const calibration::StagedOptions& options,
                  const std::vector<study::Case>& buildings) {
    const std::vector<schema::Section> stages = section.tables("stage", stage_schema);
    for (const study::Case& building : buildings) {
        for (std::size_t s = 0; s < stages.size(); ++s)
            check_stage(stages[s], options.stages[s], building);
        for (const schema::Section& validation :
             section.tables("validation", "study.validation"))
            check_words(validation, "period", {validation.text("period")},
                        names_of(building.periods), "period of " + building.name);
        at_key(section, "kind",
               [&] { return calibration::make_staged("checked", building, options); });
    }
}

}  // namespace bemcal::job
