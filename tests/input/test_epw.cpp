/// EPW files: what is read from good ones, and what is said about bad ones.
#include "base/error.hpp"
#include "support/csv_table.hpp"
#include "support/epw_files.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::parse_time;

const std::string header =
    "LOCATION,Nowhere,-,XXX,Made,000000,50.00,10.00,1.0,300.0\r\n"
    "DESIGN CONDITIONS,0\r\nTYPICAL/EXTREME PERIODS,0\r\nGROUND TEMPERATURES,0\r\n"
    "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\r\nCOMMENTS 1,\r\nCOMMENTS 2,\r\n"
    "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\r\n";

/// One row; the columns that are read can be changed by their number.
using Changes = std::map<int, std::string>;
std::string row(physics::Seconds begin, double temperature, const Changes& changes = {}) {
    const physics::CalendarStep step = physics::calendar_step(begin);
    std::vector<std::string> fields(35, "0");
    fields[0] = std::to_string(step.year);
    fields[1] = std::to_string(step.month);
    fields[2] = std::to_string(step.day);
    fields[3] = std::to_string(step.hour + 1);
    fields[6] = fmt::format("{:.1f}", temperature);
    fields[8] = "50";
    for (int field : {14, 15, 16}) fields[static_cast<std::size_t>(field - 1)] = "100";
    fields[22] = "5";
    for (const auto& [field, text] : changes)
        fields[static_cast<std::size_t>(field - 1)] = text;
    return fmt::format("{}\r\n", fmt::join(fields, ","));
}

/// The hours from the begin of one year to the begin of another; temperature = hour of
/// the day.
std::string rows(int first_year, int last_year,
                 const std::map<int, Changes>& changes = {},
                 const std::function<bool(const physics::CalendarStep&)>& keep = {}) {
    std::string text;
    const physics::Seconds end = parse_time(fmt::format("{}-01-01", last_year + 1));
    int k = 0;
    for (auto t = parse_time(fmt::format("{}-01-01", first_year)); t < end;
         t += std::chrono::hours(1), ++k) {
        const physics::CalendarStep step = physics::calendar_step(t);
        const auto change = changes.find(k);
        if (!keep || keep(step))
            text +=
                row(t, step.hour, change == changes.end() ? Changes{} : change->second);
    }
    return text;
}

bool not_leap_day(const physics::CalendarStep& step) {
    return step.month != 2 || step.day != 29;
}

std::string decisions(const input::EpwFile& file) {
    return fmt::format("{}", fmt::join(file.decisions, "\n"));
}

struct Complaint {
    ExitCode code = ExitCode::ok;
    std::string text = "no complaint";
};

Complaint complaint(const std::function<void()>& call) {
    try {
        call();
    } catch (const UserError& error) {
        return {error.exit_code(), error.what()};
    }
    return {};
}

Complaint complaint_about(const std::string& text) {
    return complaint([&] { test::parse_epw(text, "w.epw"); });
}

void expect_complaint(const std::string& text, const std::string& where,
                      const std::string& what) {
    const Complaint found = complaint_about(text);
    EXPECT_EQ(found.code, ExitCode::data) << found.text;
    EXPECT_EQ(found.text.substr(0, where.size()), where);
    EXPECT_NE(found.text.find(what), std::string::npos) << found.text;
}

TEST(Epw, RowsEndAtTheirHour) {
    input::EpwOptions as_read;
    as_read.temperature = input::TemperatureConvention::as_read;
    const input::EpwFile file =
        test::parse_epw(header + rows(2021, 2021), "w.epw", as_read);
    const physics::Weather& weather = file.weather;
    EXPECT_EQ(file.place, "Nowhere");
    EXPECT_EQ(weather.site.latitude, 50);
    EXPECT_EQ(weather.site.longitude, 10);
    EXPECT_EQ(weather.site.utc_offset_h, 1);
    EXPECT_EQ(weather.site.elevation, 300);
    EXPECT_EQ(weather.axis.start, parse_time("2021-01-01"));
    ASSERT_EQ(weather.axis.n_steps, 8760);
    EXPECT_EQ(weather.theta_e[30], 6);  // the row of hour 7 covers 6:00 to 7:00
    EXPECT_EQ(weather.cloud_cover[0], 0.5);
    EXPECT_EQ(weather.relative_humidity[0], 50);
    EXPECT_TRUE(file.decisions.empty()) << decisions(file);
}

