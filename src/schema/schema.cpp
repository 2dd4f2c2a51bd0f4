/// Looks keys up in the schema: a section's own rows, those of sections that it includes,
/// and the building's numbers. Words what a key accepts.
/// Follows from `key_table` and `fields()`.
/// Values are checked by `section`, rules between keys by the readers.
#include "schema/schema.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::schema {

namespace {

constexpr const char* part_sections[] = {
    "construction", "glazing",       "boundary",  "zone",
    "zone.surface", "zone.window",   "zone.flow", "zone.load",
    "plant",        "zone.coupling", "meter",     "construction.layer",
    "zone.radiator"};

/// A number of a building as a row of the schema. Its default is written out for
/// `describe`.
Key key_of(const physics::Field& field, const std::string& fallback) {
    return {section_of(field.part),
            field.key,
            field.input != nullptr ? Type::input : Type::number,
            field.unit,
            std::isnan(field.fallback) ? nullptr : fallback.c_str(),
            field.least,
            field.most,
            field.sentence};
}

struct Table {
    std::map<std::string, std::vector<Key>, std::less<>> rows;
    std::vector<std::string> fallbacks;  ///< text that the rows of fields() point into
};

void append(std::vector<Key>& to, const std::vector<Key>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

Table make_table() {
    Table table;
    for (const Key& key : key_table()) table.rows[key.section].push_back(key);
    for (const physics::Field& field : physics::fields())
        table.fallbacks.push_back(fmt::format("{}", field.fallback));
    for (std::size_t i = 0; i < physics::fields().size(); ++i) {
        // A meter's factor is no key of [[meter]]: parameters reach it.
        if (physics::fields()[i].part == physics::Part::meter) continue;
        const Key key = key_of(physics::fields()[i], table.fallbacks[i]);
        table.rows[key.section].push_back(key);
    }
    const auto own = table.rows;
    for (const SectionInfo& section : sections())
        if (const auto included = own.find(section.includes); included != own.end())
            append(table.rows[section.name], included->second);
    return table;
}

const Table& whole_table() {
    static const Table table = make_table();
    return table;
}

}  // namespace

const char* section_of(physics::Part part) {
    return part_sections[static_cast<int>(part)];
}

std::vector<Key> keys_of(std::string_view section) {
    const auto found = whole_table().rows.find(section);
    return found == whole_table().rows.end() ? std::vector<Key>{} : found->second;
}

const Key* find_key(std::string_view section, std::string_view key) {
    const auto found = whole_table().rows.find(section);
    if (found == whole_table().rows.end()) return nullptr;
    for (const Key& row : found->second)
        if (key == row.key) return &row;
    return nullptr;
}

std::vector<std::string> choices_of(const Key& key) {
    std::vector<std::string> words(1);
    for (const char* c = key.unit; *c != '\0'; ++c) {
        if (*c == '|')
            words.emplace_back();
        else
            words.back() += *c;
    }
    return words;
}

namespace {

std::string range_of(const Key& key) {
    const auto plain = [](double number) {
        const bool whole = number == std::floor(number);
        return whole ? fmt::format("{:.0f}", number) : fmt::format("{:g}", number);
    };
    if (std::isinf(key.most)) return fmt::format("from {} on", plain(key.least));
    return fmt::format("{} to {}", plain(key.least), plain(key.most));
}

}  // namespace

std::string expectation(const Key& key) {
    const std::string unit = *key.unit != '\0' ? fmt::format(" {}", key.unit) : "";
    switch (key.type) {
        case Type::number:
            return range_of(key) + unit;
        case Type::integer:
            return fmt::format("a whole number, {}{}", range_of(key), unit);
        case Type::flag:
            return "true or false";
        case Type::text:
            return "a text in quotes";
        case Type::choice:
            return fmt::format("one of {}", fmt::join(choices_of(key), ", "));
        case Type::date:
            return "a date such as 2021-03-05";
        case Type::numbers:
            return "a list of numbers";
        case Type::texts:
            return "a list of texts";
        case Type::day:
            return "a number, or a list of 24, one for each hour from 0:00 on";
        case Type::input:
            return fmt::format("{}{}, or {{value, low, schedule}}, or {{series}}",
                               range_of(key), unit);
        case Type::table:
            return fmt::format("a section [{}]", key.key);
        case Type::tables:
            return fmt::format("sections [[{}]]", key.key);
    }
    return "";
}

}  // namespace bemcal::schema
