#include "physics/week_hours.hpp"

#include <chrono>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr WeekHours of_a_shop = {{{8, 20}, {9, 13}, {}}};

Schedule schedule_with(const WeekHours& hours) {
    Schedule schedule;
    set_hours(hours, schedule);
    return schedule;
}

}  // namespace

TEST(WeekHours, GoIntoAScheduleAndOutOfIt) {
    const Schedule schedule = schedule_with(of_a_shop);
    EXPECT_EQ(hours_of(schedule), of_a_shop);
    EXPECT_EQ(schedule.week[4][7], 0);
    EXPECT_EQ(schedule.week[4][8], 1);
    EXPECT_EQ(schedule.week[4][19], 1);
    EXPECT_EQ(schedule.week[4][20], 0);
    EXPECT_EQ(schedule.week[5][12], 1);
    EXPECT_EQ(schedule.week[6], Day{});
    EXPECT_EQ(schedule.holiday, Day{});
}

TEST(WeekHours, AreOfSchedulesWithOneRunADayAlone) {
    Schedule two_runs = schedule_with(of_a_shop);
    two_runs.week[0][2] = 1;
    EXPECT_FALSE(hours_of(two_runs));
    Schedule graded = schedule_with(of_a_shop);
    for (Day& day : graded.week) day[9] = 0.5;
    EXPECT_FALSE(hours_of(graded));
    Schedule of_seasons = schedule_with(of_a_shop);
    of_seasons.periods.emplace_back();
    EXPECT_FALSE(hours_of(of_seasons));
    Schedule without_fridays = schedule_with(of_a_shop);
    without_fridays.week[4] = Day{};
    EXPECT_FALSE(hours_of(without_fridays));
    EXPECT_FALSE(hours_of(Schedule{}));
    // A lower number than 1 is off, as is any: what is high runs.
    Schedule lowered = schedule_with(of_a_shop);
    for (Day& day : lowered.week)
        for (double& value : day) value = 0.2 + 0.6 * value;
    for (double& value : lowered.holiday) value = 0.2;
    EXPECT_EQ(hours_of(lowered), of_a_shop);
}

TEST(WeekHours, EveryRunOfADayStandsOnce) {
    const auto runs = all_runs();
    EXPECT_EQ(runs.size(), 301U);
    EXPECT_TRUE(runs[0].is_off());
    for (std::size_t k = 1; k < runs.size(); ++k)
        EXPECT_TRUE(runs[k].from < runs[k].until && runs[k].until <= 24);
}

TEST(WeekHours, AreApartByTheHoursThatOneHasAlone) {
    EXPECT_EQ(hours_apart({8, 18}, {8, 18}), 0);
    EXPECT_EQ(hours_apart({8, 18}, {9, 20}), 3);
    EXPECT_EQ(hours_apart({8, 10}, {12, 15}), 5);
    EXPECT_EQ(hours_apart({}, {12, 15}), 3);
    EXPECT_EQ(hours_apart({0, 24}, {}), 24);
}

TEST(WeekHours, AreNumberedByKindOfDayAndHour) {
    using namespace std::chrono;
    Schedule schedule = schedule_with(of_a_shop);
    schedule.holidays = {parse_date_range("2021-03-03")};  // a Wednesday
    // From Monday on.
    const TimeAxis week{sys_days{year{2021} / March / 1}, 3600, 7 * 24};
    const auto numbers = values_of(numbered_hours(schedule), week, 0);
    EXPECT_EQ(numbers[9], 9);
    EXPECT_EQ(numbers[2 * 24 + 9], 48 + 9);
    EXPECT_EQ(numbers[5 * 24 + 9], 24 + 9);
    EXPECT_EQ(numbers[6 * 24 + 9], 48 + 9);
    const auto values = values_of(schedule, week, 0);
    for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_EQ(runs_at(of_a_shop, static_cast<int>(numbers[k])), values[k] == 1) << k;
}

TEST(WeekHours, AreSaidInWords) {
    EXPECT_EQ(
        sentence_of(of_a_shop),
        "Monday to Friday 8 to 20 h, Saturdays 9 to 13 h, Sundays and holidays off");
    EXPECT_EQ(sentence_of(DailyRun{0, 24}), "all day");
}

TEST(WeekHours, EveryUseHasUsualOnes) {
    for (const char* use : {"office", "home", "school", "shop"})
        EXPECT_TRUE(usual_hours(use)) << use;
    EXPECT_FALSE(usual_hours("hospital"));
}

}  // namespace bemcal::physics