TEST(Epw, HourMeanIsTheDefault) {
    const input::EpwFile file = test::parse_epw(header + rows(2021, 2021), "w.epw");
    EXPECT_EQ(file.weather.theta_e[0], 0);
    EXPECT_EQ(file.weather.theta_e[6], 5.5);
    EXPECT_EQ(file.weather.theta_e[24], 11.5);
}

TEST(Epw, YearsWithAndWithout29February) {
    EXPECT_EQ(test::parse_epw(header + rows(2020, 2020), "w.epw").weather.axis.n_steps,
              8784);
    input::EpwOptions as_read;
    as_read.temperature = input::TemperatureConvention::as_read;
    const std::map<int, Changes> cold{{58 * 24 + 7, {{7, "-40"}}}};  // 28 February, 7:00
    const input::EpwFile file =
        test::parse_epw(header + rows(2020, 2020, cold, not_leap_day), "w.epw", as_read);
    EXPECT_EQ(file.weather.axis.n_steps, 8784);
    EXPECT_EQ(file.weather.theta_e[58 * 24 + 7], -40);
    EXPECT_EQ(file.weather.theta_e[59 * 24 + 7], -40);
    EXPECT_EQ(file.weather.theta_e[60 * 24 + 7], 7);
    EXPECT_EQ(decisions(file), "w.epw: no 29 February 2020: 28 February repeated");
}

TEST(Epw, TypicalYearGetsOneYear) {
    std::string text = rows(2021, 2021);
    for (std::size_t at = 0; (at = text.find("\n2021,7,", at)) != std::string::npos; ++at)
        text.replace(at, 6, "\n1987,");
    const input::EpwFile file = test::parse_epw(header + text, "w.epw");
    EXPECT_EQ(file.weather.axis.start, parse_time("2021-01-01"));
    EXPECT_NE(decisions(file).find("taken as 2021"), std::string::npos);
    input::EpwOptions year;
    year.year = 2030;
    EXPECT_EQ(test::parse_epw(header + text, "w.epw", year).weather.axis.start,
              parse_time("2030-01-01"));
}

TEST(Epw, SeveralYearsInOneFile) {
    EXPECT_EQ(test::parse_epw(header + rows(2019, 2021), "w.epw").weather.axis.n_steps,
              8760 * 3 + 24);
}

TEST(Epw, MissingCodesBecomeMissing) {
    const input::EpwFile file = test::parse_epw(
        header + rows(2021, 2021, {{5, {{9, "999"}, {22, "999."}, {23, "99"}}}}),
        "w.epw");
    EXPECT_TRUE(std::isnan(file.weather.relative_humidity[5]));
    EXPECT_TRUE(std::isnan(file.weather.wind_speed[5]));
    EXPECT_TRUE(std::isnan(file.weather.cloud_cover[5]));
    EXPECT_EQ(file.weather.cloud_cover[6], 0.5);
}

TEST(Epw, ShortGapsOfTemperatureAreInterpolated) {
    input::EpwOptions as_read;
    as_read.temperature = input::TemperatureConvention::as_read;
    const Changes gap{{7, "99.9"}};
    const input::EpwFile file = test::parse_epw(
        header + rows(2021, 2021, {{0, gap}, {9, gap}, {10, gap}, {11, gap}}), "w.epw",
        as_read);
    EXPECT_EQ(file.weather.theta_e[0], 1);
    for (int k = 8; k < 13; ++k)
        EXPECT_EQ(file.weather.theta_e[static_cast<std::size_t>(k)], k);
    EXPECT_EQ(decisions(file),
              "w.epw:9:7: dry bulb temperature: 4 h in 2 gap(s) of at most 3 h "
              "interpolated, the "
              "first here");
}

TEST(Epw, LongGapsAreRefused) {
    std::map<int, Changes> changes;
    for (int k = 9; k < 13; ++k) changes[k] = {{7, "99.9"}};
    expect_complaint(header + rows(2021, 2021, changes),
                     "w.epw:18:7: dry bulb temperature missing",
                     "for 4 h from 2021-01-01 09:00:00");
    changes.clear();
    for (int k = 9; k < 15; ++k) changes[k] = {{14, "9999"}, {16, "9999"}, {23, "99"}};
    expect_complaint(header + rows(2021, 2021, changes),
                     "w.epw:18:14: all irradiance missing",
                     "for 6 h from 2021-01-01 09:00:00");
}

