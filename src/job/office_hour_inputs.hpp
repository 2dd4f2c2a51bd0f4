/// Inputs of paper 1's single hour that a job names.
#pragma once

#include "physics/office_hour.hpp"
#include "schema/section.hpp"

#include <string>

namespace bemcal::job {

/// An input by its name; throws UserError at that key.
const physics::OfficeHourInput& office_hour_input(const schema::Section& section,
                                                  const std::string& name);

/// A number of the input in the job.
schema::Key office_hour_row(const physics::OfficeHourInput& input, schema::Type type);

}  // namespace bemcal::job
