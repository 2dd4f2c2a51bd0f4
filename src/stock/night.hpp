/// What a night does with a building that is due: it tests what a loop has found, where
/// there is something and new days have come, and searches only where it does not hold.
#pragma once

#include "stock/calibration.hpp"

namespace bemcal::stock {

/// Status, effects, changes and what is told of them are set. Throws as `calibrate`.
/// \param before   of the last night, or nullptr
/// \param follows  hash of what a loop's findings follow from beside readings
Calibrated work_through(const job::Job& stock_job, const job::StockLine& line,
                        const StockRecord* before, const std::string& follows,
                        std::vector<input::InputFile>& log);

}  // namespace bemcal::stock