TEST(Epw, GapsAsLongAsIsAskedForAreInterpolated) {
    std::map<int, Changes> changes;
    for (int k = 9; k < 15; ++k) changes[k] = {{7, "99.9"}};
    const std::string text = header + rows(2021, 2021, changes);
    input::EpwOptions options;
    options.temperature = input::TemperatureConvention::as_read;
    options.longest_gap = 6;
    EXPECT_EQ(test::parse_epw(text, "w.epw", options).weather.theta_e[12], 12);
    options.longest_gap = 5;
    EXPECT_NE(
        complaint([&] { test::parse_epw(text, "w.epw", options); })
            .text.find("for 6 h from 2021-01-01 09:00:00 on: expected a value, or a "
                       "gap of at most 5 h; fill_gaps bridges up to 48 h"),
        std::string::npos);
}

/// Without so many lines from the k-th hour on.
std::string without_rows(const std::string& text, int k, int n) {
    std::size_t from = 0;
    for (; k > 0; --k) from = text.find('\n', from) + 1;
    std::size_t to = from;
    for (; n > 0; --n) to = text.find('\n', to) + 1;
    return text.substr(0, from) + text.substr(to);
}

TEST(Epw, HoursWithoutARowAreMissing) {
    const std::string all = rows(2021, 2021);
    input::EpwOptions options;
    options.temperature = input::TemperatureConvention::as_read;
    const input::EpwFile file =
        test::parse_epw(header + without_rows(all, 9, 2), "w.epw", options);
    EXPECT_EQ(file.weather.axis.n_steps, 8760);
    EXPECT_EQ(file.weather.theta_e[10], 10);
    // A day without rows has the sun of the day before.
    options.longest_gap = 48;
    const input::EpwFile day =
        test::parse_epw(header + without_rows(all, 48, 24), "w.epw", options);
    const auto& sun = day.weather.global_horizontal;
    EXPECT_GT(sun[24 + 12], 0);
    for (std::size_t k = 34; k < 38; ++k) EXPECT_EQ(sun[k + 24], sun[k]) << k;
    EXPECT_NE(decisions(file).find("w.epw:18: 2 h in 1 gap have no row, the first from "
                                   "2021-01-01 09:00:00 on: taken as missing"),
              std::string::npos)
        << decisions(file);
    EXPECT_EQ(test::parse_epw(header + without_rows(all, 9, 48), "w.epw", options)
                  .weather.axis.n_steps,
              8760);
    EXPECT_NE(complaint([&] {
                  test::parse_epw(header + without_rows(all, 9, 49), "w.epw", options);
              }).text.find("or at most 48 h behind it"),
              std::string::npos);
}

// Every so manieth hour: a tenth of the rows may be absent.
TEST(Epw, RowsOfAnotherStepAreRefused) {
    const auto without_each = [](int n) {
        std::string all = rows(2021, 2021), kept;
        int k = 0;
        for (std::size_t from = 0; from < all.size(); ++k) {
            const std::size_t to = all.find('\n', from) + 1;
            if (k % n != n - 1) kept += all.substr(from, to - from);
            from = to;
        }
        return header + kept;
    };
    EXPECT_EQ(test::parse_epw(without_each(12), "w.epw").weather.axis.n_steps, 8759);
    EXPECT_NE(
        complaint([&] { test::parse_epw(without_each(10), "w.epw"); })
            .text.find("w.epw:18:2: month 1, day 1, hour 11: expected month 1, day 1, "
                       "hour 10"),
        std::string::npos);
}

TEST(Epw, ShortGapsOfIrradianceAreInterpolatedAndCloudCoverStandsIn) {
    const Changes no_sun{{14, "9999"}, {15, "9999"}, {16, "99999"}, {23, "99"}};
    input::EpwFile file =
        test::parse_epw(header + rows(2021, 2021, {{11, no_sun}, {12, no_sun}}), "w.epw");
    EXPECT_EQ(file.weather.global_horizontal[11], 100);
    EXPECT_NE(decisions(file).find("w.epw:20:14: all irradiance: 2 h in 1 gap(s)"),
              std::string::npos)
        << decisions(file);
    std::map<int, Changes> cloudy;
    for (int k = 0; k < 24; ++k) cloudy[k] = {{14, "9999"}, {15, "9999"}, {16, "9999"}};
    file = test::parse_epw(header + rows(2021, 2021, cloudy), "w.epw");
    EXPECT_GT(file.weather.global_horizontal[11], 100);
    EXPECT_NE(decisions(file).find("global horizontal irradiance derived for 9 h"),
              std::string::npos)
        << decisions(file);
}

