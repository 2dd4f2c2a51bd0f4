/// Writes effects as TOML and their hours as CSV.
/// Follows from `HookSeries`: a column for each.
/// What a program makes of a hook is its own matter.
#include "external/effect_files.hpp"

#include "external/regular_file.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace bemcal::external {
namespace {

/// A TOML basic string.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c < ' ' ? ' ' : c;
    }
    return out + '"';
}

std::string section_of(const std::string& name, const effects::HookSeries& at,
                       const std::string& column) {
    std::string text = "[[effect]]\n";
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) text += fmt::format("{} = {}\n", key, quoted(value));
    };
    add("name", name);
    add("hook", at.hook);
    add("unit", at.unit);
    add("enters", at.is_factor ? "factor" : "add");
    add("facade", at.facade);
    add("meter", at.meter);
    if (!std::isnan(at.opens_above))
        text += fmt::format("opens_above = {}\n", at.opens_above);
    add("column", column);
    return text + "\n";
}

}  // namespace

std::vector<HandedFile> files_of(std::span<const study::GivenEffect> effects) {
    std::string sections, hours;
    std::vector<const std::vector<double>*> columns;
    for (const study::GivenEffect& effect : effects)
        for (const effects::HookSeries& at : effect.at) {
            columns.push_back(&at.values);
            const std::string column = fmt::format("effect_{}", columns.size());
            hours += (columns.size() > 1 ? "," : "") + column;
            sections += section_of(effect.name, at, column);
        }
    if (columns.empty()) return {};
    hours += '\n';
    for (std::size_t h = 0; h < columns[0]->size(); ++h) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            fmt::format_to(std::back_inserter(hours), "{}{:.9g}", c > 0 ? "," : "",
                           (*columns[c])[h]);
        hours += '\n';
    }
    return {{effects_file, sections}, {effects_hours_file, hours}};
}

std::vector<std::string> lines_left_out(const std::filesystem::path& folder) {
    constexpr double most_bytes = 1e5;  ///< a line for each of some effects
    const FileText written = text_of_file(folder / left_out_file, most_bytes);
    std::istringstream in(written.text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        if (!line.empty()) lines.push_back(line);
    return lines;
}

}  // namespace bemcal::external
