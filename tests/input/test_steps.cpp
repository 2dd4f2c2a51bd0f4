#include "base/error.hpp"
#include "input/csv_numbers.hpp"
#include "input/series.hpp"
#include "input/stamps.hpp"
#include "input/steps.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::input {
namespace {

using physics::format_time;
using physics::Seconds;
using std::chrono::seconds;

const Seconds start = physics::parse_time("2021-03-05");

/// Rows at these seconds after the start; the reading is the row's number.
RegularSeries series_at(const std::vector<int>& at, const StampRules& rules = {},
                        Fold fold = Fold::sum, Stamps* stamps = nullptr) {
    std::string text = "time,x\n";
    for (std::size_t k = 0; k < at.size(); ++k)
        text += fmt::format("{},{}\n", format_time(start + seconds(at[k])), k + 1);
    const Csv csv = parse_csv(text, "x.csv");
    const Stamps found = stamps_in(csv, TimeColumns(0), rules);
    if (stamps != nullptr) *stamps = found;
    return on_whole_steps(lay(csv, found, numbers_in(csv, 1), fold));
}

StampRules unsaid() {
    StampRules rules;
    rules.is_said = false;
    return rules;
}

/// n rows from `first` on, `step` apart.
std::vector<int> even(int first, int step, int n) {
    std::vector<int> at;
    for (int k = 0; k < n; ++k) at.push_back(first + k * step);
    return at;
}

TEST(Steps, ADistanceIsMeantAsTheUsualStepBesideIt) {
    EXPECT_EQ(usual_step(3599), 3600);
    EXPECT_EQ(usual_step(3660), 3600);
    EXPECT_EQ(usual_step(890), 900);
    EXPECT_EQ(usual_step(420), 420);
    EXPECT_EQ(usual_step(82800), 86400);
    EXPECT_EQ(usual_step(31 * 86400), 31 * 86400);
}

TEST(Steps, SecondsThatWanderAreTheStepBesideThem) {
    std::vector<int> at = even(0, 3600, 30);
    for (std::size_t k = 0; k < at.size(); ++k) at[k] += static_cast<int>(k % 4);
    Stamps stamps;
    const RegularSeries series = series_at(at, {}, Fold::sum, &stamps);
    EXPECT_EQ(series.axis.step_s, 3600);
    EXPECT_EQ(series.axis.start, start);
    EXPECT_EQ(series.values.size(), 30U);
    ASSERT_EQ(stamps.notes.size(), 1U);
    EXPECT_EQ(stamps.notes[0].finding,
              "22 of 30 stamps lie up to 3 s beside their step of 1 h");
}

TEST(Steps, EndsOneSecondOrOneMinuteEarlyAreTheEndsOfTheirHours) {
    StampRules rules;
    rules.at_end = true;
    EXPECT_EQ(series_at(even(3599, 3600, 30), rules).axis.start, start);
    std::vector<int> at = even(3600, 3600, 30);
    for (std::size_t k = 10; k < 20; ++k) at[k] -= 60;
    const RegularSeries series = series_at(at, rules);
    EXPECT_EQ(series.axis.start, start);
    EXPECT_TRUE(series.gaps.empty());
}

// Days of UTC at a site an hour or two off: not beside midnight, they begin there.
TEST(Steps, DaysThatAllBeginAtAFullHourBeginThere) {
    constexpr int hour = 3600, day = 24 * hour;
    for (const int late : {hour, 2 * hour, 23 * hour}) {
        Stamps found;
        const RegularSeries series = series_at(even(late, day, 9), {}, Fold::sum, &found);
        EXPECT_EQ(series.axis.start, start + seconds(late));
        EXPECT_TRUE(found.notes.empty());
    }
    std::vector<int> wall = even(0, day, 9);
    wall[4] += hour;  // one day by another clock is moved
    EXPECT_EQ(series_at(wall).axis.start, start);
}

TEST(Steps, ARowFarBesideItsStepIsRefused) {
    std::vector<int> at = even(0, 3600, 30);
    at[7] += 600;
    EXPECT_THROW(series_at(at), UserError);
    at[7] -= 600 + 3300;  // it stands beside the hour before, which has a row already
    EXPECT_THROW(series_at(at), UserError);
}

TEST(Steps, AStampInTheMiddleOfItsHourStandsForThatHour) {
    Stamps stamps;
    const RegularSeries series =
        series_at(even(1800, 3600, 30), unsaid(), Fold::sum, &stamps);
    EXPECT_EQ(series.axis.start, start);
    EXPECT_EQ(series.values[1], 2);
    EXPECT_EQ(stamps.notes.size(), 1U);
}

TEST(Steps, AnInstantTenPastStandsForItsHourAndAnEnergyIsSharedOut) {
    StampRules rules = unsaid();
    rules.is_mean = true;
    EXPECT_EQ(series_at(even(600, 3600, 30), rules).values[1], 2);
    // Of the hour from 01:00 the last 50 minutes are in the row of 01:10, the first 10 in
    // that of 00:10.
    const RegularSeries shared = series_at(even(600, 3600, 30), unsaid());
    EXPECT_EQ(shared.axis.start, start + seconds(3600));
    EXPECT_NEAR(shared.values[0], 1 * 10 / 60.0 + 2 * 50 / 60.0, 1e-12);
}

TEST(Steps, UtcHoursOfAHalfHourZoneAreSharedOut) {
    StampRules rules = unsaid();
    rules.site_offset_h = 5.5;  // of India
    const RegularSeries series = series_at(even(0, 3600, 30), rules);
    // 00:00 to 01:00 UTC is 05:30 to 06:30 there.
    EXPECT_EQ(format_time(series.axis.start), "2021-03-05 06:00:00");
    EXPECT_EQ(series.values.size(), 29U);
    EXPECT_NEAR(series.values[0], 1.5, 1e-12);
}

TEST(Steps, HoursThenQuartersMeetAtTheHour) {
    std::vector<int> at = even(0, 3600, 48);
    for (const int quarter : even(48 * 3600, 900, 4 * 48)) at.push_back(quarter);
    Stamps stamps;
    const RegularSeries sums = series_at(at, {}, Fold::sum, &stamps);
    EXPECT_EQ(sums.axis.step_s, 3600);
    ASSERT_EQ(sums.values.size(), 96U);
    EXPECT_TRUE(sums.gaps.empty());
    EXPECT_EQ(sums.values[47], 48);
    EXPECT_EQ(sums.values[48], 49 + 50 + 51 + 52);
    EXPECT_EQ(series_at(at, {}, Fold::mean).values[48], 50.5);
    EXPECT_EQ(stamps.notes.size(), 1U);
}

TEST(Steps, AChangeOfTheStepBelongsToTheRightRowWhereStampsAreEnds) {
    std::vector<int> at = even(900, 900, 4 * 48);
    for (const int hour : even(49 * 3600, 3600, 48)) at.push_back(hour);
    StampRules rules;
    rules.at_end = true;
    const RegularSeries series = series_at(at, rules);
    ASSERT_EQ(series.values.size(), 96U);
    EXPECT_EQ(series.axis.start, start);
    EXPECT_EQ(series.values[47], 189 + 190 + 191 + 192);
    EXPECT_EQ(series.values[48], 193);
    EXPECT_TRUE(series.gaps.empty());
}

TEST(Steps, AFewMissingRowsAreGapsAndNoOtherStep) {
    std::vector<int> at = even(0, 900, 40);
    for (const int hour : even(40 * 900, 3600, 10)) at.push_back(hour);
    for (const int quarter : even(40 * 900 + 10 * 3600, 900, 40)) at.push_back(quarter);
    EXPECT_EQ(series_at(at).axis.step_s, 900);
    EXPECT_EQ(series_at(at).gaps.size(), 10U);
}

}  // namespace
}  // namespace bemcal::input
