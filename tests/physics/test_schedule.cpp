/// Which value of a schedule holds at which step.
#include "physics/schedule.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// Value = 100 (weekday + 1) + hour, so that each is recognised.
Schedule recognisable() {
    Schedule schedule;
    for (int d = 0; d < 7; ++d)
        for (int h = 0; h < 24; ++h)
            schedule.week[static_cast<std::size_t>(d)][static_cast<std::size_t>(h)] =
                100 * (d + 1) + h;
    schedule.holiday.fill(-1);
    return schedule;
}

double value_at(const Schedule& schedule, const char* time, double utc_offset_h = 0) {
    return values_of(schedule, {parse_time(time), 3600, 1}, utc_offset_h).at(0);
}

TEST(Schedule, HourOfTheWeek) {
    const std::vector<double> week =
        values_of(recognisable(), {parse_time("2021-03-01"), 3600, 168}, 0);  // a Monday
    ASSERT_EQ(week.size(), 168U);
    for (int k = 0; k < 168; ++k)
        EXPECT_EQ(week[static_cast<std::size_t>(k)], 100 * (k / 24 + 1) + k % 24);
}

TEST(Schedule, ShortStepsHoldTheirHour) {
    const std::vector<double> values =
        values_of(recognisable(), {parse_time("2021-03-01 07:00"), 600, 12}, 0);
    for (int k = 0; k < 12; ++k)
        EXPECT_EQ(values[static_cast<std::size_t>(k)], k < 6 ? 107 : 108);
}

TEST(Schedule, LastPeriodWinsAndHolidaysWinOverPeriods) {
    Schedule schedule = recognisable();
    const auto constant = [](double value) {
        std::array<Day, 7> week;
        for (Day& day : week) day.fill(value);
        return week;
    };
    schedule.periods = {{parse_date_range("06-01/08-31"), constant(1)},
                        {parse_date_range("07-01/07-31"), constant(2)}};
    schedule.holidays = {parse_date_range("07-04"),
                         parse_date_range("2021-12-24/2022-01-02")};
    EXPECT_EQ(value_at(schedule, "2021-06-15 10:00"), 1);
    EXPECT_EQ(value_at(schedule, "2021-07-15 10:00"), 2);
    EXPECT_EQ(value_at(schedule, "2021-07-04 10:00"), -1);
    EXPECT_EQ(value_at(schedule, "2021-12-31 10:00"), -1);
    EXPECT_EQ(value_at(schedule, "2022-12-31 10:00"), 610);
}

TEST(Schedule, FollowsTheWallClockInSummer) {
    Schedule schedule = recognisable();
    schedule.summer_time = "eu";
    // Monday 5 July 2021 in Berlin (UTC+1): 8:00 standard time is 9:00 on the wall.
    EXPECT_EQ(value_at(schedule, "2021-07-05 08:00", 1), 109);
    EXPECT_EQ(value_at(schedule, "2021-07-05 23:00", 1), 200);
    EXPECT_EQ(value_at(schedule, "2021-01-04 08:00", 1), 108);
    // The day's last hour belongs to the next date, a holiday too.
    schedule.holidays = {parse_date_range("07-06")};
    EXPECT_EQ(value_at(schedule, "2021-07-05 23:00", 1), -1);
}

/// A register multiplies the hours by the number of their day on the wall clock.
TEST(Schedule, MultipliesByTheRegister) {
    Schedule schedule = recognisable();
    schedule.summer_time = "eu";
    using namespace std::chrono;
    schedule.days = {{sys_days{2021y / July / 5}, 20}, {sys_days{2021y / July / 7}, 3}};
    EXPECT_EQ(value_at(schedule, "2021-07-05 08:00", 1), 20 * 109);
    EXPECT_EQ(value_at(schedule, "2021-07-06 08:00", 1), 0);
    EXPECT_EQ(value_at(schedule, "2021-07-06 23:00", 1), 3 * 300);
}

TEST(Schedule, UnknownSummerTimeIsRefused) {
    Schedule schedule = recognisable();
    schedule.summer_time = "moon";
    EXPECT_THROW(value_at(schedule, "2021-07-05"), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::physics
