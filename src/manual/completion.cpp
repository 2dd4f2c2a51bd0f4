/// Writes what bash and zsh need to complete commands, options, topics and files.
/// Source: bash's `complete` and `compgen`, zsh's `_arguments` and `_describe`.
/// Values of options are completed as files where they are some, by their endings where
/// these are known.
/// Leaves out values that are words, such as uses: scripts/new knows them.
#include "manual/completion.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::manual {

namespace {

/// The endings of files, by what the command line calls them: what stands there, or an
/// option.
struct FileKind {
    const char *name, *endings;
};
constexpr FileKind file_kinds[] = {{"JOB", "toml csv"},
                                   {"RESULT", "h5"},
                                   {"FILE", "h5"},
                                   {"--idf", "idf epJSON"},
                                   {"--weather", "epw epw.gz csv csv.gz"},
                                   {"--meter", "csv csv.gz xlsx xml"}};

/// "" where they are not known.
std::string endings_of(const std::string& name) {
    for (const FileKind& kind : file_kinds)
        if (name == kind.name) return kind.endings;
    return "";
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> option_names(const Command& command) {
    std::vector<std::string> names;
    for (const Option& option : command.options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

/// Of all its files, each once: "h5 toml csv".
std::string endings_of(const Command& command) {
    std::vector<std::string> endings;
    for (const Option& option : command.options)
        if (option.names.empty() && !endings_of(option.value).empty())
            endings.push_back(endings_of(option.value));
    return joined(endings);
}

std::vector<std::string> command_names(const Program& program) {
    std::vector<std::string> names;
    names.reserve(program.commands.size());
    for (const Command& command : program.commands) names.push_back(command.name);
    return names;
}

std::string function_of(const Program& program) {
    std::string name = "_" + program.name;
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Of options behind which other files stand.
std::string bash_option_endings(const Command& command) {
    std::string text;
    for (const std::string& name : option_names(command))
        if (const std::string endings = endings_of(name); !endings.empty())
            text += fmt::format("            [[ $option == {} ]] && endings=\"{}\"\n",
                                name, endings);
    return text;
}

std::string bash_case(const Program& program, const Command& command) {
    const bool takes_topic = command.name == "describe";
    return fmt::format(
        "        {})\n            options=\"{}\"\n            words=\"{}\"\n            "
        "endings=\"{}\"\n{}            ;;\n",
        command.name, joined(option_names(command)),
        takes_topic ? joined(program.topics) : "", endings_of(command),
        bash_option_endings(command));
}

/// A text in single quotes, in which : and [ ] would mean something to zsh.
std::string zsh_text(const std::string& text) {
    std::string safe;
    for (const char c : text)
        if (c == '\'')
            safe += "'\\''";
        else if (c == ':' || c == '[' || c == ']')
            safe += fmt::format("\\{}", c);
        else
            safe += c;
    return safe;
}

/// A pattern of endings. A single one in parentheses would be flags of the pattern.
std::string zsh_pattern(std::string endings) {
    std::ranges::replace(endings, ' ', '|');
    const bool are_several = endings.find('|') != std::string::npos;
    return are_several ? fmt::format("*.({})", endings) : fmt::format("*.{}", endings);
}

/// "" of no endings: any file.
std::string zsh_files(const std::string& endings) {
    return endings.empty() ? "_files"
                           : fmt::format("_files -g \"{}\"", zsh_pattern(endings));
}

/// What zsh offers for the value of an option of that name: files, folders, or nothing.
std::string zsh_action(const std::string& name, const std::string& value) {
    if (value.empty()) return "";
    const std::string action = value.starts_with("FILE")     ? zsh_files(endings_of(name))
                               : value.starts_with("FOLDER") ? "_files -/"
                                                             : " ";
    return fmt::format(":{}:{}", value.substr(0, value.find('[')), action);
}

/// Names of one option exclude each other, unless it may be repeated.
std::string zsh_option(const Option& option) {
    const std::string before = option.repeats ? "*"
                               : option.names.size() > 1
                                   ? fmt::format("({})", joined(option.names))
                                   : "";
    std::string text;
    for (const std::string& name : option.names)
        text += fmt::format(" \\\n                '{}{}[{}]{}'", before, name,
                            zsh_text(option.sentence), zsh_action(name, option.value));
    return text;
}

std::string zsh_case(const Program& program, const Command& command) {
    std::string text = fmt::format("        {})\n            _arguments", command.name);
    for (const Option& option : command.options) text += zsh_option(option);
    const std::string endings = endings_of(command);
    if (command.name == "describe")
        text +=
            fmt::format(" \\\n                '1:topic:({})'", joined(program.topics));
    else if (!endings.empty())
        text += fmt::format(" \\\n                '*:file:{}'", zsh_files(endings));
    return text + "\n            ;;\n";
}

}  // namespace

std::string bash_completion(const Program& program) {
    std::string cases;
    for (const Command& command : program.commands) cases += bash_case(program, command);
    return fmt::format(
        R"sh(# Completion of {name} by bash, made by `{name} describe completion bash`.
{function}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} options="" words="" endings="" ending
    local option=${{COMP_WORDS[COMP_CWORD - 1]}}
    COMPREPLY=()
    [[ $current == = ]] && current=""
    [[ $option == = ]] && option=${{COMP_WORDS[COMP_CWORD - 2]}}
    if ((COMP_CWORD == 1)); then
        words="{commands}"
        endings="toml csv"
    else
        case ${{COMP_WORDS[1]}} in
{cases}        *)
            endings="toml csv"
            ;;
        esac
    fi
    [[ $current == -* ]] && words=$options endings=""
    mapfile -t COMPREPLY < <(
        compgen -W "$words" -- "$current"
        for ending in $endings; do
            compgen -f -X "!*.$ending" -- "$current"
        done
        [[ -z $endings ]] || compgen -d -- "$current"
    )
}}
complete -o filenames -F {function} {name}
)sh",
        fmt::arg("name", program.name), fmt::arg("function", function_of(program)),
        fmt::arg("commands", joined(command_names(program))), fmt::arg("cases", cases));
}

std::string zsh_completion(const Program& program) {
    std::string commands, cases;
    for (const Command& command : program.commands) {
        commands +=
            fmt::format("        '{}:{}'\n", command.name, zsh_text(command.sentence));
        cases += zsh_case(program, command);
    }
    return fmt::format(
        R"sh(#compdef {name}
# Completion of {name} by zsh, made by `{name} describe completion zsh`.
{function}() {{
    local -a commands=(
{commands}    )
    if ((CURRENT == 2)); then
        _describe command commands
        _files -g "*.(toml|csv)"
        return
    fi
    shift words
    ((CURRENT--))
    case $words[1] in
{cases}        *)
            _files -g "*.(toml|csv)"
            ;;
    esac
}}
{function} "$@"
)sh",
        fmt::arg("name", program.name), fmt::arg("function", function_of(program)),
        fmt::arg("commands", commands), fmt::arg("cases", cases));
}

}  // namespace bemcal::manual
