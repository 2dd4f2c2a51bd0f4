/// Cuts the example jobs into sections, from one heading to the next.
/// Follows from TOML's headings, [a.b] and [[a.b]], at the start of a line.
/// Sections that are written in braces stand where they are, in another one.
#include "job/examples.hpp"

#include <vector>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

struct Part {
    std::string_view section;  ///< "" above all headings
    std::string_view kind;     ///< of the study that it is in
    std::string_view text;
};

std::string_view section_of(std::string_view text) {
    if (!text.starts_with('[')) return "";
    const std::size_t first = text.find_first_not_of('[');
    return text.substr(first, text.find(']') - first);
}

std::string_view kind_of(std::string_view study) {
    constexpr std::string_view key = "kind = \"";
    const std::size_t begin = study.find(key) + key.size();
    return study.substr(begin, study.find('"', begin) - begin);
}

/// The part in front, without blank lines behind.
std::string_view first_part(std::string_view text) {
    std::string_view part = text.substr(0, text.find("\n["));
    return part.substr(0, part.find_last_not_of('\n') + 1);
}

std::vector<Part> parts_of(std::string_view text) {
    std::vector<Part> parts;
    std::string_view kind;
    while (!text.empty()) {
        const std::string_view part = first_part(text);
        const std::string_view section = section_of(part);
        if (section == "study") kind = kind_of(part);
        parts.push_back({section, section.starts_with("study") ? kind : "", part});
        const std::size_t next = text.find("\n[");
        text = next == std::string_view::npos ? "" : text.substr(next + 1);
    }
    return parts;
}

}  // namespace

std::string example_of(std::string_view section, std::string_view kind) {
    std::string example;
    for (const ExampleJob& job : example_jobs())
        for (const Part& part : parts_of(job.text))
            if (part.section == section && (kind.empty() || part.kind == kind) &&
                !part.text.empty())
                example += fmt::format("{}{}\n", example.empty() ? "" : "\n", part.text);
    return example;
}

}  // namespace bemcal::job
