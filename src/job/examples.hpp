/// Examples of a job's sections, each a part of a whole job.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bemcal::job {

struct ExampleJob {
    const char* file;
    const char* text;
};

/// Jobs that `check` takes, with every key of the schema.
std::span<const ExampleJob> example_jobs();

/// What they have of a section by its name in the file: "meter", "zone.window"; "" = what
/// stands above all sections. Empty where they have none.
/// \param kind  of a study, to which the section belongs; "" = any
std::string example_of(std::string_view section, std::string_view kind = "");

}  // namespace bemcal::job
