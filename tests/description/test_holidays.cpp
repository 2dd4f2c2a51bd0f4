/// Days off as a job says them: a list, or a country with its state and more days.
#include "job/small_office.hpp"
#include "job/stock.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char* list_of_days =
    "holidays = [\"01-01/01-03\", \"2021-10-01/2021-10-07\"]\n";

/// The sample with another text in place of its list of days.
class Office {
  public:
    explicit Office(const std::string& days)
        : path_(write_small_office(folder_,
                                   replaced(small_office_text(), list_of_days, days))) {}
    study::Case read() const { return read_job(path_).buildings[0]; }

  private:
    Folder folder_;
    std::filesystem::path path_;
};

bool contains(const std::vector<physics::DateRange>& ranges, const char* date) {
    const auto day = physics::calendar_step(physics::parse_time(date));
    return std::ranges::any_of(ranges,
                               [&](const auto& range) { return range.contains(day); });
}

bool is_day_off(const study::Case& building, const char* date) {
    return contains(building.profiles.at(0).schedule.holidays, date);
}

TEST(DaysOff, OfACountryAreItsPublicHolidays) {
    const study::Case building = Office("[holidays]\ncountry = \"US\"\n").read();
    EXPECT_TRUE(is_day_off(building, "2021-11-25"));
    EXPECT_TRUE(is_day_off(building, "2021-01-18"));
    EXPECT_FALSE(is_day_off(building, "2021-10-01"));
    EXPECT_FALSE(is_day_off(Office(list_of_days).read(), "2021-11-25"));
}

TEST(DaysOff, ReachAYearBeforeAndAfterThePeriods) {
    const study::Case building = Office("[holidays]\ncountry = \"US\"\n").read();
    EXPECT_TRUE(is_day_off(building, "2020-11-26"));
    EXPECT_TRUE(is_day_off(building, "2022-11-24"));
    EXPECT_FALSE(is_day_off(building, "2019-11-28"));
}

TEST(DaysOff, OfAStateAreAmongThem) {
    const auto building = [](const std::string& state) {
        return Office("[holidays]\ncountry = \"DE\"\n" + state).read();
    };
    EXPECT_TRUE(is_day_off(building("state = \"BY\"\n"), "2021-01-06"));
    EXPECT_FALSE(is_day_off(building(""), "2021-01-06"));
}

TEST(DaysOff, MayBeMoreThanTheCountrys) {
    const study::Case building = Office(
                                     "[holidays]\ncountry = \"CN\"\ndays = [\"12-24\", "
                                     "\"2021-02-18/2021-02-19\"]\n")
                                     .read();
    for (const char* date : {"2021-02-12", "2021-02-18", "2020-12-24", "2021-12-24"})
        EXPECT_TRUE(is_day_off(building, date)) << date;
}

TEST(DaysOff, InASectionAreThoseOfAList) {
    const study::Case list = Office(list_of_days).read();
    const study::Case section =
        Office("[holidays]\ndays = [\"01-01/01-03\", \"2021-10-01/2021-10-07\"]\n")
            .read();
    for (const char* date : {"2021-01-03", "2021-01-04", "2021-10-07", "2021-10-08"})
        EXPECT_EQ(is_day_off(list, date), is_day_off(section, date)) << date;
}

std::string in_2035(std::string text) {
    for (std::size_t at; (at = text.find("2021")) != std::string::npos;)
        text.replace(at, 4, "2035");
    return text;
}

TEST(DaysOff, OfYearsThatACalendarDoesNotReachAreAskedFor) {
    const Folder folder;
    folder.write("weather.csv", in_2035(small_weather()));
    folder.write("measured.csv", in_2035(small_readings()));
    const auto message = [&](const std::string& country) {
        const std::string section = "[holidays]\ncountry = \"" + country + "\"\n";
        return message_of(
            folder.write("office.toml",
                         in_2035(replaced(small_office_text(), list_of_days, section))));
    };
    EXPECT_EQ(message("US"), "");
    EXPECT_NE(
        message("SG").find("office.toml:6: holidays.country = \"SG\": its days are "
                           "known from 2001 to 2030, and the periods are of 2035 to "
                           "2035; expected the days themselves, under days"),
        std::string::npos)
        << message("SG");
}

TEST(SchoolHolidays, AreKeptWithTheBuildingAndChangeNoSchedule) {
    const study::Case building =
        Office("[holidays]\nschool = [\"2021-08-02/2021-08-20\"]\n").read();
    EXPECT_TRUE(contains(building.school_holidays, "2021-08-20"));
    EXPECT_FALSE(is_day_off(building, "2021-08-20"));
}

}  // namespace
}  // namespace bemcal::job
