/// Writes man pages in roff: a command with its options each, and the text of `describe
/// job` by its indents.
/// Source: man(7), the macros of man pages.
/// What stands there is the command line's and the schema's. No page of a single command.
#include "manual/man_pages.hpp"

#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::manual {

namespace {

/// Text in which roff finds nothing of its own.
std::string plain(const std::string& text) {
    std::string escaped;
    if (text.starts_with('.') || text.starts_with('\'')) escaped = "\\&";
    for (const char c : text)
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else
            escaped += c;
    return escaped;
}

std::string bold(const std::string& text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string header(const Program& program, const char* name, int section) {
    return fmt::format(".TH {} {} \"\" \"bemcal {}\"\n", plain(name), section,
                       program.version);
}

std::string option_text(const Option& option) {
    std::vector<std::string> names;
    names.reserve(option.names.size());
    for (const std::string& name : option.names) names.push_back(bold(name));
    std::string words = fmt::format("{}", fmt::join(names, ", "));
    if (!option.value.empty())
        words += fmt::format("{}\\fI{}\\fR", words.empty() ? "" : " ", option.value);
    return fmt::format(".TP\n{}\n{}\n", words, plain(option.sentence));
}

std::string command_text(const Program& program, const Command& command) {
    std::string line = bold(program.name + " " + command.name);
    for (const Option& option : command.options)
        if (option.names.empty()) line += fmt::format(" \\fI{}\\fR", option.value);
    std::string text = fmt::format(".SS {}\n{}\n.PP\n{}\n", plain(command.name), line,
                                   plain(command.sentence));
    for (const Option& option : command.options) text += option_text(option);
    return text;
}

/// How deep a line of `describe job` stands.
constexpr std::size_t key_indent = 2, example_indent = 4;
constexpr std::string_view example_heading = "  Example:";

/// The lines of `describe job` as roff.
class JobText {
  public:
    std::string of(const std::string& description) {
        std::istringstream lines(description);
        for (std::string line; std::getline(lines, line);) take(line);
        end_example();
        return text_;
    }

  private:
    void take(const std::string& line) {
        const std::size_t indent = line.find_first_not_of(' ');
        if (indent == std::string::npos)
            has_gap_ = true;
        else if (indent >= example_indent)
            take_example(line.substr(example_indent));
        else if (line == example_heading)
            is_in_keys_ = false;
        else if (indent == key_indent)
            take_key(line.substr(key_indent));
        else
            take_heading(line);
    }

    void take_heading(const std::string& line) {
        end_example();
        const bool is_section = has_gap_;
        text_ += is_section ? fmt::format(".SS {}\n", plain(line)) : plain(line) + "\n";
        has_gap_ = false;
        is_in_keys_ = false;
    }

    /// Sentences of a section come first, then its keys.
    void take_key(const std::string& line) {
        constexpr std::size_t key_width = 24;
        const std::size_t end = line.find(' ');
        const bool is_key = line.size() > key_width && end < key_width &&
                            line.find_first_not_of(' ', end) >= key_width;
        if (!is_key && line.size() > key_width && end == key_width) is_in_keys_ = true;
        if (!is_key && !is_in_keys_) {
            text_ += plain(line) + "\n";
            return;
        }
        is_in_keys_ = true;
        const std::string rest = line.substr(line.find_first_not_of(' ', end));
        text_ += fmt::format(".TP\n{}\n{}\n", bold(line.substr(0, end)), plain(rest));
    }

    void take_example(const std::string& line) {
        if (!is_in_example_)
            text_ += ".PP\n.EX\n";
        else if (has_gap_)
            text_ += "\\&\n";
        is_in_example_ = true;
        has_gap_ = false;
        text_ += plain(line) + "\n";
    }

    void end_example() {
        if (is_in_example_) text_ += ".EE\n";
        is_in_example_ = false;
    }

    std::string text_;
    bool has_gap_ = false, is_in_keys_ = false, is_in_example_ = false;
};

}  // namespace

std::string man_page_of(const Program& program) {
    std::string text = header(program, program.name.c_str(), 1);
    text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{} \\fICOMMAND\\fR ...\n",
                        plain(program.name), plain(program.sentence), bold(program.name));
    text += ".SH COMMANDS\n";
    for (const Command& command : program.commands)
        text += command_text(program, command);
    text += fmt::format(".SH NOTES\n{}\n", plain(program.footer));
    text += fmt::format(".SH SEE ALSO\n{}(5)\n", bold("bemcal-job"));
    return text;
}

std::string man_page_of_job(const Program& program, const std::string& description) {
    return header(program, "bemcal-job", 5) +
           fmt::format(".SH NAME\nbemcal\\-job \\- job file of {}\n.SH DESCRIPTION\n",
                       plain(program.name)) +
           JobText().of(description) +
           fmt::format(".SH SEE ALSO\n{}(1)\n", bold(program.name));
}

}  // namespace bemcal::manual