TEST(Epw, PartsOfZeroBesideGlobalIrradianceAreDerived) {
    std::map<int, Changes> changes;
    for (int k = 0; k < 8760; ++k) changes[k] = {{15, "0"}, {16, "0"}};
    const input::EpwFile file =
        test::parse_epw(header + rows(2021, 2021, changes), "w.epw");
    EXPECT_GT(file.weather.diffuse_horizontal[12], 0);
    EXPECT_NE(decisions(file).find("diffuse horizontal irradiance derived"),
              std::string::npos);
}

// Of days alone, too: a file that was put together from two.
TEST(Epw, PartsThatAreZeroOnSomeDaysAreDerivedThere) {
    std::map<int, Changes> changes;
    for (int k = 24 * 100; k < 24 * 110; ++k) changes[k] = {{15, "0"}, {16, "0"}};
    const input::EpwFile file =
        test::parse_epw(header + rows(2021, 2021, changes), "w.epw");
    const input::EpwFile whole = test::parse_epw(header + rows(2021, 2021), "w.epw");
    EXPECT_GT(file.weather.diffuse_horizontal[24 * 105 + 12], 0);
    EXPECT_EQ(file.weather.diffuse_horizontal[24 * 99 + 12],
              whole.weather.diffuse_horizontal[24 * 99 + 12]);
    EXPECT_NE(decisions(file).find("direct normal irradiance derived"), std::string::npos)
        << decisions(file);
}

TEST(Epw, OddValuesOfUnneededColumnsAreIgnoredAndReported) {
    const input::EpwFile file =
        test::parse_epw(header + rows(2021, 2021, {{5, {{23, "11"}}}}), "w.epw");
    EXPECT_TRUE(std::isnan(file.weather.cloud_cover[5]));
    EXPECT_NE(
        decisions(file).find("w.epw:14:23: total sky cover: 1 values outside 0 to 10"),
        std::string::npos)
        << decisions(file);
}

TEST(Epw, BadHeaders) {
    const std::string good = header + rows(2021, 2021);
    expect_complaint("", "w.epw:1:1:", "empty");
    expect_complaint("hello", "w.epw:1:1:", "expected 'LOCATION'");
    expect_complaint("LOCATION,Nowhere", "w.epw:1:7: latitude [deg] = ''",
                     "from -90 to 90");
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    expect_complaint(changed("50.00", "fifty"), "w.epw:1:7: latitude [deg] = 'fifty'",
                     "from -90");
    expect_complaint(changed("50.00", "nan"), "w.epw:1:7:", "from -90");
    expect_complaint(changed("10.00", "190"), "w.epw:1:8: longitude", "-180 to 180");
    expect_complaint(changed("DATA PERIODS,1,1", "DATA"),
                     "w.epw:101:1:", "no line 'DATA PERIODS'");
    expect_complaint(header.substr(0, header.find("DATA")),
                     "w.epw:7:1:", "no line 'DATA PERIODS'");
    expect_complaint(changed("PERIODS,1,1", "PERIODS,2,1"),
                     "w.epw:8:2:", "several data periods");
    expect_complaint(changed("PERIODS,1,1", "PERIODS,1,4"), "w.epw:8:3:", "sub-hourly");
}

TEST(Epw, BadRows) {
    expect_complaint(header, "w.epw:8:1: only 0 hours", "8760");
    expect_complaint((header + rows(2021, 2021)).substr(0, 200000),
                     "w.epw:", "is the file cut off");
    expect_complaint(header + rows(2021, 2021, {{4, {{7, "warm"}}}}),
                     "w.epw:13:7: dry bulb temperature = 'warm'",
                     "from -70 to 70 degC, or 99.9");
    expect_complaint(header + rows(2021, 2021, {{4, {{7, "80"}}}}),
                     "w.epw:13:7:", "from -70 to 70");
    expect_complaint(header + rows(2021, 2021, {{4, {{15, "inf"}}}}),
                     "w.epw:13:15:", "direct normal");
    expect_complaint(header + rows(2021, 2021, {{4, {{23, "-"}}}}),
                     "w.epw:13:23:", "sky cover = '-'");
    expect_complaint(header + rows(2021, 2021, {{4, {{4, "0"}}}}), "w.epw:13:4: hour",
                     "from 1 to 24");
    expect_complaint(header + "2021,1,1,1\n", "w.epw:9:4: only 4 fields", "35");
    expect_complaint(header + rows(2021, 2021, {{0, {{3, "32"}}}}), "w.epw:9:3: day",
                     "1 to 31");
}

