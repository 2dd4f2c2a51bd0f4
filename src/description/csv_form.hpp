/// How a section of the job says that a CSV file is to be read (schema: "source"), but
/// for its clock.
#pragma once

#include "input/csv_numbers.hpp"
#include "schema/section.hpp"

namespace bemcal::description {

/// Its lines, and the columns that the section asks for.
input::CsvForm csv_form(const schema::Section& section);

/// Its numbers. Throws UserError (config) where one mark is said to be two.
input::NumberForm number_form(const schema::Section& section);

}  // namespace bemcal::description
