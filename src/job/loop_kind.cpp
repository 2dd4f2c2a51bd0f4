/// The kind "loop": the search for what a description lacks; its names checked against
/// each building and the catalogue of effects.
/// Follows from `make_loop`.
/// Buildings without derivatives (coupled zones, a radiator, links) are refused. The
/// search is in `loop`.
#include "description/words.hpp"
#include "effects/catalogue.hpp"
#include "job/hourly_outputs.hpp"
#include "job/kind.hpp"
#include "job/learning.hpp"
#include "kernel/response.hpp"
#include "loop/around_simulator.hpp"
#include "loop/loop.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

namespace {

using loop::LoopOptions;
using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"loop\"", "",
     "A calibration, then a search for effects that the description lacks and the "
     "readings show."}};

constexpr schema::Key keys[] = {
    {"study", "most_effects", Type::integer, "", "6", 0, 20,
     "So many effects are accepted at most; 0 only shows what could be seen."},
    {"study", "try_structures", Type::flag, "", "true", 0, 0,
     "Before effects are sought, refinements of the model's structure are tried, and the "
     "one that predicts best is kept; false: the structure as described."},
    {"study", "block_days", Type::number, "d", "14", 2, 90,
     "The training period is cut into blocks of this length; what is accepted must "
     "predict blocks that were kept from it."},
    {"study", "least_gain", Type::number, "%", "2", 0, 100,
     "By so much an effect must lower the errors of the meters in those blocks, as their "
     "mean."},
    {"study", "most_loss", Type::number, "%", "1", 0, 100,
     "By so much it may raise the error of any meter there; by 15 % of what the best "
     "meter gains, where that is more."},
    {"study", "alpha", Type::number, "-", "0.01", 0.0001, 0.5,
     "Chance that noise alone shows as much evidence as is asked for, in any of the "
     "effects that one step refits (the best by the tangent, 36 at most), not of all "
     "that it screens."},
    {"study", "exclude", Type::texts, "", "", 0, 0,
     "Names of effects that are not to be tried (describe effects)."},
    {"study", "generic", Type::flag, "", "true", 0, 0,
     "Effects beside the catalogue's are tried, too: any place, what it follows, how and "
     "when. They show what else explains the same; only what follows columns joins."},
    {"study", "functions", Type::flag, "", "true", 0, 0,
     "What effects leave is laid to functions without a name: of the hour of the week, of "
     "the weather, of the load, of time, wherever they may enter. They join as long as "
     "blocks that were kept from them are predicted better."},
    {"study", "level_change", Type::number, "-", "", 0, 1,
     "By so much, as a standard deviation, the level of an energy meter in another period "
     "than training may differ from what is predicted: use and operation change. It "
     "widens the 90 % intervals there; default: 0.06 of electricity, 0.18 of others."},
    {"study", "runs", Type::integer, "", "80", 20, 100000,
     "Of a [simulator], about: a half are spread over its parameters' "
     "ranges, then come those near the optimum, with each effect found, and with all."},
    {"study", "columns", Type::texts, "", "", 0, 0,
     "Names of [[series]] that an effect beside the catalogue's may follow: rain, carbon "
     "dioxide, a tariff."},
};

void read(const StudySource& source, StudySpec& study) {
    const schema::Section& section = source.section;
    LoopOptions options;
    options.period = study.period = section.text("period");
    options.parameters = section.texts("parameters");
    options.meters = section.texts("meters");
    options.most_effects = static_cast<int>(section.integer("most_effects"));
    options.try_structures = section.flag("try_structures");
    options.block_days = section.number("block_days");
    options.least_gain = section.number("least_gain");
    options.most_loss = section.number("most_loss");
    options.alpha = section.number("alpha");
    if (section.has("level_change"))
        options.level_change = section.number("level_change");
    options.seed = source.seed;
    options.exclude = section.texts("exclude");
    options.generic = section.flag("generic");
    options.functions = section.flag("functions");
    options.columns = section.texts("columns");
    options.simulator_runs = static_cast<int>(section.integer("runs"));
    study.options = std::move(options);
}

void check_columns(const schema::Section& section, const LoopOptions& options,
                   const study::Case& building) {
    for (const std::string& column : options.columns)
        description::check_word(section, "columns", column,
                                description::names_of(building.columns),
                                "[[series]] of " + building.name);
}