TEST(Epw, RowsMustFollowEachOther) {
    expect_complaint(header + rows(2021, 2021, {{4, {{4, "4"}}}}),
                     "w.epw:13:2:", "sub-hourly");
    expect_complaint(header + rows(2021, 2021, {{4, {{4, "7"}}}}),
                     "w.epw:13:2: month 1, day 1, hour 7",
                     "expected month 1, day 1, hour 5 of 2021");
    const std::string leap = rows(2020, 2020);
    input::EpwOptions year;
    year.year = 2021;
    const Complaint found =
        complaint([&] { test::parse_epw(header + leap, "w.epw", year); });
    EXPECT_NE(found.text.find("no 29 February: give a leap year"), std::string::npos)
        << found.text;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// Latitude, longitude, time zone and elevation of `header`, whatever its place is.
void expect_place(const std::string& text, const std::string& place) {
    const input::EpwFile file = test::parse_epw(text, "w.epw");
    EXPECT_EQ(file.place, place);
    const physics::Site& site = file.weather.site;
    EXPECT_EQ(site.latitude, 50) << place;
    EXPECT_EQ(site.longitude, 10) << place;
    EXPECT_EQ(site.utc_offset_h, 1) << place;
    EXPECT_EQ(site.elevation, 300) << place;
    EXPECT_TRUE(file.decisions.empty()) << decisions(file);
}

TEST(EpwHeader, APlaceMayHoldCommasInQuotesOrBare) {
    const std::string good = header + rows(2021, 2021);
    expect_place(with(good, "Nowhere", "\"No, where\""), "No, where");
    expect_place(with(good, "Nowhere", "No, where"), "No, where");
    expect_place(with(good, "Nowhere", "No, where, else"), "No, where, else");
    expect_place(with(good, "Nowhere,-", "\"No, where\",\"a, b\""), "No, where");
}

TEST(EpwHeader, LinesMayBeFilledWithCommas) {
    std::string filled = header;
    for (std::size_t at = 0; (at = filled.find("\r\n", at)) != std::string::npos;
         at += 27)
        filled.insert(at, std::string(25, ','));
    expect_place(filled + rows(2021, 2021), "Nowhere");
    expect_place(with(filled, "Nowhere", "No, where") + rows(2021, 2021), "No, where");
}

TEST(EpwHeader, KeyWordsMayBeSmall) {
    expect_place(
        with(with(header, "LOCATION", "Location"), "DATA PERIODS", "Data Periods") +
            rows(2021, 2021),
        "Nowhere");
}

TEST(EpwHeader, AnImpossibleTimeZoneIsRefused) {
    const std::string good = header + rows(2021, 2021);
    expect_complaint(with(good, "1.0,300", "-5.0,300"),
                     "w.epw:1:9: time zone [h] = '-5.0': no place at longitude 10 has it",
                     "longitudes west are negative");
    expect_complaint(with(good, "10.00,1.0", "105.0,-7.0"),
                     "w.epw:1:9:", "no place at longitude 105");
    const auto is_read = [&](const std::string& zone) {
        return complaint_about(with(good, "10.00,1.0", zone)).code == ExitCode::ok;
    };
    EXPECT_TRUE(is_read("75.98,8")) << "Kashgar keeps Beijing's time";
    EXPECT_TRUE(is_read("-157.4,14")) << "Kiritimati, beyond the date line";
    EXPECT_TRUE(is_read("120,0")) << "UTC";
}

TEST(EpwHeader, SemicolonsAreNamed) {
    std::string text = header + rows(2021, 2021);
    std::ranges::replace(text, ',', ';');
    expect_complaint(text, "w.epw:1:1: semicolons (;) between the fields",
                     "expected commas");
}

TEST(EpwHeader, ARowInItsLastLineIsRefused) {
    expect_complaint(with(header, "12/31\r\n", "12/31") + rows(2021, 2021),
                     "w.epw:8:7: the first row stands in the line 'DATA PERIODS'",
                     "a line of its own");
}

TEST(EpwRows, OfCommasAndOldLineEndsAreRead) {
    std::string text = header + rows(2021, 2021) + std::string(34, ',') + "\r\n,,,\r\n";
    expect_place(text, "Nowhere");
    std::erase(text, '\n');
    expect_place(text, "Nowhere");
}

TEST(EpwRows, OfHours0To23AreRefused) {
    expect_complaint(
        header + rows(2021, 2021, {{0, {{4, "0"}}}}),
        "w.epw:9:4: hour (that ends here) = '0': expected a number from 1 to 24",
        "where hours run from 0 to 23, add 1");
}

TEST(EpwRows, OfAPartOfAYearAreRead) {
    const auto until_november = [](const auto& step) { return step.month < 12; };
    const input::EpwFile part =
        test::parse_epw(header + rows(2021, 2021, {}, until_november), "w.epw");
    EXPECT_EQ(part.weather.axis.n_steps, 334 * 24);
    EXPECT_EQ(decisions(part),
              "w.epw:8024: its rows end on 11/30, the header says 12/31: is the file cut "
              "off here?");
    const input::EpwFile said = test::parse_epw(
        with(header, "12/31", "11/30") + rows(2021, 2021, {}, until_november), "w.epw");
    EXPECT_TRUE(said.decisions.empty()) << decisions(said);
}

TEST(EpwRows, HaveNaNAndBlanksWhereAValueIsMissing) {
    input::EpwOptions as_read;
    as_read.temperature = input::TemperatureConvention::as_read;
    for (const char* word : {"NaN", "nan", "", " ", "NA", "null"}) {
        const input::EpwFile file = test::parse_epw(
            header + rows(2021, 2021, {{9, {{7, word}, {14, word}, {22, word}}}}),
            "w.epw", as_read);
        EXPECT_EQ(file.weather.theta_e[9], 9) << word;
        EXPECT_TRUE(std::isnan(file.weather.wind_speed[9])) << word;
    }
}

/// By the sun's height, global = direct normal x its sine + diffuse.
TEST(EpwRows, HaveGlobalIrradianceOfTheOthersWhereItsColumnIsACode) {
    for (const char* code : {"-999", "-9999", "9999"}) {
        std::map<int, Changes> changes;
        for (int k = 0; k < 8760; ++k) changes[k] = {{14, code}, {15, "0"}};
        const input::EpwFile file =
            test::parse_epw(header + rows(2021, 2021, changes), "w.epw");
        EXPECT_EQ(file.weather.global_horizontal[12], 100) << code;
        const bool is_foreign = code[0] == '-';
        EXPECT_EQ(decisions(file).find(fmt::format("w.epw:9:14: global horizontal "
                                                   "irradiance: {} in all hours taken as "
                                                   "missing",
                                                   code)) != std::string::npos,
                  is_foreign)
            << decisions(file);
    }
}

TEST(EpwRows, HaveNoCodesOfOtherFormatsInSingleHours) {
    expect_complaint(header + rows(2021, 2021, {{4, {{14, "-9999"}}}}),
                     "w.epw:13:14: global horizontal irradiance = '-9999'",
                     "or 9999 where it is missing");
    expect_complaint(header + rows(2021, 2021, {{4, {{7, "-999"}}}}),
                     "w.epw:13:7:", "or 99.9 where it is missing");
}

/// January to July and June to December of one year.
TEST(EpwChain, HoursOfTwoFilesAreTakenOnceWhereTheyAreAlike) {
    const auto cut = [](int first, int last, const std::map<int, Changes>& changes = {}) {
        return header + rows(2021, 2021, changes, [=](const auto& step) {
                   return first <= step.month && step.month <= last;
               });
    };
    const std::string a = cut(1, 7), b = cut(6, 12);
    const input::EpwFile chain = input::parse_epw_chain({{"a.epw", a}, {"b.epw", b}});
    const input::EpwFile whole = test::parse_epw(header + rows(2021, 2021), "w.epw");
    EXPECT_EQ(chain.weather.theta_e, whole.weather.theta_e);
    EXPECT_NE(decisions(chain).find("b.epw: 1464 h that the files before it have, too"),
              std::string::npos)
        << decisions(chain);
    // 1 June, the hour from 0:00, is hour 151 x 24 of the year and the first row of b.
    const std::string other = cut(6, 12, {{151 * 24, {{7, "3"}}}});
    EXPECT_EQ(
        complaint([&] { input::parse_epw_chain({{"a.epw", a}, {"b.epw", other}}); }).text,
        "b.epw:9:7: dry bulb temperature is 3 here, but 0 at a.epw:3633:7, for the "
        "same hour (2021-06-01 00:00:00): leave one of them out");
}

class EpwFiles : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) {
        return own_.write(name, text);
    }
    test::TemporaryFolder own_;
    const std::filesystem::path& folder = own_.path();
};

