/// Holds the names in a study against those of the job's sections, and words what is none
/// of them as the checks of a whole building do.
/// Follows from the sections as they are written: a name counts where the section that
/// has it could not be read.
/// Names of schedules, series and buildings wait for the whole building.
#include "job/names.hpp"

#include "description/words.hpp"
#include "job/kinds.hpp"
#include "schema/lay_over.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using schema::Node;

bool has(const Words& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// In the order of the file, then those that no section has.
void add_missing(const Words& others, Words& names) {
    for (const std::string& other : others)
        if (!has(names, other)) names.push_back(other);
}

/// The names of a list of sections.
Words names_at(const description::Sources& sources, const char* key) {
    Words names;
    const Node* list = schema::find_node(sources.with(key).root(), key);
    if (list == nullptr) return names;
    for (const schema::Entry& entry : list->entries) {
        const Node* name = schema::find_node(entry.node, "name");
        if (name != nullptr && name->kind == Node::Kind::text)
            names.push_back(name->text);
    }
    return names;
}

/// The first is that of training, as in a building.
Words periods_at(const description::Sources& sources) {
    Words names;
    const Node* periods = schema::find_node(sources.with("periods").root(), "periods");
    if (periods == nullptr || periods->kind != Node::Kind::table) return names;
    for (const schema::Entry& period : periods->entries) names.push_back(period.key);
    std::ranges::stable_partition(
        names, [](const std::string& name) { return name == "training"; });
    return names;
}

/// What stands twice in a list would have two weights, or be done again.
void check_once(const schema::Section& section, const char* key, const Words& words) {
    for (std::size_t k = 0; k < words.size(); ++k)
        if (std::ranges::count(std::span(words).first(k), words[k]) > 0)
            section.fail(key,
                         fmt::format("names \"{}\" twice; expected each once", words[k]));
}

void check_words(const schema::Section& section, const char* key, const Words& words,
                 const Words& names, const char* kind, const std::string& building) {
    check_once(section, key, words);
    if (names.empty()) return;
    section.attempt_each(words, [&](const std::string& word) {
        if (!has(names, word) && section.is_lost(kind)) throw schema::Follows();
        description::check_word(section, key, word, names,
                                fmt::format("{} of {}", kind, building));
    });
}

void check_period(const schema::Section& section, const BuildingNames& names) {
    for (const std::string& period : words_at(section.root(), "period")) {
        if (names.periods.empty() || has(names.periods, period)) return;
        if (section.is_lost(period)) throw schema::Follows();
        section.fail_value("period",
                           fmt::format("{} has no such period", names.building));
    }
}

/// Of a building that is predicted only, no meter is asked for by name.
bool is_unseen(const NamePlace& place) {
    return has(words_at(place.section.root(), "unseen"), place.names.building);
}

}  // namespace

BuildingNames names_of(const study::Case& building) {
    return {building.name, description::names_of(building.periods),
            description::names_of(building.parameters),
            description::names_of(building.meters)};
}

BuildingNames names_of(const study::Case& building, const description::Sources& sources) {
    const BuildingNames read = names_of(building);
    BuildingNames names{building.name, periods_at(sources),
                        names_at(sources, "parameter"), names_at(sources, "meter")};
    add_missing(read.periods, names.periods);
    add_missing(read.parameters, names.parameters);
    add_missing(read.meters, names.meters);
    return names;
}

NamedStudy named_study(const Node& study) {
    const Node* word = schema::find_node(study, "kind");
    const Node* name = schema::find_node(study, "name");
    const Kind* kind = word == nullptr ? nullptr : find_kind(word->text);
    if (name != nullptr) return {name->text, kind};
    if (kind == nullptr) return {};
    const bool is_known = std::ranges::all_of(study.entries, [&](const auto& entry) {
        return table_of(*kind).find("study", entry.key) != nullptr;
    });
    return {is_known ? kind->word : "", kind};
}

Words words_at(const Node& section, std::string_view key) {
    const Node* value = schema::find_node(section, key);
    if (value == nullptr || !value->used) return {};
    if (value->kind == Node::Kind::text) return {value->text};
    Words words;
    if (value->kind != Node::Kind::array) return words;
    for (const schema::Entry& entry : value->entries)
        if (entry.node.kind == Node::Kind::text) words.push_back(entry.node.text);
    return words;
}

void check_periods(const schema::Section& section, const char* key, const Words& words,
                   const BuildingNames& names) {
    check_words(section, key, words, names.periods, "period", names.building);
}

void check_parameters(const schema::Section& section, const char* key, const Words& words,
                      const BuildingNames& names) {
    check_words(section, key, words, names.parameters, "parameter", names.building);
}

void check_meters(const schema::Section& section, const char* key, const Words& words,
                  const BuildingNames& names) {
    check_words(section, key, words, names.meters, "meter", names.building);
}

void check_names(const Kind& kind, const NamePlace& place) {
    const schema::Section& section = place.section;
    const auto words = [&](const char* key) { return words_at(section.root(), key); };
    section.attempt_all(
        [&] { check_period(section, place.names); },
        [&] {
            check_parameters(section, "parameters", words("parameters"), place.names);
        },
        [&] {
            if (!is_unseen(place))
                check_meters(section, "meters", words("meters"), place.names);
        },
        [&] {
            if (kind.check_names != nullptr) kind.check_names(place);
        });
}

}  // namespace bemcal::job
