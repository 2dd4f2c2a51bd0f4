/// [[meter]] with interval = "monthly": months, bills between read dates, estimated
/// reads; and days that begin at another hour.
#include "job/small_office.hpp"
#include "study/case.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::Interval;
using physics::parse_time;

const std::string meter_keys =
    "file = \"measured.csv\"\ncolumn = \"elec_kWh\"\nunit = \"kWh\"\nstamp = \"end\"\n"
    "mask = [\"2021-01-20/2021-01-21\"]\n";

study::Case read_with(const std::string& file_text, const std::string& keys,
                      const std::string& interval = "monthly") {
    const Folder folder;
    folder.write("bills.csv", file_text);
    const std::string text =
        replaced(small_office_text(), meter_keys,
                 "file = \"bills.csv\"\ncolumn = \"x\"\nunit = \"kWh\"\ninterval = \"" +
                     interval + "\"\n" + keys);
    return read_job(write_small_office(folder, text)).buildings[0];
}

/// What the training period, January 2021, holds of the first meter.
std::vector<double> readings_of(const study::Case& building) {
    return study::readings_of(building, building.periods[0])[0].values;
}

TEST(MeterBills, OfTheCalendarAreMonths) {
    const auto building = read_with("t,x\n2021-01-01,310\n2021-02-01,280\n", "");
    EXPECT_FALSE(building.meters[0].interval.are_own());
    EXPECT_EQ(readings_of(building), (std::vector<double>{310}));
}

TEST(MeterBills, BetweenReadDatesAreHeldAgainstTheirOwnTime) {
    const auto building = read_with(
        "from,to,x\n2020-12-20,2021-01-04,9\n2021-01-04,2021-01-13,90\n"
        "2021-01-13,2021-01-27,140\n2021-01-27,2021-02-03,70\n",
        "from = \"from\"\nto = \"to\"\n");
    const study::Meter& meter = building.meters[0];
    ASSERT_TRUE(meter.interval.are_own());
    EXPECT_EQ(meter.interval, Interval::monthly);
    EXPECT_EQ(meter.interval.bounds.size(), 5U);
    const auto found = readings_of(building);
    ASSERT_EQ(found.size(), 4U);  // the first and the last are cut by the period
    EXPECT_TRUE(std::isnan(found[0]));
    EXPECT_EQ(found[1], 90);
    EXPECT_EQ(found[2], 140);
    EXPECT_TRUE(std::isnan(found[3]));
}

TEST(MeterBills, OfOneColumnAreReadFromStampToStampAndTold) {
    const auto building =
        read_with("t,x\n2020-12-12,1\n2021-01-03,2\n2021-01-29,3\n2021-03-05,\n", "");
    EXPECT_EQ(building.meters[0].interval.bounds,
              (std::vector{parse_time("2020-12-12"), parse_time("2021-01-03"),
                           parse_time("2021-01-29"), parse_time("2021-03-05")}));
    EXPECT_TRUE(std::ranges::any_of(building.decisions, [](const auto& decision) {
        return decision.series == "stamps of electricity" &&
               decision.finding == "its rows are no intervals of the calendar" &&
               decision.action == "read as 3 bills, each over its own time";
    }));
}

TEST(MeterBills, EstimatedMonthsBecomeOneWithTheNextThatWasRead) {
    const auto building =
        read_with("t,x,estimated\n2020-12-01,1,0\n2021-01-01,100,1\n2021-02-01,200,0\n",
                  "estimated = \"estimated\"\n");
    EXPECT_EQ(building.meters[0].interval.bounds.size(), 3U);
    // January and February together reach beyond the period.
    EXPECT_TRUE(std::isnan(readings_of(building)[0]));
}

TEST(MeterBills, CodesAreMaskedAndARegistersRiseIsTold) {
    std::string codes = "t,x\n", counts = codes;
    for (int month = 1; month <= 11; ++month) {
        codes +=
            fmt::format("2021-{:02}-01,{}\n", month, month == 3 ? -9999 : 300 + month);
        counts += fmt::format("2021-{:02}-01,{}\n", month, 5000 + 310 * month);
    }
    const auto masked = read_with(codes, "");
    EXPECT_EQ(readings_of(masked), (std::vector<double>{301}));
    EXPECT_TRUE(std::isnan(masked.meters[0].values.at(59 * 24)));
    EXPECT_EQ(masked.meters[0].values.at(90 * 24), 304);
    const auto told = [](const study::Case& building, const std::string& finding) {
        return std::ranges::any_of(building.decisions, [&](const auto& decision) {
            return decision.finding.starts_with(finding);
        });
    };
    EXPECT_TRUE(told(masked, "1 reading of -9999, a code for missing"));
    EXPECT_TRUE(told(read_with(counts, ""),
                     "its bills rise 10 times and never fall: perhaps what a register"));
}