TEST_F(EpwFiles, MayBeGzipped) {
    const auto plain = write("year.epw", header + rows(2021, 2021));
    ASSERT_EQ(std::system(("gzip -k '" + plain.string() + "'").c_str()), 0);
    EXPECT_EQ(test::read_epw(plain.string() + ".gz").weather.theta_e,
              test::read_epw(plain).weather.theta_e);
}

TEST_F(EpwFiles, ThatCannotBeOpened) {
    for (const auto& file : {folder / "absent.epw", folder}) {
        const Complaint found = complaint([&] { test::read_epw(file); });
        EXPECT_EQ(found.code, ExitCode::no_input) << found.text;
        EXPECT_EQ(found.text.rfind(file.string(), 0), 0U);
    }
    const auto empty = write("empty.epw", "");
    const Complaint found = complaint([&] { test::read_epw(empty); });
    EXPECT_EQ(found.code, ExitCode::data);
    EXPECT_NE(found.text.find("is empty"), std::string::npos);
}

TEST_F(EpwFiles, ChainHasNoSeams) {
    const auto a = write("a.epw", header + rows(2019, 2019));
    const auto b = write("b.epw", header + rows(2020, 2020, {}, not_leap_day));
    const auto c = write("c.epw", header + rows(2021, 2021));
    const input::EpwFile chain = test::read_epw_chain({a, b, c});
    EXPECT_EQ(chain.weather.axis.n_steps, 8760 * 3 + 24);
    EXPECT_EQ(chain.weather.theta_e[8760], 11.5);  // mean of 23 and 0 across the seam
    EXPECT_EQ(chain.weather.theta_e.size(), chain.weather.diffuse_horizontal.size());
    EXPECT_EQ(chain.weather.wind_speed.size(), chain.weather.theta_e.size());
    const Complaint reversed = complaint([&] { test::read_epw_chain({b, a}); });
    EXPECT_NE(reversed.text.find("a.epw:9:1: begins at 2019-01-01"), std::string::npos)
        << reversed.text;
}