/// Names of the grammar are sentences with a colon; any of them may stand there.
void check_exclude(const schema::Section& section, const LoopOptions& options) {
    std::vector<std::string> names;
    names.reserve(effects::catalogue().size());
    for (const effects::Entry& entry : effects::catalogue())
        names.push_back(entry.effect.name);
    for (const std::string& name : options.exclude)
        if (name.find(": ") == std::string::npos)
            description::check_word(section, "exclude", name, names,
                                    "effect of the catalogue (describe effects)");
}

void check_building(const schema::Section& section, const LoopOptions& options,
                    const study::Case& building) {
    if (!kernel::has_derivatives(building.building))
        section.fail_value("kind",
                           building.name +
                               " has coupled zones, a radiator or linked numbers, "
                               "which have no derivatives; expected another study");
    const Learning learning{options.period, options.parameters, options.meters};
    check_parameters(section, learning, building);
    check_meters(section, learning, building);
    check_columns(section, options, building);
}

void check_simulator(const StudyPlace& place, const LoopOptions& options) {
    check_hourly_outputs(place, options.meters);
    check_nominal(place, "a loop runs it first");
}

void check(const StudyPlace& place, StudySpec& study) {
    const auto& options = study.as<LoopOptions>();
    if (place.job.simulator)
        check_simulator(place, options);
    else
        check_no_runs(place.section);
    check_exclude(place.section, options);
    for (const study::Case& building : place.job.buildings)
        check_building(place.section, options, building);
}

/// One stage, an item for each building; of a simulator an item for each run.
Stages stages(const StudySpec& study, const Job& job) {
    if (job.hourly_simulator)
        return only(loop::make_loop_around(study.name, job.buildings.at(0),
                                           job.hourly_simulator,
                                           study.as<LoopOptions>()));
    return only(loop::make_loop(study.name, job.buildings, study.as<LoopOptions>()));
}

std::string sentence(const StudySpec& study) {
    const auto& options = study.as<LoopOptions>();
    const std::string columns =
        options.columns.empty() || !options.generic
            ? std::string()
            : fmt::format(", which may follow {}", fmt::join(options.columns, ", "));
    const std::string excluded =
        options.exclude.empty()
            ? std::string()
            : fmt::format(", but not {}", fmt::join(options.exclude, ", "));
    return fmt::format(
        "at most {} effects {}{}{}; accepted where the error in blocks of {:g} days that "
        "were left out falls by {:g} % as a mean over the meters and rises on none by "
        "more than {:g} % (more where another gains much)",
        options.most_effects,
        options.generic ? "of the catalogue and beside it" : "of the catalogue", columns,
        excluded, options.block_days, options.least_gain, options.most_loss);
}

std::vector<Fitted> fitted(const StudySpec& study, const study::Case&) {
    const auto& options = study.as<LoopOptions>();
    return {{options.period, options.meters}};
}

/// A search of one building by its hours in training, as measured on buildings of two to
/// five meters by the hour (17 to 190 s for a year, mostly 70), and on bills (1 to 2 s);
/// and the hours of all periods, of which it keeps what every candidate does.
constexpr double hour_of_hours_s = 8e-3, hour_of_bills_s = 2e-4, hour_bytes = 7e4;

bool is_read_by_the_hour(const study::Case& building) {
    return std::ranges::any_of(building.meters, [](const study::Meter& meter) {
        return meter.interval <= physics::Interval::hourly;
    });
}

void cost(const StudyStage& stage, Effort& effort) {
    if (stage.building == nullptr) return;
    const double n = stage.stage.n_items();
    effort.seconds =
        n * effort.hours *
        (is_read_by_the_hour(*stage.building) ? hour_of_hours_s : hour_of_bills_s);
    for (const study::Period& period : stage.building->periods)
        effort.working_bytes += study::hours_of(period) * hour_bytes;
}

}  // namespace

extern const Kind loop_kind{.word = "loop",
                            .sections = {sections},
                            .keys = {learning_keys, keys},
                            .takes_twin = true,
                            .calibrates_twin = true,
                            .takes_stock = true,
                            .finds_effects = true,
                            .read = read,
                            .check = check,
                            .stages = stages,
                            .cost = cost,
                            .sentence = sentence,
                            .points_around = stage_name,
                            .fitted = fitted};

}  // namespace bemcal::job
