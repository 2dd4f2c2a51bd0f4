#include "checks/data_clock.hpp"
#include "checks/made_meters.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr int day = 24;
const std::vector<checks::ClockChange> changes{
    {88 * day + 2, true}, {298 * day + 2, false}, {452 * day + 2, true}};

/// The days of `meter` an hour earlier from each change to summer to the next change.
MadeMeter on_wall_clock(MadeMeter meter, int first_year = 0) {
    const std::vector<double> before = meter.values;
    const auto shift = [&](int from, int to) {
        for (int k = from; k < std::min<int>(to, static_cast<int>(before.size()) - 1);
             ++k)
            meter.values[static_cast<std::size_t>(k)] =
                before[static_cast<std::size_t>(k) + 1];
    };
    if (first_year == 0) shift(changes[0].at, changes[1].at);
    shift(changes[2].at, static_cast<int>(before.size()));
    return meter;
}

TEST(Lags, OfShiftedDaysAreTheShift) {
    MadeMeter early = made_electricity(1, 60), late = early;
    std::rotate(late.values.begin(), late.values.end() - 2, late.values.end());
    const auto first = checks::weekday_profile(early.series(), 0, 60 * day);
    const checks::Lag lag =
        checks::lag_of(first, checks::weekday_profile(late.series(), 0, 60 * day));
    EXPECT_NEAR(lag.hours, 2, 0.1);
    EXPECT_GT(lag.correlation, 0.95);
    EXPECT_NEAR(checks::lag_of(first, first).hours, 0, 1e-9);
}

TEST(Lags, OfAnIntervalsLabelByHalfHoursAreHalfAnHour) {
    MadeMeter early = made_electricity(1, 60), late = early;
    for (std::size_t k = 1; k < late.values.size(); ++k)
        late.values[k] = (early.values[k] + early.values[k - 1]) / 2;
    EXPECT_NEAR(checks::lag_of(checks::weekday_profile(early.series(), 0, 60 * day),
                               checks::weekday_profile(late.series(), 0, 60 * day))
                    .hours,
                0.5, 0.1);
}

TEST(WeekdayProfiles, OfFlatDaysAndOfTooFewAreEmpty) {
    MadeMeter meter{std::vector<double>(30 * day, 5.0)};
    EXPECT_TRUE(checks::weekday_profile(meter.series(), 0, 30 * day).empty());
    EXPECT_TRUE(
        checks::weekday_profile(made_electricity(1, 9).series(), 0, 9 * day).empty());
}

TEST(SummerTime, OfDaysThatFollowTheWallClockMoves) {
    const checks::SummerShift shift =
        checks::summer_shift(on_wall_clock(made_electricity(3, 550)).series(), changes);
    EXPECT_EQ(shift.verdict, checks::SummerTime::moves);
    EXPECT_EQ(shift.changes.size(), 3U);
    EXPECT_NEAR(shift.hours, -1, 0.1);
}

TEST(SummerTime, ThatIsFollowedInOneYearOnlyIsMixed) {
    const checks::SummerShift shift = checks::summer_shift(
        on_wall_clock(made_electricity(3, 550), 1).series(), changes);
    EXPECT_EQ(shift.verdict, checks::SummerTime::mixed);
}

TEST(SummerTime, OfHalfAnHourIsUnknown) {
    MadeMeter meter = made_electricity(3, 550);
    const MadeMeter moved = on_wall_clock(meter);
    for (std::size_t k = 0; k < meter.values.size(); ++k)
        meter.values[k] = (meter.values[k] + moved.values[k]) / 2;
    EXPECT_EQ(checks::summer_shift(meter.series(), changes).verdict,
              checks::SummerTime::unknown);
}

// 200 clean meters: none may seem to move or to change its clock, and most must be
// seen to stand. With no false alarm the rate is below 1.5 % of meters (95 %).
TEST(CleanMeters, StandAtTheDatesOfSummerTime) {
    int n_standing = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const checks::SummerTime verdict =
            checks::summer_shift(made_meter(seed).series(), changes).verdict;
        EXPECT_NE(verdict, checks::SummerTime::moves) << seed;
        EXPECT_NE(verdict, checks::SummerTime::mixed) << seed;
        n_standing += verdict == checks::SummerTime::stands ? 1 : 0;
    }
    EXPECT_GT(n_standing, 100);
}

TEST(NoonOffsets, AreThoseOfTheClearDays) {
    std::vector<double> sun, measured;
    Stream stream(4, 4, 4);
    for (int k = 0; k < 365 * day; ++k) {
        const auto height = [](double hour) {
            return std::max(0.0, std::cos(std::numbers::pi * (hour - 12) / 12));
        };
        sun.push_back(1000 * height(k % 24));
        const bool clear = k / 24 % 5 == 0;  // cloudy mornings elsewhere
        measured.push_back((clear || k % 24 > 12 ? 750 : 100 * stream.uniform()) *
                           height(k % 24 - 1));
    }
    const checks::NoonOffset noon =
        checks::noon_offset({measured, 24, 0, 0, checks::Driver::temperature}, sun);
    EXPECT_EQ(noon.n_days, 37);
    EXPECT_NEAR(noon.hours, 1, 0.05);
}

}  // namespace
}  // namespace bemcal::stats
