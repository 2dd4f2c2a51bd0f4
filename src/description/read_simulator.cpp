/// Reads [simulator], another program in place of a building: command, templates, files,
/// parameters, rules for outputs. Each parameter must have a place in a template or the
/// command.
/// Follows from paper 3's tool, which runs EnergyPlus once per point.
/// It is run by `command_simulator`. Whether outputs appear only a run shows.
#include "description/read_simulator.hpp"

#include "description/result_names.hpp"
#include "description/words.hpp"
#include "effects/hook_series.hpp"
#include "external/process.hpp"
#include "input/suggest.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

namespace fs = std::filesystem;
using external::CommandOptions;
using external::OutputRule;
using external::Take;

/// As a template writes it between two @.
bool is_plain_name(const std::string& name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    return is_letter(name[0]) && std::ranges::all_of(name, [&](char c) {
               return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
           });
}

/// Names of one kind, each once.
void add_name(const schema::Section& section, const std::string& name,
              std::set<std::string>& names) {
    if (!names.insert(name).second)
        section.fail_value("name", "stands twice; expected another name");
}

/// One that can stand in a template.
std::string plain_name(const schema::Section& section, std::set<std::string>& names) {
    std::string name = section.text("name");
    add_name(section, name, names);
    if (!is_plain_name(name))
        section.fail_value("name",
                           "expected a letter, then letters, digits and underscores, so "
                           "that it can stand in a template");
    check_name(section, "name", Named::meter, name);
    return name;
}

void read_limits(const schema::Section& section, physics::Parameter& parameter) {
    section.attempt_all([&] { parameter.least = section.number("min"); },
                        [&] { parameter.most = section.number("max"); });
    if (parameter.least >= parameter.most)
        section.fail("min", fmt::format("is {:g}, but max = {:g}; expected min < max",
                                        parameter.least, parameter.most));
}

std::vector<physics::Parameter> read_parameters(const schema::Section& simulator) {
    std::vector<physics::Parameter> parameters;
    std::set<std::string> names;
    const auto read_one = [&](const schema::Section& section) {
        physics::Parameter made;
        section.attempt_all([&] { made.name = plain_name(section, names); },
                            [&] { made.unit = section.text("unit"); },
                            [&] { read_limits(section, made); });
        made.nominal = (made.least + made.most) / 2;
        section.number_if("nominal", made.nominal);
        read_scenario_limits(section, made);
        parameters.push_back(std::move(made));
    };
    if (!simulator.each("parameter", "simulator.parameter", read_one))
        throw schema::Follows();
    if (parameters.empty())
        simulator.fail("parameter",
                       "is missing; expected sections [[simulator.parameter]]");
    return parameters;
}

void read_take(const schema::Section& section, OutputRule& rule) {
    if (!section.has("row")) {
        rule.take = section.choice_as<Take>("take");
        return;
    }
    rule.take = Take::row;
    rule.row = static_cast<int>(section.integer("row"));
}

OutputRule read_output(const schema::Section& section) {
    OutputRule rule;
    rule.name = section.text("name");
    rule.unit = section.text("unit");
    rule.file = section.has("file") ? section.text("file") : external::standard_output;
    if (section.has("column") == section.has("pattern"))
        section.fail(section.has("column") ? "column" : "name",
                     "expected either column, of a CSV file, or pattern, a regular "
                     "expression");
    if (section.has("column")) {
        rule.column = section.text("column");
        rule.header_line = static_cast<int>(section.integer("header"));
        rule.skipped = static_cast<int>(section.integer("skip"));
    } else {
        rule.pattern = section.text("pattern");
        at_key(section, "pattern", [&] { external::check_pattern(rule.pattern); });
    }
    read_take(section, rule);
    rule.rows = static_cast<int>(section.integer("rows"));
    rule.factor = section.number("factor");
    rule.offset = section.number("offset");
    return rule;
}

std::vector<OutputRule> read_outputs(const schema::Section& simulator) {
    std::vector<OutputRule> outputs;
    std::set<std::string> names;
    const auto read_one = [&](const schema::Section& section) {
        outputs.push_back(read_output(section));
        add_name(section, outputs.back().name, names);
    };
    if (!simulator.each("output", "simulator.output", read_one)) throw schema::Follows();
    return outputs;
}

OutputRule read_hours_of_meter(const schema::Section& section) {
    OutputRule rule;
    rule.name = section.text("meter");
    rule.file = section.text("file");
    rule.column = section.has("column") ? section.text("column") : rule.name;
    rule.header_line = static_cast<int>(section.integer("header"));
    rule.skipped = static_cast<int>(section.integer("skip"));
    rule.factor = section.number("factor");
    rule.offset = section.number("offset");
    return rule;
}

