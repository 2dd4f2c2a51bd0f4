/// Writes the two references of a job file: every key with default, range and sentence,
/// and every number that a parameter may name.
/// Follows from the schema's rows and `fields()` alone, so text and readers agree.
/// Results and effects are described elsewhere (`describe_results`, `effects::describe`).
#include "job/job.hpp"
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

}  // namespace

std::string describe_job() {
    std::string text =
        "A job is a TOML file. Every key, with its default, what is accepted, and what "
        "it means.\n"
        "An unknown key, or one without effect, is an error.\n";
    for (const schema::SectionInfo& section : schema::sections()) {
        text += fmt::format("\n{}\n  {}\n", section.heading, section.sentence);
        if (*section.includes != '\0')
            text += fmt::format("  Also all keys of: {}\n", section.includes);
        const std::vector<schema::Key> included = schema::keys_of(section.includes);
        std::vector<schema::Key> keys = schema::keys_of(section.name);
        keys.resize(keys.size() - included.size());  // the included rows stand last
        for (const schema::Key& key : keys) text += line_of(key);
    }
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