// Reads on the 5th, one estimated and one missing: the use runs on over both. The meter
// is changed in May, and counts again from 0.
TEST(MeterBills, OfARegisterAreFromReadToRead) {
    const auto building = read_with(
        "t,x,estimated\n"
        "2020-12-05,9000,0\n2021-01-05,9310,0\n"
        "2021-02-05,9500,1\n2021-03-05,,0\n"
        "2021-04-05,10150,0\n2021-05-05,120,0\n",
        "register = \"difference\"\nestimated = "
        "\"estimated\"\n");
    const study::Meter& meter = building.meters[0];
    EXPECT_EQ(meter.interval.bounds,
              (std::vector{parse_time("2020-12-05"), parse_time("2021-01-05"),
                           parse_time("2021-04-05"), parse_time("2021-05-05")}));
    EXPECT_EQ(meter.values.at(0), 310);
    EXPECT_EQ(meter.values.at(31 * 24), 840);
    EXPECT_EQ(meter.values.at((31 + 90) * 24), 120);
    EXPECT_TRUE(std::ranges::any_of(building.decisions, [](const auto& decision) {
        return decision.finding == "2 of its reads are missing or estimated";
    }));
    EXPECT_THROW(read_with("t,e,x\n2021-01-01,2021-01-31,10\n2021-02-01,2021-02-28,20\n",
                           "register = \"difference\"\nfrom = \"t\"\nto = \"e\"\n"),
                 UserError);
    EXPECT_THROW(read_with("t,x\n2021-01-01,10\n", "register = \"difference\"\n"),
                 UserError);
    EXPECT_THROW(read_with("t,x\n2021-01-05 10:00,10\n2021-02-05 10:00,20\n"
                           "2021-03-05 10:00,30\n2021-03-05 10:20,40\n",
                           "register = \"difference\"\n"),
                 UserError);
}

TEST(MeterBills, OneBelowZeroIsMaskedAndMoreAreAskedAbout) {
    const std::string one = "t,x\n2021-01-01,300\n2021-02-01,-120\n2021-03-01,280\n";
    const auto february = [](const study::Case& building) {
        return building.meters[0].values.at(31 * 24);
    };
    const auto building = read_with(one, "");
    EXPECT_TRUE(std::isnan(february(building)));
    EXPECT_TRUE(std::ranges::any_of(building.decisions, [](const auto& decision) {
        return decision.finding ==
                   "1 reading below 0, down to -120, the first from 2021-02-01 00:00:00" &&
               decision.action == "masked; negative = \"keep\" would keep them";
    }));
    EXPECT_EQ(february(read_with(one, "negative = \"keep\"\n")), -120);
    const std::string two = one + "2021-04-01,-90\n";
    try {
        read_with(two, "");
        FAIL() << "two bills below 0 were read";
    } catch (const UserError& error) {
        EXPECT_NE(std::string(error.what())
                      .find("bills.csv:3:x: -120, and 2 of 4 readings are below 0"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_TRUE(std::isnan(february(read_with(two, "negative = \"missing\"\n"))));
}

TEST(MeterBills, DaysOfGasBeginAtSix) {
    std::string file = "t,x\n";
    for (int day = 0; day < 59; ++day)
        file += fmt::format(
            "{},{}\n",
            physics::format_time(parse_time("2021-01-01 06:00") + std::chrono::days(day)),
            day);
    // The made readings rise from day to day, as a register's do.
    const auto building = read_with(file, "register = \"keep\"\n", "daily");
    ASSERT_TRUE(building.meters[0].interval.are_own());
    const auto found = readings_of(building);
    ASSERT_EQ(found.size(), 32U);  // six hours, 30 days, 18 hours
    EXPECT_TRUE(std::isnan(found[0]));
    EXPECT_EQ(found[1], 0);
    EXPECT_EQ(found[30], 29);
    EXPECT_TRUE(std::isnan(found[31]));
}

TEST(MeterBills, RowsLongerThanTheIntervalAreRefused) {
    const Folder folder;
    folder.write("bills.csv", "t,x\n2021-01-01,310\n2021-02-01,280\n");
    const std::string text =
        replaced(small_office_text(), meter_keys,
                 "file = \"bills.csv\"\ncolumn = \"x\"\nunit = \"kWh\"\n");
    EXPECT_NE(
        message_of(write_small_office(folder, text)).find("meter.interval: is hourly"),
        std::string::npos);
}

/// Months by their last days, of which some are estimated: a building of New York.
TEST(MeterBills, OfNewYorkAreReadWithTheirEstimates) {
    const std::filesystem::path path =
        BEMCAL_ROOT "/../shared/data/nyc_bills/retrofit_monthly.csv";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    std::istringstream lines(text_of(path));
    std::string line, file = "end_date,x,estimated\n";
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        if (cells[0] == "846152" && cells[1] == "Elec" && cells[2] == "2015")
            file += cells[3] + "," + cells[4] + "," + cells[7] + "\n";
    }
    const Folder folder;
    folder.write("bills.csv", file);
    std::string text = replaced(
        small_office_text(), meter_keys,
        "file = \"bills.csv\"\ncolumn = \"x\"\nunit = \"kWh\"\ninterval = \"monthly\"\n");
    text = replaced(text, "training = [\"2021-01-01\", \"2021-01-31\"]",
                    "training = [\"2015-01-01\", \"2015-01-31\"]");
    text = replaced(text, "held_out = [\"2021-02-01\", \"2021-02-28\"]\n", "");
    const auto job = write_small_office(folder, text);
    std::string weather = small_weather();
    for (std::size_t at = weather.find("\n2021"); at != std::string::npos;
         at = weather.find("\n2021"))
        weather.replace(at, 5, "\n2015");
    folder.write("weather.csv", weather);
    std::string measured = small_readings();
    for (std::size_t at = measured.find("\n2021"); at != std::string::npos;
         at = measured.find("\n2021"))
        measured.replace(at, 5, "\n2015");
    folder.write("measured.csv", measured);
    const study::Case building = read_job(job).buildings[0];
    EXPECT_FALSE(building.meters[0].interval.are_own());
    EXPECT_EQ(building.meters[0].axis.start, parse_time("2014-10-01"));
    EXPECT_NEAR(building.meters[0].values[0], 1537.81979978, 1e-6);
    EXPECT_TRUE(std::ranges::any_of(building.decisions, [](const auto& decision) {
        return decision.finding == "its stamps are the last days of months";
    }));
}

}  // namespace
}  // namespace bemcal::job