std::vector<OutputRule> read_hours(const schema::Section& simulator) {
    std::vector<OutputRule> hours;
    const auto read_one = [&](const schema::Section& section) {
        OutputRule rule = read_hours_of_meter(section);
        if (std::ranges::find(hours, rule.name, &OutputRule::name) != hours.end())
            section.fail_value("meter", "stands twice; expected another meter");
        hours.push_back(std::move(rule));
    };
    if (!simulator.each("hourly", "simulator.hourly", read_one)) throw schema::Follows();
    return hours;
}

/// Beside parameters in templates.
std::vector<external::EffectPlace> read_places(const schema::Section& simulator,
                                               const CommandOptions& options) {
    std::vector<external::EffectPlace> places;
    std::set<std::string> names;
    for (const physics::Parameter& parameter : options.parameters)
        names.insert(parameter.name);
    std::vector<std::string> hooks = effects::hooks_of_series();
    std::erase(hooks, "venting");  // it needs a temperature beside its hours
    const auto read_one = [&](const schema::Section& section) {
        external::EffectPlace place{plain_name(section, names), section.text("hook"),
                                    section.has("facade") ? section.text("facade") : "",
                                    section.has("meter") ? section.text("meter") : ""};
        check_word(section, "hook", place.hook, hooks, "hook of a series");
        for (const external::EffectPlace& before : places)
            if (effects::is_same_place(before, place))
                section.fail_value("hook",
                                   fmt::format("what is there, \"{}\" takes; expected "
                                               "another hook, facade or meter",
                                               before.name));
        places.push_back(std::move(place));
    };
    if (!simulator.each("effect", "simulator.effect", read_one)) throw schema::Follows();
    if (!places.empty() && options.hours.empty())
        simulator.fail("effect",
                       "has hours, but there is no [[simulator.hourly]], which a loop "
                       "needs; expected both or none");
    return places;
}

/// Names that may stand in a template: of parameters, then of effects.
std::vector<std::string> names_in_templates(const CommandOptions& options) {
    std::vector<std::string> names = names_of(options.parameters);
    for (const external::EffectPlace& place : options.places) names.push_back(place.name);
    return names;
}

/// "house.idf.in" and "house.template.idf" are templates of "house.idf".
std::string name_of_filled(const fs::path& file) {
    std::string name = file.filename().string();
    for (const std::string ending : {".in", ".template"})
        if (name.ends_with(ending) && name.size() > ending.size())
            return name.substr(0, name.size() - ending.size());
    return name;
}

/// The names that already stand for a file in a point's folder.
class Folder {
  public:
    void add(const schema::Section& section, std::string_view key,
             const std::string& name) {
        if (name.find('/') != std::string::npos)
            section.fail(key, fmt::format("\"{}\" has a slash; expected the name of a "
                                          "file in the folder of a point",
                                          name));
        if (!names_.insert(name).second)
            section.fail(key, fmt::format("a second file would be called \"{}\" in the "
                                          "folder of a point; expected another name",
                                          name));
    }

  private:
    std::set<std::string> names_{external::standard_output, external::standard_error};
};

void read_inputs(const schema::Section& simulator, input::InputFiles& files,
                 CommandOptions& options) {
    const std::vector<std::string> names = names_in_templates(options);
    Folder folder;
    for (const schema::Section& section :
         simulator.tables("template", "simulator.template")) {
        const fs::path path = section.path(section.text("file"));
        const std::string name =
            section.has("as") ? section.text("as") : name_of_filled(path);
        folder.add(section, section.has("as") ? "as" : "file", name);
        options.inputs.push_back(
            {name, external::TextTemplate(files.text(path, section.where("file")),
                                          path.string(), names)});
    }
    for (const std::string& file : simulator.texts("files")) {
        const fs::path path = simulator.path(file);
        folder.add(simulator, "files", path.filename().string());
        files.text(path, simulator.where("files"));
        options.links.push_back(fs::absolute(path));
    }
}

/// It is written for each run in place of a link.
void read_periods_file(const schema::Section& simulator, CommandOptions& options) {
    if (!simulator.has("periods")) return;
    const fs::path path = fs::absolute(simulator.path(simulator.text("periods")));
    if (std::erase(options.links, path) == 0)
        simulator.fail_value("periods",
                             "is none of files; expected the name of the file "
                             "that says which periods to simulate");
    if (!simulator.has("hourly"))
        simulator.fail("periods",
                       "is of runs that give hours; expected a "
                       "[[simulator.hourly]] for each meter");
    options.periods_file = path;
}

