/// Meters that no longer send, against those of the others.
#include "stock/stopped.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::stock {
namespace {

/// With readings until the day before that one.
StockRecord until(double day) {
    StockRecord record;
    record.fits = {{"gas", "kWh", "training", 1000, 100, 0.5, 0.2, 0}};
    record.daily_start = day - 180;
    record.daily.assign(180, 1);
    return record;
}

TEST(EndsOfReadings, AreToldAFortnightBeforeThoseOfMost) {
    std::vector<double> ends;
    StockRecord late = until(18628 - 14), stopped = until(18628 - 15), by_month;
    for (const StockRecord& record : {until(18628), until(18628), until(18628),
                                      until(18628), late, stopped, by_month})
        ends.push_back(end_of_readings(record));
    const double middle = middle_end(ends);
    EXPECT_EQ(middle, 18628);
    tell_of_end(middle, late);
    EXPECT_TRUE(late.findings.empty());
    tell_of_end(middle, by_month);
    EXPECT_TRUE(by_month.findings.empty());
    tell_of_end(middle, stopped);
    tell_of_end(middle, stopped);  // the next night
    ASSERT_EQ(stopped.findings.size(), 1U);
    EXPECT_EQ(stopped.findings[0].series, "daily readings");
    EXPECT_EQ(stopped.findings[0].finding,
              "end on 2020-12-16, 15 days before those of most of the stock");
    tell_of_end(0, stopped);  // by the table's own last day
    EXPECT_TRUE(stopped.findings.empty());
    for (const char* status : {"failed", "postponed"}) {
        stopped.status = status;
        tell_of_end(middle, stopped);
        EXPECT_TRUE(stopped.findings.empty()) << status;
    }
    stopped.status = "unchanged";
    StockRecord empty = until(18628);
    for (std::size_t k = 150; k < 180; ++k) empty.daily[k] = NAN;
    tell_of_end(middle, empty);
    EXPECT_EQ(empty.findings.size(), 1U);
    stopped.daily.assign(200, 1);  // it sends again
    tell_of_end(middle, stopped);
    EXPECT_TRUE(stopped.findings.empty());
}

}  // namespace
}  // namespace bemcal::stock
