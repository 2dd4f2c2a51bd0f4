/// Keeps the mistakes in a job, and tells them in the order of its files and lines.
/// Follows from messages that begin with "file:line: ".
/// What is a mistake, and what follows from one, is said by the readers.
#include "schema/mistakes.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

namespace bemcal::schema {

namespace {

struct Place {
    std::string file;
    int line = 0;
};

/// Of "file:line: ..." or "file:line:column: ..."; without a line, what stands before the
/// first ": ".
Place place_of(std::string_view message) {
    message = message.substr(0, message.find(": "));
    for (std::size_t colon = message.find(':'); colon != std::string_view::npos;
         colon = message.find(':', colon + 1)) {
        const std::string_view rest = message.substr(colon + 1);
        int line = 0;
        const auto [end, error] =
            std::from_chars(rest.data(), rest.data() + rest.size(), line);
        const bool is_whole = end == rest.data() + rest.size() || *end == ':';
        if (error == std::errc() && is_whole)
            return {std::string(message.substr(0, colon)), line};
    }
    return {std::string(message), 0};
}

/// The words of a path in a target: "zone.office.heating_set_point".
bool has_word(const std::string& path, const std::string& word) {
    return fmt::format(".{}.", path).find(fmt::format(".{}.", word)) != std::string::npos;
}

}  // namespace

void Mistakes::add(const UserError& error) {
    ++n_failures_;
    const auto is_it = [&](const UserError& other) {
        return std::string_view(other.what()) == error.what();
    };
    if (std::ranges::none_of(errors_, is_it)) errors_.push_back(error);
}

void Mistakes::lose(const Node& node) {
    node.used = true;
    for (const Entry& entry : node.entries) {
        if (entry.key == "name" && entry.node.kind == Node::Kind::text)
            lost_.insert(entry.node.text);
        lose(entry.node);
    }
}

bool Mistakes::is_lost(const std::string& path) const {
    if (!lost_.empty() && has_word(path, "*")) return true;
    return std::ranges::any_of(
        lost_, [&](const std::string& lost) { return has_word(path, lost); });
}

void Mistakes::throw_all(const std::string& file) const {
    if (errors_.empty()) return;
    if (errors_.size() == 1) throw errors_[0];
    const auto key = [&](const UserError& error) {
        Place place = place_of(error.what());
        return std::make_tuple(place.file != file, std::move(place.file), place.line);
    };
    std::vector<UserError> sorted = errors_;
    std::ranges::stable_sort(sorted, {}, key);
    std::string text;
    for (const UserError& error : sorted) text += fmt::format("{}\n", error.what());
    throw UserError(errors_[0].exit_code(),
                    fmt::format("{}{} mistakes; what depends on them was not checked",
                                text, sorted.size()));
}

}  // namespace bemcal::schema
