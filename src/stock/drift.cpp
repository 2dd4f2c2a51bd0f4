/// Says what has drifted since the night before: parameters that moved by a share of
/// their range and out of their interval, meters of which both RMSE and CV(RMSE) of the
/// last period are a factor above the first's.
/// Follows from two thresholds of the job; it is no test.
/// Leaves out trends over several nights, and causes.
#include "stock/drift.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

void add(StockRecord& record, const std::string& sentence) {
    record.drift += (record.drift.empty() ? "" : "; ") + sentence;
}

const StockRecord::Fit* fit_of(const StockRecord& record, const std::string& meter,
                               const std::string& period) {
    for (const StockRecord::Fit& fit : record.fits)
        if (fit.meter == meter && fit.period == period) return &fit;
    return nullptr;
}

}  // namespace

void find_drift(const job::StockOptions& options, const StockRecord& before,
                StockRecord& record) {
    for (StockRecord::Value& now : record.values)
        for (const StockRecord::Value& last : before.values) {
            if (last.name != now.name || !(now.most > now.least)) continue;
            now.moved = (now.value - last.value) / (now.most - now.least);
            if (std::abs(now.moved) > options.drift_value &&
                (now.value < last.low || now.value > last.high))
                add(record, fmt::format("{} from {:.4g} to {:.4g} {}", now.name,
                                        last.value, now.value, now.unit));
        }
}

void find_error_drift(const job::StockOptions& options, const StockRecord* before,
                      StockRecord& record) {
    if (record.fits.empty()) return;
    const std::string first = record.fits.front().period,
                      last = record.fits.back().period;
    for (const StockRecord::Fit& now : record.fits) {
        if (now.period != last) continue;
        const StockRecord* reference = first == last ? before : &record;
        const StockRecord::Fit* usual =
            reference == nullptr ? nullptr : fit_of(*reference, now.meter, first);
        // In winter a heat meter's RMSE is above that of a year, its CV(RMSE) below.
        const auto is_above = [&](double is, double was) {
            return is > options.drift_error * was;
        };
        if (usual == nullptr || !is_above(now.rmse(), usual->rmse()) ||
            !is_above(now.cv_rmse, usual->cv_rmse))
            continue;
        add(record, fmt::format("error of {}: RMSE {:.3g} {} in the {}, {:.3g} {}",
                                now.meter, now.rmse(), now.unit,
                                now.period == recent_period ? "last days" : now.period,
                                usual->rmse(),
                                first == last ? "the night before" : "in " + first));
    }
}

}  // namespace bemcal::stock
