/// One building of a stock on its worker: read, checked, calibrated, predicted, and what
/// its line of the summary needs taken from its result.
#pragma once

#include "job/stock.hpp"
#include "stock/record.hpp"

#include <map>
#include <string>

namespace bemcal::stock {

struct Calibrated {
    StockRecord record;
    study::Conclusion conclusion;  ///< the building's whole result
};

/// Everything a study does, one item after the other. Throws UserError where the data or
/// description are broken, std::runtime_error where nothing could be simulated.
/// \param before  of the last night, or nullptr: where the calibration starts
/// \param log  every file that was asked for, also where it throws
/// \param window  laid over the description; nullptr = its own periods
Calibrated calibrate(const job::Job& stock_job, const job::StockLine& line,
                     const StockRecord* before, std::vector<input::InputFile>& log,
                     const job::Adopted* window = nullptr);

/// A building's job, read with its log of files, also where it throws.
job::Job read_building(const job::Job& stock_job, const job::StockLine& line,
                       std::vector<input::InputFile>& log, const job::Adopted* adopted);

/// The last values of parameters, as far as they still mean something.
std::map<std::string, double> values_in(const StockRecord& before,
                                        const study::Case& building);
void start_from(const std::map<std::string, double>& values, study::Case& building);

/// Of readings, series, registers and weather from the first day to the last of the
/// building's periods.
std::string hash_of_data(const study::Case& building);

/// Daily sums of the first meter of an energy, over the last days with readings.
void sketch(const study::Case& building, StockRecord& record);

/// Simulations that the study of a building usually takes, where no night has counted
/// them.
double usual_simulations(const job::StudySpec& study);

}  // namespace bemcal::stock
