/// Finds inputs of paper 1's hour by their names, and makes rows of the schema of them.
/// Source: paper 1, Table 2, by `office_hour_inputs`.
/// Their ranges are the model's to check.
#include "job/office_hour_inputs.hpp"

#include "input/suggest.hpp"

#include <fmt/format.h>

namespace bemcal::job {

const physics::OfficeHourInput& office_hour_input(const schema::Section& section,
                                                  const std::string& name) {
    std::vector<std::string> names;
    for (const physics::OfficeHourInput& input : physics::office_hour_inputs()) {
        if (name == input.name) return input;
        names.emplace_back(input.name);
    }
    section.fail(name, fmt::format("unknown input{}", input::suggestion(name, names)));
}

schema::Key office_hour_row(const physics::OfficeHourInput& input, schema::Type type) {
    return {"study.fixed", input.name, type, input.unit,
            nullptr,       -1e9,       1e9,  input.sentence};
}

}  // namespace bemcal::job
