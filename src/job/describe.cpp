/// Writes the two references of a job file: every key with default, range and sentence,
/// and every number that a parameter may name.
/// Follows from the schema's rows, those of each kind of study, and `fields()` alone, so
/// text and readers agree. Results and effects are described elsewhere
/// (`describe_results`, `effects::describe`).
#include "job/kinds.hpp"
#include "schema/schema.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

std::string default_of(const schema::Key& key) {
    if (key.fallback == nullptr) return "required";
    if (*key.fallback == '\0') return "optional";
    return fmt::format("default {}", key.fallback);
}

std::string line_of(const schema::Key& key) {
    return fmt::format("  {:<24} {:<10} {}{}{}\n", key.key, default_of(key),
                       schema::expectation(key), *key.sentence != '\0' ? ". " : "",
                       key.sentence);
}

std::string heading_of(const schema::SectionInfo& section) {
    const std::string text =
        fmt::format("\n{}\n  {}\n", section.heading, section.sentence);
    return *section.includes == '\0'
               ? text
               : text + fmt::format("  Also all keys of: {}\n", section.includes);
}

/// Without the keys of a section that it includes, which stand there.
std::string section_text(const schema::SectionInfo& section, const schema::Table& table) {
    std::string text = heading_of(section);
    for (const schema::Key& key : table.keys_of(section.name))
        if (std::string_view(key.section) == section.name) text += line_of(key);
    return text;
}

bool is_common(const schema::Key& key) {
    return common_table().find(key.section, key.key) != nullptr;
}

/// What all kinds have, then the keys of each by itself.
std::string studies_text() {
    std::string text = section_text(common_table().sections()[0], common_table());
    for (const Kind* kind : kinds())
        for (const schema::SectionInfo& section : table_of(*kind).sections()) {
            text += heading_of(section);
            for (const schema::Key& key : table_of(*kind).keys_of(section.name))
                if (!is_common(key)) text += line_of(key);
        }
    return text;
}

}  // namespace

std::string describe_job() {
    std::string text =
        "A job is a TOML file. Every key, with its default, what is accepted, and what "
        "it means.\n"
        "An unknown key, or one without effect, is an error.\n";
    for (const schema::SectionInfo& section : schema::job_table().sections())
        text += std::string_view(section.name) == "study"
                    ? studies_text()
                    : section_text(section, schema::job_table());
    return text;
}

std::string describe_parameters() {
    std::string text =
        "Every number of a building that a [[parameter]] may name as its target. NAME is "
        "that\n"
        "of the section, * means all; .low after a number is its value outside the "
        "schedule.\n\n";
    for (const physics::Field& field : physics::fields()) {
        std::string path = schema::section_of(field.part);
        if (const std::size_t dot = path.find('.'); dot != std::string::npos)
            path = fmt::format("zone.NAME{}.NAME", path.substr(dot));
        else if (field.part != physics::Part::plant)
            path += ".NAME";
        text += fmt::format("  {:<46} {:g} to {:g} {}. {}\n", path + "." + field.key,
                            field.least, field.most, field.unit, field.sentence);
    }
    return text;
}

}  // namespace bemcal::job
