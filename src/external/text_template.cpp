/// A text with places like @infiltration@, filled with numbers in the fewest digits that
/// give them back.
/// Plain text without a source. Left out: formats, expressions, a way to write a place as
/// it is; a name between two @ that nobody knows is an error.
#include "external/text_template.hpp"

#include "base/error.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::external {
namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_of_name(char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
}

/// The name between the @ at `at` and the next one; empty where there is none.
std::string_view name_at(std::string_view text, std::size_t at) {
    std::size_t end = at + 1;
    while (end < text.size() && is_of_name(text[end])) ++end;
    if (end == at + 1 || end >= text.size() || text[end] != '@') return {};
    return is_letter(text[at + 1]) ? text.substr(at + 1, end - at - 1)
                                   : std::string_view();
}

std::size_t index_of(std::string_view name, const std::vector<std::string>& names,
                     const std::string& where, std::string_view text_before) {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    throw UserError(ExitCode::config,
                    fmt::format("{}:{}: @{}@ is no parameter; expected one of {}", where,
                                1 + std::ranges::count(text_before, '\n'), name,
                                fmt::join(names, ", ")));
}

}  // namespace

TextTemplate::TextTemplate(std::string_view text, const std::string& where,
                           const std::vector<std::string>& names) {
    std::size_t begin = 0;
    for (std::size_t at = text.find('@'); at != std::string_view::npos;
         at = text.find('@', at)) {
        const std::string_view name = name_at(text, at);
        if (name.empty()) {
            ++at;
            continue;
        }
        places_.push_back({std::string(text.substr(begin, at - begin)),
                           index_of(name, names, where, text.substr(0, at))});
        begin = at = at + name.size() + 2;
    }
    rest_ = text.substr(begin);
}

bool TextTemplate::uses(std::size_t name) const {
    return std::ranges::find(places_, name, &Place::name) != places_.end();
}

std::string TextTemplate::filled(std::span<const double> values,
                                 std::span<const std::string> texts) const {
    std::string text;
    for (const Place& place : places_) {
        text += place.before;
        if (place.name < values.size())
            text += fmt::format("{}", values[place.name]);
        else
            text += texts[place.name - values.size()];
    }
    return text + rest_;
}

}  // namespace bemcal::external
