/// One building of a stock on its worker: read, checked, calibrated, predicted, and what
/// its line of the summary needs taken from its result.
#pragma once

#include "job/stock.hpp"
#include "stock/record.hpp"

namespace bemcal::stock {

struct Calibrated {
    StockRecord record;
    study::Conclusion conclusion;  ///< the building's whole result
};

/// Everything a study does, one item after the other. Throws UserError where the data or
/// description are broken, std::runtime_error where nothing could be simulated.
/// \param before  of the last night, or nullptr: where the calibration starts
/// \param log  every file that was asked for, also where it throws
Calibrated calibrate(const job::Job& stock_job, const job::StockLine& line,
                     const StockRecord* before, std::vector<input::InputFile>& log);

/// Simulations that the study of a building usually takes, where no night has counted
/// them.
double usual_simulations(const job::StudySpec& study);

}  // namespace bemcal::stock
