/// A night over a stock, as a stage: a first round looks which buildings have changed
/// since the last night, the second works on those, the most urgent first.
///
/// Due are new buildings and those whose line, job, version or data have changed, or that
/// were put off before; all others keep what the last night knew. Among the due, those
/// that failed come first, then those put off, those that drift, the others; a budget of
/// simulations, or of hours, ends the night in this order, and the rest is put off.
#pragma once

#include "job/stock.hpp"
#include "stock/record.hpp"

#include <functional>
#include <memory>

namespace bemcal::stock {

struct StockNight {
    std::string version;
    std::vector<StockRecord> before;  ///< of the last night; empty = there was none
    /// Whether the night's hours are over; empty = they never are.
    std::function<bool()> is_over{};
};

/// \param job  must outlive the stage
std::unique_ptr<study::Stage> make_stock_stage(const job::Job& job, StockNight night);

}  // namespace bemcal::stock