TEST_F(EpwFiles, ChainOfOneTypicalYearRunsThroughTheYears) {
    const auto file = write("a.epw", header + rows(2019, 2019));
    input::EpwOptions first_year;
    first_year.year = 2022;
    const input::EpwFile chain = test::read_epw_chain({file, file, file}, first_year);
    EXPECT_EQ(chain.weather.axis.start, parse_time("2022-01-01"));
    EXPECT_EQ(chain.weather.axis.end(), parse_time("2025-01-01"));
}

TEST_F(EpwFiles, ChainOfTwoPlacesIsRefused) {
    std::string elsewhere = header + rows(2020, 2020);
    elsewhere.replace(elsewhere.find("50.00"), 5, "51.00");
    const auto a = write("a.epw", header + rows(2019, 2019)),
               b = write("b.epw", elsewhere);
    EXPECT_NE(complaint([&] { test::read_epw_chain({a, b}); }).text.find("another place"),
              std::string::npos);
}

TEST_F(EpwFiles, GapInTheSecondFileNamesThatFile) {
    std::map<int, Changes> changes;
    for (int k = 2; k < 8; ++k) changes[k] = {{7, "99.9"}};
    const auto a = write("a.epw", header + rows(2019, 2019));
    const auto b = write("b.epw", header + rows(2020, 2020, changes));
    EXPECT_NE(complaint([&] { test::read_epw_chain({a, b}); }).text.find("b.epw:11:7:"),
              std::string::npos);
}

/// Cut, changed and repeated bytes of a good file: a message or a result, nothing else.
TEST(Epw, AnyBytesAreAnsweredWithAMessage) {
    const std::string good = header + rows(2021, 2021);
    std::mt19937 random(1);
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(random()) % n;
    };
    int n_read = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::string text = good;
        for (std::size_t k = below(4); k > 0; --k)
            text[below(trial % 2 ? 3000 : text.size())] = static_cast<char>(random());
        if (trial % 5 == 0) text.resize(below(text.size()));
        if (trial % 7 == 0)
            text.insert(below(2000), text.substr(below(1000), below(300)));
        const Complaint found = complaint_about(text);
        EXPECT_TRUE(found.code == ExitCode::ok || found.code == ExitCode::data);
        n_read += found.code == ExitCode::ok;
    }
    EXPECT_GT(n_read, 0);
}

