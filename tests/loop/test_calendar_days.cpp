#include "base/random.hpp"
#include "holidays/holidays.hpp"
#include "loop/calendar_days.hpp"
#include "sampling/normal.hpp"

#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;

namespace {

int number_of(int year, unsigned month, unsigned day) {
    using namespace std::chrono;
    return static_cast<int>(sys_days(std::chrono::year(year) / static_cast<int>(month) /
                                     static_cast<int>(day))
                                .time_since_epoch()
                                .count());
}

bool is_weekend(int day) {
    return (day + 3) % 7 >= 5;  // 1 January 1970 was a Thursday
}

/// Shares of a year of working days: about 0 with a spread of 0.1, and about `closed` on
/// the days that are closed.
DayShares year_of(int year, const std::vector<int>& closed_on, double closed = 0.95) {
    DayShares days{{}, 0, 0.1};
    Stream random(11, 0, 0);
    for (int day = number_of(year, 1, 1); day < number_of(year + 1, 1, 1); ++day) {
        const double noise = 0.1 * sampling::standard_normal(random);
        const bool is_closed = std::ranges::find(closed_on, day) != closed_on.end();
        if (!is_weekend(day)) days.shares[day] = (is_closed ? closed : 0) + noise;
    }
    return days;
}

std::vector<int> days_of(const char* country, const char* state, int year,
                         const std::vector<std::string>& without = {}) {
    std::vector<int> days;
    for (const auto& day : holidays::holidays_of(country, state, year))
        if (std::ranges::find(without, day.name) == without.end())
            days.push_back(static_cast<int>(day.date.time_since_epoch().count()));
    return days;
}

}  // namespace

TEST(KeptCalendar, OfAnAmericanBuildingForetellsTheNextYearsDays) {
    const auto kept = kept_calendar(year_of(2018, days_of("US", "", 2018)), 2018, 2019);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "US");
    EXPECT_TRUE(kept->holds(number_of(2019, 1, 21)));    // third Monday of January
    EXPECT_TRUE(kept->holds(number_of(2019, 11, 28)));   // fourth Thursday of November
    EXPECT_FALSE(kept->holds(number_of(2019, 11, 22)));  // last year's date
}

TEST(KeptCalendar, OfABavarianBuildingIsBavarias) {
    const auto kept = kept_calendar(year_of(2019, days_of("DE", "BY", 2019)), 2019, 2020);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "DE-BY");
    EXPECT_TRUE(kept->holds(number_of(2020, 6, 11)));  // Corpus Christi
}

TEST(KeptCalendar, IsTheCountrysWhereAHouseAddsADayOfAState) {
    std::vector<int> days = days_of("US", "", 2018);
    days.push_back(number_of(2018, 12, 24));
    const auto kept = kept_calendar(year_of(2018, days), 2018, 2019);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "US");
}

TEST(KeptCalendar, LeavesOutHolidaysThatAreWorked) {
    const auto kept = kept_calendar(
        year_of(2018, days_of("US", "", 2018, {"Columbus Day", "Veterans Day"})), 2018,
        2019);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "US");
    EXPECT_TRUE(kept->holds(number_of(2019, 9, 2)));     // Labor Day
    EXPECT_FALSE(kept->holds(number_of(2019, 10, 14)));  // Columbus Day
}

TEST(KeptCalendar, KnowsAHouseThatTakesNoDayOffForAHolidayOnAWeekend) {
    std::vector<int> days = days_of("US", "", 2012);
    std::erase(days, number_of(2012, 11, 12));  // for Veterans Day, a Sunday
    const auto kept = kept_calendar(year_of(2012, days), 2012, 2013);
    ASSERT_TRUE(kept);
    EXPECT_FALSE(kept->holds(number_of(2012, 11, 12)));
    EXPECT_TRUE(kept->holds(number_of(2013, 11, 11)));
}

TEST(KeptCalendar, TakesAHolidayForMovedWhereTheNextDayWasClosedInItsPlace) {
    std::vector<int> days = days_of("US", "", 2018);
    std::ranges::replace(days, number_of(2018, 9, 3), number_of(2018, 9, 4));
    const auto kept = kept_calendar(year_of(2018, days), 2018, 2019);
    ASSERT_TRUE(kept);
    EXPECT_FALSE(kept->holds(number_of(2018, 9, 3)));
    EXPECT_TRUE(kept->holds(number_of(2018, 9, 4)));
    EXPECT_TRUE(kept->holds(number_of(2019, 9, 2)));
}

