/// The data of a Kennedy-O'Hagan calibration: measurements and runs of a simulator, from
/// CSV files.
#pragma once

#include "input/input_files.hpp"
#include "posterior/koh_options.hpp"
#include "schema/section.hpp"

#include <string>

namespace bemcal::job {

/// From the files' output to the reported unit.
struct OutputScale {
    double factor = 1, offset = 0;
};

/// The key that names the output of the runs.
const char* key_of_output(const schema::Section& section);

/// Measurements with their known inputs, and the names of both kinds of inputs. Throws
/// UserError for missing cells, and names that cannot be stored.
void read_field(const schema::Section& section, input::InputFiles& files,
                const OutputScale& scale, emulator::Observations& observations);

/// Runs from a file, after the measurements; the calibrated inputs are uniform over their
/// range. Throws UserError for missing cells, repeated runs, columns that the study does
/// not name.
void read_runs(const schema::Section& section, input::InputFiles& files,
               const OutputScale& scale, posterior::KohOptions& options);

}  // namespace bemcal::job