struct Expected {
    const char* name;
    int hours;
    double temperature;      // mean as read [degC]
    double global, diffuse;  // annual [kWh/m2]
};

// Sums and means of the files' columns, by a spreadsheet's way.
const Expected files[] = {
    {"725650TYCST.epw", 8760, 10.875342, 1670.220, 556.451},
    {"CHN_Guangdong.Shaoguan.590820_CSWD.epw", 8760, 20.303037, 1175.017, 785.238},
    {"CHN_Hong.Kong.SAR.450070_CityUHK.epw", 8760, 23.102317, 1305.781, 751.790},
    {"DRYCOLDTMY.epw", 8760, 9.705696, 1831.945, 500.528},
    {"GBR_Birmingham.035340_IWEC.epw", 8760, 9.686324, 1025.951, 670.434},
    {"Golden_CO_2012_AMY.epw", 8784, 12.594866, 1755.413, 584.196},
    {"ITA_Venezia-Tessera.161050_IGDG.epw", 8760, 13.143619, 1102.152, 584.928},
    {"USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw", 8760, 9.987991, 1406.647, 660.253},
};

TEST(Epw, RealFiles) {
    for (const Expected& expected : files) {
        const auto file = test::shared_file(std::string("weather/") + expected.name);
        if (test::is_absent(file)) GTEST_SKIP() << file;
        input::EpwOptions as_read;
        as_read.temperature = input::TemperatureConvention::as_read;
        const input::EpwFile read = test::read_epw(file, as_read);
        const auto sum = [](const std::vector<double>& series) {
            double total = 0;
            for (double v : series) total += v;
            return total;
        };
        ASSERT_EQ(read.weather.axis.n_steps, expected.hours) << expected.name;
        EXPECT_NEAR(sum(read.weather.theta_e) / expected.hours, expected.temperature,
                    1e-5)
            << expected.name;
        EXPECT_NEAR(sum(read.weather.global_horizontal) / 1000, expected.global, 2e-3)
            << expected.name;
        EXPECT_NEAR(sum(read.weather.diffuse_horizontal) / 1000, expected.diffuse, 2e-3)
            << expected.name;
        std::cout << expected.name << ": " << decisions(read) << '\n';
    }
}

/// A real file as editors, spreadsheets and vendors leave it.
TEST(Epw, RealFilesAreReadInOtherForms) {
    const auto path = test::shared_file("weather/GBR_Birmingham.035340_IWEC.epw");
    if (test::is_absent(path)) GTEST_SKIP() << path;
    std::ostringstream stream;
    stream << std::ifstream(path, std::ios::binary).rdbuf();
    const std::string text = stream.str();
    const physics::Weather whole = test::parse_epw(text, "w.epw").weather;
    const auto expect_same = [&](const std::string& form) {
        const physics::Weather weather = test::parse_epw(form, "w.epw").weather;
        EXPECT_EQ(weather.site.latitude, 52.45);
        EXPECT_EQ(weather.site.longitude, -1.73);
        EXPECT_EQ(weather.site.elevation, 99);
        EXPECT_EQ(weather.theta_e, whole.theta_e);
        EXPECT_EQ(weather.global_horizontal, whole.global_horizontal);
    };
    expect_same(with(text, "BIRMINGHAM", "Birmingham, West Midlands"));
    expect_same(with(text, "BIRMINGHAM", "\"Birmingham, West Midlands\""));
    expect_same(with(with(text, "LOCATION", "Location"), "DATA PERIODS", "Data Periods"));
    expect_same(with(text, ",99.0\n", ",99.0,,,,,,,,,,\n") + std::string(34, ',') + "\n");
    std::string old = text;
    std::ranges::replace(old, '\n', '\r');
    expect_same(old);
    const std::string june = text.substr(0, text.find("\n", text.find(",6,30,24,")) + 1);
    const input::EpwFile half = test::parse_epw(june, "w.epw");
    EXPECT_EQ(half.weather.axis.n_steps, 181 * 24);
    EXPECT_TRUE(std::equal(half.weather.theta_e.begin(), half.weather.theta_e.end(),
                           whole.theta_e.begin()));
    EXPECT_NE(decisions(half).find("its rows end on 6/30, the header says 12/31"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
