/// Writes the two references of a job file: every key with default, range, sentence and
/// example, and every number that a parameter may name; a section or a kind of study also
/// by itself.
/// Follows from the schema's rows, those of each kind of study, `fields()`, and jobs that
/// a test reads, so text and readers agree. Results and effects are described elsewhere
/// (`describe_results`, `effects::describe`).
#include "job/examples.hpp"
#include "job/kinds.hpp"
#include "schema/schema.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
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

/// Sections that have no heading of their own, and where their examples stand.
struct Host {
    const char *section, *host;
};
constexpr Host hosts[] = {{"job", ""},
                          {"building", ""},
                          {"column", "weather.columns.global_horizontal"},
                          {"source", "series"},
                          {"week", "schedule"},
                          {"prior", "parameter"},
                          {"input", "zone.load"},
                          {"study.ranges", "study.stage"},
                          {"study.set", "study.stage"}};

std::string host_of(const std::string& section) {
    const auto host = std::ranges::find_if(
        hosts, [&](const Host& each) { return section == each.section; });
    return host == std::end(hosts) ? section : host->host;
}

std::string example_text(const std::string& section, const std::string& kind) {
    std::istringstream lines(example_of(host_of(section), kind));
    std::string text = "  Example:\n";
    for (std::string line; std::getline(lines, line);)
        text += line.empty() ? "\n" : fmt::format("    {}\n", line);
    return text;
}

/// Without the keys of a section that it includes, which stand there.
std::string section_text(const schema::SectionInfo& section, const schema::Table& table) {
    std::string text = heading_of(section);
    for (const schema::Key& key : table.keys_of(section.name))
        if (std::string_view(key.section) == section.name) text += line_of(key);
    if (&table == &schema::job_table()) text += example_text(section.name, "");
    return text;
}

bool is_common(const schema::Key& key) {
    return common_table().find(key.section, key.key) != nullptr;
}

/// The keys of a kind and of the sections in it.
std::string kind_text(const Kind& kind) {
    std::string text;
    for (const schema::SectionInfo& section : table_of(kind).sections()) {
        text += heading_of(section);
        for (const schema::Key& key : table_of(kind).keys_of(section.name))
            if (!is_common(key)) text += line_of(key);
        text += example_text(section.name, kind.word);
    }
    return text;
}

/// What all kinds have, then the keys of each by itself.
std::string studies_text() {
    std::string text = section_text(common_table().sections()[0], common_table());
    for (const Kind* kind : kinds()) text += kind_text(*kind);
    return text;
}

bool is_in(std::string_view section, const std::string& topic) {
    return section == topic || section.starts_with(topic + ".");
}

}  // namespace

std::vector<std::string> job_topics() {
    std::vector<std::string> topics;
    for (const Kind* kind : kinds()) topics.emplace_back(kind->word);
    for (const schema::SectionInfo& section : schema::job_table().sections())
        if (std::string_view(section.heading).starts_with('['))
            topics.emplace_back(section.name);
    std::erase(topics, "column");
    return topics;
}

std::string describe_topic(const std::string& topic) {
    if (const Kind* kind = find_kind(topic)) return kind_text(*kind).substr(1);
    if (topic == "study") return studies_text().substr(1);
    std::string text;
    for (const schema::SectionInfo& section : schema::job_table().sections())
        if (is_in(section.name, topic))
            text += section_text(section, schema::job_table());
    return text.substr(text.empty() ? 0 : 1);
}

std::string describe_job() {
    std::string text =
        "A job is a TOML file. Every key, with its default, what is accepted, and what "
        "it means;\n"
        "then examples, in which each key stands once.\n"
        "An unknown key, or one without effect, is an error.\n";
    for (const schema::SectionInfo& section : schema::job_table().sections())
        text += std::string_view(section.name) == "study"
                    ? studies_text()
                    : section_text(section, schema::job_table());
    return text;
}

namespace {

/// "construction.NAME.layer.NAME": where numbers of a part stand in a building.
std::string path_of_part(physics::Part part) {
    std::string section = schema::section_of(part);
    const std::size_t dot = section.find('.');
    if (part == physics::Part::plant) return section;
    if (part == physics::Part::meter) return section + ".QUANTITY";
    if (part == physics::Part::radiator) return "zone.NAME.radiator";
    return dot == std::string::npos
               ? section + ".NAME"
               : fmt::format("{}.NAME{}.NAME", section.substr(0, dot),
                             section.substr(dot));
}

}  // namespace

std::string describe_parameters() {
    std::string text =
        "Every number of a building that a [[parameter]] may name as its target. NAME is "
        "that\n"
        "of the section, * means all; .low after a number is its value outside the "
        "schedule.\n\n";
    for (const physics::Field& field : physics::fields()) {
        text += fmt::format("  {:<46} {:g} to {:g} {}. {}\n",
                            path_of_part(field.part) + "." + field.key, field.least,
                            field.most, field.unit, field.sentence);
    }
    return text + "  effect.NAME: the coefficient of an [[effect]].\n";
}

}  // namespace bemcal::job
