/// What a night over a stock leaves beside its result: RESULT.csv, a line a building, and
/// in TITLE-history.csv the same in short for every night.
#pragma once

#include "store/result_file.hpp"

#include <filesystem>
#include <optional>

namespace bemcal::report {

struct StockFiles {
    std::filesystem::path table, history;
};

/// A night that stands in the history already is replaced. None where the result has no
/// stock. Throws UserError where a file cannot be written.
std::optional<StockFiles> write_stock_files(const std::filesystem::path& file,
                                            const store::ResultFile& result);

}  // namespace bemcal::report
