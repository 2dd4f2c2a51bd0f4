#include "loop/late_clock.hpp"
#include "loop/windy_model.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;
using test::named;

namespace {

const std::vector<double> hours_of_two_days = [] {
    std::vector<double> hours;
    for (int k = 0; k < 48; ++k) hours.push_back(k);
    return hours;
}();

/// What is asked where the search had found all schedules so many hours late.
std::optional<LateClock> asked_of_schedules(const LoopData& data, double hours) {
    const Place place = make_place(data, {}, data.drive);
    LoopModel model;
    model.effects = {named("schedules earlier or later")};
    model.effects[0].shape.at = hours;
    Standing standing =
        calibrate(data, place, model, std::vector<double>(place.unknowns.size() + 1));
    standing.fit.at.x.back() = 1 / standing.built.unknowns.back().scale;
    return late_clock_in_place_of(data, standing, 0);
}

TEST(LoopClock, ALateClockShowsAnHourLater) {
    const auto late = by_late_clock(hours_of_two_days, 2);
    EXPECT_TRUE(std::isnan(late[0]) && std::isnan(late[1]));
    EXPECT_EQ(late[2], 0);
    EXPECT_EQ(late[47], 45);
    const auto early = by_late_clock(hours_of_two_days, -1);
    EXPECT_EQ(early[0], 1);
    EXPECT_TRUE(std::isnan(early[47]));
}

TEST(LoopClock, AtItsEndStandsADayAway) {
    const auto late = by_late_clock_throughout(hours_of_two_days, 2);
    EXPECT_EQ(late[0], 22);
    EXPECT_EQ(late[1], 23);
    EXPECT_EQ(late[2], 0);
    EXPECT_EQ(by_late_clock_throughout(hours_of_two_days, -1)[47], 24);
    EXPECT_EQ(by_late_clock_throughout(hours_of_two_days, 0), hours_of_two_days);
}

TEST(LoopClock, ItIsSetByItsHoursAndSaysSo) {
    const Case made = test::WindyModel::measured();
    const Case set = with_clock_set(made, {2, 345});
    EXPECT_EQ(made.meters[0].axis.start - set.meters[0].axis.start,
              std::chrono::hours(2));
    EXPECT_EQ(set.meters[0].values, made.meters[0].values);
    ASSERT_EQ(set.decisions.size(), made.decisions.size() + 1);
    EXPECT_EQ(set.decisions.back().finding,
              "their clock is 2 h late: this explains more than schedules that are "
              "(evidence 345)");
}

// Readings of a gas meter whose clock alone is wrong: late schedules are asked for, and
// the clock explains more. Of readings by the right clock, it does not.
TEST(LoopClock, WeatherTellsAClockFromSchedules) {
    const auto found_in = [](int hours) {
        Case made = test::WindyModel::measured();
        made.meters[0].axis.start += std::chrono::hours(hours);
        return asked_of_schedules(LoopData(made, test::WindyModel::options()), 2);
    };
    const auto late = found_in(2);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->hours, 2);
    EXPECT_FALSE(found_in(0));
}

/// A training period that begins five weeks before summer time does.
Case over_the_change() {
    Case made = test::windy_case();
    const std::chrono::hours earlier(24 * 45);
    made.weather.axis.start -= earlier;
    for (physics::Profile& profile : made.profiles) profile.axis.start -= earlier;
    for (Period& period : made.periods) period.from -= earlier, period.to -= earlier;
    return made;
}

// In summer people come an hour earlier by such a clock: one hour late is half way
// between, and the two are asked about together.
TEST(LoopClock, ItIsAskedTogetherWithSummerTime) {
    Case made = over_the_change();
    const effects::Effect summer = named("summer time not applied");
    test::measure(made, summer, 1, 3);
    made.meters[0].axis.start += std::chrono::hours(2);
    const auto hours_with = [&](const std::vector<std::string>& exclude) {
        auto options = test::WindyModel::options();
        options.exclude = exclude;
        return asked_of_schedules(LoopData(made, options), 1).value_or(LateClock{}).hours;
    };
    EXPECT_EQ(hours_with({}), 2);
    EXPECT_EQ(hours_with({summer.name}), 1);
}

TEST(LoopClock, OnlyWholeHoursOfAllSchedulesAreAsked) {
    test::WindyModel model({"wind infiltration"});
    EXPECT_FALSE(late_clock_in_place_of(model.data, model.standing, 0));
}

}  // namespace
