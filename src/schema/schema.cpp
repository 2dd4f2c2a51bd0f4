/// Looks keys up in a table of the schema: a section's own rows, then those of the
/// section that it includes. Makes the job's table, and words what a key accepts. Follows
/// from `declared_keys` and `fields()`. Values are checked by `section`, rules between
/// keys by the readers.
#include "schema/schema.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::schema {

namespace {

constexpr const char* part_sections[] = {
    "construction",  "glazing",       "boundary",  "zone",
    "zone.surface",  "zone.window",   "zone.flow", "zone.load",
    "plant",         "zone.coupling", "meter",     "construction.layer",
    "zone.radiator", "air_system"};

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

/// Texts that the rows of fields() point into.
const std::vector<std::string>& field_fallbacks() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> made;
        for (const physics::Field& field : physics::fields())
            made.push_back(fmt::format("{}", field.fallback));
        return made;
    }();
    return texts;
}

void append(std::vector<Key>& to, std::span<const Key> from) {
    to.insert(to.end(), from.begin(), from.end());
}

std::vector<Key> job_keys() {
    std::vector<Key> keys;
    append(keys, declared_keys());
    append(keys, simulator_keys());
    for (std::size_t i = 0; i < physics::fields().size(); ++i)
        // A meter's factor is no key of [[meter]]: parameters reach it.
        if (physics::fields()[i].part != physics::Part::meter)
            keys.push_back(key_of(physics::fields()[i], field_fallbacks()[i]));
    return keys;
}

}  // namespace

Table::Table(std::vector<SectionInfo> sections, std::span<const Key> keys)
    : sections_(std::move(sections)) {
    for (const Key& key : keys) keys_[key.section].push_back(key);
    const auto own = keys_;
    for (const SectionInfo& section : sections_)
        if (const auto included = own.find(section.includes); included != own.end())
            append(keys_[section.name], included->second);
}

const SectionInfo* Table::find(std::string_view section) const {
    for (const SectionInfo& each : sections_)
        if (section == each.name) return &each;
    return nullptr;
}

const std::vector<Key>& Table::keys_of(std::string_view section) const {
    static const std::vector<Key> none;
    const auto found = keys_.find(section);
    return found == keys_.end() ? none : found->second;
}

const Key* Table::find(std::string_view section, std::string_view key) const {
    for (const Key& row : keys_of(section))
        if (key == row.key) return &row;
    return nullptr;
}

const Table& job_table() {
    static const Table table({declared_sections().begin(), declared_sections().end()},
                             job_keys());
    return table;
}

const Key* find_key(std::string_view section, std::string_view key) {
    return job_table().find(section, key);
}

const char* section_of(physics::Part part) {
    return part_sections[static_cast<int>(part)];
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
        const bool whole = std::abs(number) < 1e16 && number == std::floor(number);
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
        case Type::words:
            return "a list of texts and numbers";
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