/// The words of the command; with a shell those that start it.
std::vector<std::string> read_words(const schema::Section& simulator) {
    std::vector<std::string> words = simulator.texts("command");
    if (words.empty() || words[0].empty())
        simulator.fail("command", "is empty; expected a program and its arguments");
    if (!simulator.flag("shell")) return words;
    if (words.size() > 1)
        simulator.fail("command",
                       "is a list, but shell = true; expected one text for the shell");
    return {"/bin/sh", "-c", words[0]};
}

void read_command(const schema::Section& simulator, CommandOptions& options) {
    const std::vector<std::string> words = read_words(simulator);
    const fs::path beside = fs::path(simulator.file()).parent_path();
    options.program = external::find_program(words[0], beside).string();
    if (options.program.empty())
        simulator.fail(
            "command",
            fmt::format("\"{}\" is no program that can be run; expected {}", words[0],
                        words[0].find('/') == std::string::npos
                            ? "one that is found on PATH, or a path with a slash"
                            : "an executable file there"));
    for (const std::string& word : words)
        options.arguments.emplace_back(word, simulator.where("command"),
                                       names_of(options.parameters));
}

/// Whether a template has the place, by its row in names_in_templates.
bool is_in_input(const CommandOptions& options, std::size_t row) {
    return std::ranges::any_of(options.inputs,
                               [&](const auto& input) { return input.text.uses(row); });
}

/// What no template asks for cannot have an effect.
void check_use(const schema::Section& simulator, const CommandOptions& options) {
    const auto places = simulator.tables("effect", "simulator.effect");
    for (std::size_t k = 0; k < places.size(); ++k)
        if (!is_in_input(options, options.parameters.size() + k))
            places[k].fail_value("name",
                                 fmt::format("no template uses it; expected @{}@ in one",
                                             options.places[k].name));
    const auto sections = simulator.tables("parameter", "simulator.parameter");
    for (std::size_t k = 0; k < sections.size(); ++k) {
        const bool in_input = is_in_input(options, k);
        const bool in_command = std::ranges::any_of(
            options.arguments, [&](const auto& word) { return word.uses(k); });
        if (!in_input && !in_command)
            sections[k].fail_value(
                "name", fmt::format("no template uses it; expected @{}@ in one, or in "
                                    "the command",
                                    options.parameters[k].name));
    }
}

/// The points' folders lie in it.
void check_folder(const schema::Section& simulator, const fs::path& folder) {
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        simulator.fail("folder",
                       fmt::format("{} is a file; expected the name of a folder "
                                   "for the points",
                                   folder.string()));
}

}  // namespace

std::pair<double, double> read_scenario_limits(const schema::Section& section,
                                               const physics::Parameter& parameter) {
    if (!section.has("limits")) return {parameter.least, parameter.most};
    const std::vector<double> ends = section.numbers("limits");
    if (ends.size() != 2 || ends[0] > parameter.least || ends[1] < parameter.most)
        section.fail("limits", fmt::format("expected two numbers around min = {:g} and "
                                           "max = {:g}, such as [{:g}, {:g}]",
                                           parameter.least, parameter.most,
                                           parameter.least, parameter.most));
    return {ends[0], ends[1]};
}

CommandOptions read_simulator(const schema::Section& simulator, input::InputFiles& files,
                              const std::string& job) {
    CommandOptions options;
    simulator.attempt_all([&] { options.parameters = read_parameters(simulator); },
                          [&] { options.outputs = read_outputs(simulator); },
                          [&] { options.hours = read_hours(simulator); });
    if (options.outputs.empty() && options.hours.empty())
        simulator.fail("output",
                       "is missing; expected sections [[simulator.output]], for a loop, "
                       "posterior, stages, screening or retrofit [[simulator.hourly]]");
    options.places = read_places(simulator, options);
    simulator.attempt_all(
        [&] {
            read_inputs(simulator, files, options);
            read_periods_file(simulator, options);
        },
        [&] { read_command(simulator, options); });
    check_use(simulator, options);
    options.time_limit_s = simulator.number("time_limit");
    options.output_limit = 1e6 * simulator.number("output_limit");
    options.keep = simulator.choice_as<external::Keep>("keep");
    options.folder = simulator.has("folder") ? simulator.text("folder") : job + ".points";
    check_folder(simulator, options.folder);
    return options;
}

}  // namespace bemcal::description
