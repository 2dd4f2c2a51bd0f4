/// Reads a [[study]] of kind "loop", checks its names against each building and the
/// catalogue of effects, and says in a sentence what it will do.
/// Follows from the schema's rows for studies.
/// Buildings without derivatives (coupled zones, a radiator, links) are refused. The
/// search is in `loop`.
#include "effects/catalogue.hpp"
#include "job/readers.hpp"
#include "kernel/response.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

std::vector<study::Column> read_columns(const Sources& sources) {
    std::vector<study::Column> columns;
    for (const schema::Section& section :
         sources.with("series").tables("series", "series"))
        columns.push_back({section.text("name"),
                           section.has("unit") ? section.text("unit") : std::string()});
    return columns;
}

loop::LoopOptions read_loop(const schema::Section& section, std::uint64_t seed) {
    loop::LoopOptions options;
    options.period = section.text("period");
    options.parameters = section.texts("parameters");
    options.meters = section.texts("meters");
    options.most_effects = static_cast<int>(section.integer("most_effects"));
    options.try_structures = section.flag("try_structures");
    options.block_days = section.number("block_days");
    options.least_gain = section.number("least_gain");
    options.most_loss = section.number("most_loss");
    options.alpha = section.number("alpha");
    options.seed = seed;
    options.exclude = section.texts("exclude");
    options.generic = section.flag("generic");
    options.columns = section.texts("columns");
    return options;
}

namespace {

void check_columns(const schema::Section& section, const loop::LoopOptions& options,
                   const study::Case& building) {
    std::vector<std::string> names;
    names.reserve(building.columns.size());
    for (const study::Column& column : building.columns) names.push_back(column.name);
    for (const std::string& column : options.columns)
        check_word(section, "columns", column, names, "[[series]] of " + building.name);
}

/// Names of the grammar are sentences with a colon; any of them may stand there.
void check_exclude(const schema::Section& section, const loop::LoopOptions& options) {
    std::vector<std::string> names;
    names.reserve(effects::catalogue().size());
    for (const effects::Entry& entry : effects::catalogue())
        names.push_back(entry.effect.name);
    for (const std::string& name : options.exclude)
        if (name.find(": ") == std::string::npos)
            check_word(section, "exclude", name, names,
                       "effect of the catalogue (describe effects)");
}

}  // namespace

void check_loop(const schema::Section& section, const loop::LoopOptions& options,
                const std::vector<study::Case>& buildings) {
    check_exclude(section, options);
    const Learning learning{options.period, options.parameters, options.meters};
    for (const study::Case& building : buildings) {
        if (!kernel::has_derivatives(building.building))
            section.fail_value("kind",
                               building.name +
                                   " has coupled zones, a radiator or linked numbers, "
                                   "which have no derivatives; expected another study");
        check_parameters(section, learning, building);
        check_meters(section, learning, building);
        check_columns(section, options, building);
    }
}

std::string sentence_of(const loop::LoopOptions& options) {
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

}  // namespace bemcal::job
