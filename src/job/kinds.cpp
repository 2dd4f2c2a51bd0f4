/// The table of kinds of study, and [[study]] opened by it: a key of another kind is
/// refused with the keys that there are.
/// Follows from the rows, each in a file of its own. A new kind is such a file and a line
/// in `rows`.
/// What a study of a kind does is not known here.
#include "job/kinds.hpp"

#include "input/suggest.hpp"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

extern const Kind sensitivity_kind, hourly_sensitivity_kind, office_hour_sensitivity_kind,
    screening_kind, posterior_kind, kennedy_ohagan_kind, loop_kind, optimisation_kind,
    retrofit_kind, grid_kind, stages_kind;

namespace {

constexpr const Kind* rows[] = {&sensitivity_kind,
                                &hourly_sensitivity_kind,
                                &office_hour_sensitivity_kind,
                                &screening_kind,
                                &posterior_kind,
                                &kennedy_ohagan_kind,
                                &loop_kind,
                                &optimisation_kind,
                                &retrofit_kind,
                                &grid_kind,
                                &stages_kind};

/// "a|b|c", as the schema writes a choice.
const std::string& choice_of_kinds() {
    static const std::string words = [] {
        std::vector<std::string> all;
        for (const Kind* kind : rows) all.emplace_back(kind->word);
        return fmt::format("{}", fmt::join(all, "|"));
    }();
    return words;
}

/// What every [[study]] has.
std::vector<schema::Key> common_keys() {
    return {{"study", "kind", schema::Type::choice, choice_of_kinds().c_str(), nullptr, 0,
             0, ""},
            {"study", "name", schema::Type::text, "", "", 0, 0, "Default: the kind."}};
}

template <class Row>
void append(std::vector<Row>& to, const Rows<Row>& from) {
    for (const auto& part : from) to.insert(to.end(), part.begin(), part.end());
}

schema::Table made_table(const Kind& kind) {
    std::vector<schema::SectionInfo> sections;
    append(sections, kind.sections);
    std::vector<schema::Key> keys = common_keys();
    append(keys, kind.keys);
    return {std::move(sections), keys};
}

bool has_key(const Kind& kind, const std::string& key) {
    return table_of(kind).find("study", key) != nullptr;
}

/// "a, b and c"
std::string listed(std::vector<std::string> words, const char* last_word) {
    if (words.size() < 2) return words.empty() ? "" : words[0];
    const std::string last = std::move(words.back());
    words.pop_back();
    return fmt::format("{} {} {}", fmt::join(words, ", "), last_word, last);
}

/// The kinds that have the key, in quotes.
std::string kinds_with(const std::string& key) {
    std::vector<std::string> words;
    for (const Kind* kind : rows)
        if (has_key(*kind, key)) words.push_back(fmt::format("\"{}\"", kind->word));
    return listed(std::move(words), "and");
}

std::string keys_nearest_first(const Kind& kind, const std::string& key) {
    std::vector<std::string> keys;
    for (const schema::Key& row : table_of(kind).keys_of("study"))
        keys.emplace_back(row.key);
    return fmt::format("{}", fmt::join(input::by_nearness(key, std::move(keys)), ", "));
}

void check_key(const schema::Section& section, const Kind& kind, const std::string& key) {
    if (has_key(kind, key)) return;
    const std::string others = kinds_with(key);
    section.fail(
        key, others.empty()
                 ? fmt::format("is no key of kind \"{}\"; expected one of {}", kind.word,
                               keys_nearest_first(kind, key))
                 : fmt::format("is a key of kind {}; this study is of kind \"{}\", whose "
                               "keys are {}",
                               others, kind.word, keys_nearest_first(kind, key)));
}

}  // namespace

std::span<const Kind* const> kinds() {
    return rows;
}

const schema::Table& common_table() {
    static const schema::Table table(
        {{"study", "[[study]]", "",
          "What is to be done with every building, in this order; its kind says which "
          "keys it has beside these.",
          true}},
        common_keys());
    return table;
}

const Kind* find_kind(std::string_view word) {
    for (const Kind* kind : rows)
        if (word == kind->word) return kind;
    return nullptr;
}

std::string words_of_kinds(bool (*is_meant)(const Kind&)) {
    std::vector<std::string> words;
    for (const Kind* kind : rows)
        if (is_meant(*kind)) words.emplace_back(kind->word);
    return listed(std::move(words), "or");
}

const schema::Table& table_of(const Kind& kind) {
    static const std::map<const Kind*, schema::Table> tables = [] {
        std::map<const Kind*, schema::Table> made;
        for (const Kind* each : rows) made.emplace(each, made_table(*each));
        return made;
    }();
    return tables.at(&kind);
}

OpenStudy open_study(const schema::Node& node, const std::string& file,
                     schema::Mistakes* mistakes) {
    const auto opened = [&](const schema::Table& table) {
        return schema::Section(node, "study", file, "", table, mistakes);
    };
    const schema::Section any = opened(common_table());
    const Kind& kind = *rows[any.choice_as<std::size_t>("kind")];
    bool is_known = true;
    for (const schema::Entry& entry : node.entries)
        is_known &= any.attempt([&] { check_key(any, kind, entry.key); });
    if (!is_known) throw schema::Follows();
    return {&kind, opened(table_of(kind))};
}

std::vector<OpenStudy> open_studies(const schema::Section& root) {
    std::vector<OpenStudy> studies;
    for (const schema::Node* node : root.list_of_tables("study"))
        studies.push_back(open_study(*node, root.file(), root.mistakes()));
    return studies;
}

}  // namespace bemcal::job