TEST(KeptCalendar, TakesNoDayForClosedThatAClosedOneBeforeItChanged) {
    std::vector<int> days = days_of("US", "", 2018);
    std::ranges::replace(days, number_of(2018, 9, 3), number_of(2018, 9, 4));
    DayShares shares = year_of(2018, days);
    shares.spread = 0.03;
    for (auto& [day, share] : shares.shares)
        if (share < 0.5) share *= 0.3;
    shares.shares[number_of(2018, 9, 5)] = 0.15;
    const auto kept = kept_calendar(shares, 2018, 2019);
    ASSERT_TRUE(kept);
    EXPECT_TRUE(kept->holds(number_of(2018, 9, 4)));
    EXPECT_TRUE(kept->holds(number_of(2019, 9, 2)));
    shares.shares[number_of(2018, 9, 5)] = 0.49;
    EXPECT_TRUE(kept_calendar(shares, 2018, 2019)->holds(number_of(2018, 9, 4)));
    shares.shares[number_of(2018, 9, 5)] = 0.5;  // closed for itself: none is moved
    EXPECT_FALSE(kept_calendar(shares, 2018, 2019)->holds(number_of(2018, 9, 4)));
}

TEST(KeptCalendar, IsKnownFromAPeriodOfOneYear) {
    const auto kept = kept_calendar(year_of(2018, days_of("US", "", 2018)), 2018, 2018);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "US");
}

TEST(KeptCalendar, IsNoneWhereOnlyDatesThatNeverMoveWereClosed) {
    EXPECT_FALSE(
        kept_calendar(year_of(2018, {number_of(2018, 5, 1), number_of(2018, 12, 24),
                                     number_of(2018, 12, 25), number_of(2018, 12, 26)}),
                      2018, 2019));
}

TEST(KeptCalendar, OneDayThatMovesMakesNone) {
    std::vector<int> days{number_of(2018, 5, 28), number_of(2018, 7, 4)};
    EXPECT_FALSE(kept_calendar(year_of(2018, days), 2018, 2019));
    days.push_back(number_of(2018, 9, 3));
    days.push_back(number_of(2018, 11, 22));
    EXPECT_TRUE(kept_calendar(year_of(2018, days), 2018, 2019));
}

TEST(KeptCalendar, IsNoneWhereNoDayWasClosed) {
    EXPECT_FALSE(kept_calendar(year_of(2018, {}), 2018, 2019));
}

TEST(KeptCalendar, IsNoneWhereTheClosedDaysAreNoCountrys) {
    EXPECT_FALSE(
        kept_calendar(year_of(2018, {number_of(2018, 3, 6), number_of(2018, 7, 17),
                                     number_of(2018, 9, 12), number_of(2018, 10, 23)}),
                      2018, 2019));
}

TEST(KeptCalendar, TakesHalfClosedDaysForNone) {
    EXPECT_FALSE(kept_calendar(year_of(2018, days_of("US", "", 2018), 0.2), 2018, 2019));
}

TEST(KeptCalendar, TakesDaysForClosedThatKeepHalfOfTheirUse) {
    EXPECT_TRUE(kept_calendar(year_of(2018, days_of("US", "", 2018), 0.5), 2018, 2019));
}

TEST(KeptCalendar, IsAStatesWhereAHouseTakesTwoDaysOfIt) {
    std::vector<int> days = days_of("US", "", 2018);
    for (const int day : days_of("US", "CA", 2018))
        if (std::ranges::find(days, day) == days.end()) days.push_back(day);
    std::erase(days, number_of(2018, 10, 8));  // Columbus Day, none of California's
    const auto kept = kept_calendar(year_of(2018, days), 2018, 2019);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->place, "US-CA");
}

TEST(KeptCalendar, IsNoneInYearsThatNoTableReaches) {
    EXPECT_FALSE(kept_calendar(year_of(1980, {number_of(1980, 12, 25)}), 1980, 1981));
}
