/// What a night over a stock leaves beside its result: RESULT.csv, a line a building,
/// RESULT-changes.csv, a line for each effect that began, ended or changed, and in
/// TITLE-history.csv the same in short for every night.
#pragma once

#include "run/output_names.hpp"
#include "store/result_file.hpp"

namespace bemcal::report {

/// A night that stands in the history already is replaced. Nothing where the result has
/// no stock. Throws UserError where a file cannot be written, or is somebody else's.
void write_stock_files(const run::OutputNames& names, const store::ResultFile& result);

}  // namespace bemcal::report
