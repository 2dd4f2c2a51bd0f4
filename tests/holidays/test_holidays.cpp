/// Calendars of countries, against dates that their governments published.
#include "holidays/countries.hpp"
#include "holidays/holidays.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::holidays {
namespace {

std::set<std::string> dates_of(const std::string& country, const std::string& state,
                               int year) {
    std::set<std::string> dates;
    for (const Holiday& holiday : holidays_of(country, state, year))
        dates.insert(physics::format_date(holiday.date).substr(5));
    return dates;
}

using Dates = std::set<std::string>;

bool has(const std::string& country, const char* date, const std::string& state = "") {
    return dates_of(country, state, std::stoi(date)).contains(date + 5);
}

TEST(Holidays, OfTheUnitedStatesIn2021AreTheFederalOnes) {
    EXPECT_EQ(
        dates_of("US", "", 2021),
        (Dates{"01-01", "01-18", "02-15", "05-31", "06-18", "06-19", "07-04", "07-05",
               "09-06", "10-11", "11-11", "11-25", "12-24", "12-25", "12-31"}));
}

TEST(Holidays, OnAWeekendHaveADayOff) {
    for (const Holiday& holiday : holidays_of("US", "", 2021)) {
        const std::string date = physics::format_date(holiday.date);
        const bool off = date == "2021-06-18" || date == "2021-07-05" ||
                         date == "2021-12-24" || date == "2021-12-31";
        EXPECT_EQ(holiday.is_substitute, off) << date;
    }
}

TEST(Holidays, OfNextYearMayHaveTheirDayOffInThisOne) {
    const auto days = holidays_of("US", "", 2021);
    EXPECT_EQ(days.back().name, "New Year's Day");
    EXPECT_FALSE(has("US", "2021-12-30"));
}

TEST(Holidays, AreInTheOrderOfTheirDates) {
    for (const Country& country : countries())
        EXPECT_TRUE(std::ranges::is_sorted(holidays_of(country.code, "", 2022), {},
                                           &Holiday::date))
            << country.code;
}

TEST(Holidays, OfTheUnitedKingdomHoldOneOffDays) {
    for (const char* date : {"2011-04-29", "2012-06-04", "2012-06-05", "2020-05-08",
                             "2022-06-02", "2022-06-03", "2022-09-19", "2023-05-08"})
        EXPECT_TRUE(has("GB", date)) << date;
    for (const char* date : {"2012-05-28", "2020-05-04", "2022-05-30"})
        EXPECT_FALSE(has("GB", date)) << date;
}

TEST(Holidays, OfTheUnitedKingdomDifferByNation) {
    EXPECT_EQ(dates_of("GB", "", 2021), dates_of("GB", "ENG", 2021));
    EXPECT_EQ(dates_of("GB", "SCT", 2022),
              (Dates{"01-01", "01-02", "01-03", "01-04", "04-15", "05-02", "06-02",
                     "06-03", "08-01", "09-19", "11-30", "12-25", "12-26", "12-27"}));
    EXPECT_TRUE(has("GB", "2021-07-12", "NIR"));
    EXPECT_FALSE(has("GB", "2021-07-12", "WLS"));
}

TEST(Holidays, OfGermanyDifferByLand) {
    EXPECT_EQ(dates_of("DE", "", 2021).size(), 9U);
    EXPECT_TRUE(has("DE", "2021-06-03", "BY"));
    EXPECT_FALSE(has("DE", "2021-06-03", "BE"));
    EXPECT_TRUE(has("DE", "2017-10-31"));
    EXPECT_FALSE(has("DE", "2016-10-31"));
    EXPECT_TRUE(has("DE", "2022-11-16", "SN"));
}

TEST(Holidays, OfChinaAreTheNoticesOfTheStateCouncil) {
    EXPECT_EQ(
        dates_of("CN", "", 2021),
        (Dates{"01-01", "02-11", "02-12", "02-13", "02-14", "02-15", "02-16", "02-17",
               "04-04", "04-05", "05-01", "05-03", "05-04", "05-05", "06-14", "09-20",
               "09-21", "10-01", "10-02", "10-03", "10-04", "10-05", "10-06", "10-07"}));
    EXPECT_EQ(
        dates_of("CN", "", 2024),
        (Dates{"01-01", "02-10", "02-11", "02-12", "02-13", "02-14", "02-15", "02-16",
               "02-17", "04-04", "04-05", "05-01", "05-02", "05-03", "06-10", "09-16",
               "09-17", "10-01", "10-02", "10-03", "10-04", "10-05", "10-06", "10-07"}));
    EXPECT_TRUE(has("CN", "2018-12-31"));
    EXPECT_TRUE(has("CN", "2015-09-03"));
}

TEST(Holidays, OfHongKongIn2021AreTheGazettedOnes) {
    EXPECT_EQ(dates_of("HK", "", 2021),
              (Dates{"01-01", "02-12", "02-13", "02-15", "04-02", "04-03", "04-05",
                     "04-06", "05-01", "05-19", "06-14", "07-01", "09-22", "10-01",
                     "10-14", "12-25", "12-27"}));
}

TEST(Holidays, OfJapanHoldADayBetweenTwo) {
    EXPECT_TRUE(has("JP", "2015-09-22"));
    for (const char* date : {"2019-04-30", "2019-05-01", "2019-05-02", "2019-05-06"})
        EXPECT_TRUE(has("JP", date)) << date;
    EXPECT_EQ(dates_of("JP", "", 2021),
              (Dates{"01-01", "01-11", "02-11", "02-23", "03-20", "04-29", "05-03",
                     "05-04", "05-05", "07-22", "07-23", "08-08", "08-09", "09-20",
                     "09-23", "11-03", "11-23"}));
}

TEST(Holidays, OfKoreaHaveTheirDaysOffSince2014) {
    EXPECT_EQ(dates_of("KR", "", 2023),
              (Dates{"01-01", "01-21", "01-22", "01-23", "01-24", "03-01", "05-05",
                     "05-27", "05-29", "06-06", "08-15", "09-28", "09-29", "09-30",
                     "10-02", "10-03", "10-09", "12-25"}));
    for (const char* date :
         {"2014-09-10", "2017-10-06", "2021-08-16", "2025-05-06", "2025-10-08"})
        EXPECT_TRUE(has("KR", date)) << date;
}

TEST(Holidays, OfTaiwanAreThePublishedOnes) {
    EXPECT_EQ(
        dates_of("TW", "", 2024),
        (Dates{"01-01", "02-08", "02-09", "02-10", "02-11", "02-12", "02-13", "02-14",
               "02-28", "04-04", "04-05", "05-01", "06-10", "09-17", "10-10"}));
    EXPECT_TRUE(has("TW", "2022-09-09"));
}

TEST(Holidays, OfSingaporeIn2023AreTheMinistrysList) {
    EXPECT_EQ(
        dates_of("SG", "", 2023),
        (Dates{"01-01", "01-02", "01-22", "01-23", "01-24", "04-07", "04-22", "05-01",
               "06-02", "06-29", "08-09", "09-01", "11-12", "11-13", "12-25"}));
}

TEST(Holidays, OfRomaniaLatviaMaltaAndCyprusAreThoseOfTheirLaws) {
    EXPECT_EQ(
        dates_of("RO", "", 2021),
        (Dates{"01-01", "01-02", "01-24", "04-30", "05-01", "05-02", "05-03", "06-01",
               "06-20", "06-21", "08-15", "11-30", "12-01", "12-25", "12-26"}));
    EXPECT_EQ(dates_of("LV", "", 2018),
              (Dates{"01-01", "03-30", "04-01", "04-02", "04-30", "05-01", "05-04",
                     "05-13", "05-20", "06-23", "06-24", "07-08", "07-09", "09-24",
                     "11-18", "11-19", "12-24", "12-25", "12-26", "12-31"}));
    EXPECT_EQ(dates_of("MT", "", 2021).size(), 14U);
    EXPECT_TRUE(has("MT", "2021-04-02"));
    EXPECT_EQ(
        dates_of("CY", "", 2021),
        (Dates{"01-01", "01-06", "03-15", "03-25", "04-01", "04-30", "05-01", "05-02",
               "05-03", "06-21", "08-15", "10-01", "10-28", "12-25", "12-26"}));
}

TEST(Countries, StandInTheOrderOfTheirCodes) {
    ASSERT_EQ(countries().size(), country_codes.size());
    for (std::size_t k = 0; k < country_codes.size(); ++k)
        EXPECT_STREQ(countries()[k].code, country_codes[k]);
}

TEST(Countries, KnowEveryStateThatARowNames) {
    for (const Country& country : countries()) {
        const auto known = words_of(country.states);
        for (const Row& row : country.rows) {
            std::string_view list = row.states;
            if (list.starts_with('!')) list.remove_prefix(1);
            for (const std::string_view state : words_of(list))
                EXPECT_TRUE(std::ranges::find(known, state) != known.end())
                    << country.code << " " << row.name << " " << state;
        }
    }
}

std::string complaint(const std::string& country, const std::string& state, int year) {
    try {
        holidays_of(country, state, year);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Countries, ThatAreUnknownAreNamedWithThoseThatAreNot) {
    EXPECT_TRUE(
        complaint("XX", "", 2021).starts_with("'XX': expected a country, one of AT, AU"));
    EXPECT_EQ(complaint("GB", "CON", 2021), "'CON': expected one of ENG, NIR, SCT, WLS");
    EXPECT_EQ(complaint("AT", "W", 2021),
              "'W': AT is known as a whole only; leave it out");
    EXPECT_EQ(complaint("SG", "", 2035),
              "the days of SG are known from 2001 to 2030, not of 2035");
}

TEST(Describe, PrintsALineForEachDay) {
    EXPECT_TRUE(
        describe("NO", "2021").starts_with("2021-01-01 Fri  Første nyttårsdag\n"));
    EXPECT_NE(describe("US-CA", "2020-2021").find("2021-03-31 Wed  Cesar Chavez Day\n"),
              std::string::npos);
    EXPECT_NE(
        describe("GB", "2021").find("2021-12-27 Mon  Christmas Day (day off for it)\n"),
        std::string::npos);
    EXPECT_THROW(describe("US", "21"), std::invalid_argument);
    EXPECT_THROW(describe("US", "2020-"), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::holidays
