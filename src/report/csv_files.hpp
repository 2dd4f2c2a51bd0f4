/// Every dataset of a result as CSV files, for spreadsheets and statistics programs.
///
/// FOLDER/BUILDING/STUDY/DIMENSION.csv has a row for each place on that dimension and the
/// datasets that lead with it as columns, named "dataset place place [unit]" by the
/// coordinates of their other dimensions. Where that would be too many columns, a file
/// DIMENSION-DIMENSION.csv has a row for each combination. values.csv has what is single.
#pragma once

#include "store/result_file.hpp"

#include <filesystem>

namespace bemcal::report {

/// Throws UserError (cannot_create) where the folder has something in it already, and
/// (data) where the result is damaged.
/// \return number of files
int write_csv_files(const store::ResultFile& result, const std::filesystem::path& folder);

}  // namespace bemcal::report
