#include "study/case.hpp"
#include "study/small_case.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Readings 0, 1, 2 .. at the begin of every interval between two days.
Meter counting_meter(physics::Interval interval, int first_day, int last_day) {
    Meter meter;
    meter.name = "meter";
    meter.quantity = physics::Quantity::gas;
    meter.interval = interval;
    meter.axis = {test::day(first_day), 3600, 24 * (last_day - first_day)};
    meter.values.assign(static_cast<std::size_t>(meter.axis.n_steps), nan);
    double reading = 0;
    const auto bounds = physics::interval_bounds(meter.axis, interval);
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        meter.values[static_cast<std::size_t>(bounds[k])] = reading++;
    return meter;
}

std::vector<double> readings(const Meter& meter, const Period& period) {
    Case made = test::small_case();
    made.meters = {meter};
    return readings_of(made, period)[0].values;
}

TEST(Readings, OfHoursAreThoseOfThePeriod) {
    const auto found = readings(counting_meter(physics::Interval::hourly, 5, 9),
                                {"p", test::day(6), test::day(8)});
    ASSERT_EQ(found.size(), 48U);
    EXPECT_EQ(found.front(), 24);
    EXPECT_EQ(found.back(), 71);
}

TEST(Readings, BeyondTheMetersDataAreMissing) {
    const auto found = readings(counting_meter(physics::Interval::hourly, 6, 7),
                                {"p", test::day(5), test::day(8)});
    ASSERT_EQ(found.size(), 72U);
    EXPECT_TRUE(std::isnan(found[23]));
    EXPECT_EQ(found[24], 0);
    EXPECT_TRUE(std::isnan(found[48]));
}

TEST(Readings, OfDaysStandAtTheirFirstHour) {
    EXPECT_EQ(readings(counting_meter(physics::Interval::daily, 4, 9),
                       {"p", test::day(6), test::day(8)}),
              (std::vector<double>{2, 3}));
}

// A period from 06:00 to 18:00 two days later holds one whole day between two cut ones.
TEST(Readings, OfIntervalsThatThePeriodCutsAreMissing) {
    using std::chrono::hours;
    const auto found = readings(counting_meter(physics::Interval::daily, 4, 9),
                                {"p", test::day(6) + hours(6), test::day(8) + hours(18)});
    ASSERT_EQ(found.size(), 3U);
    EXPECT_TRUE(std::isnan(found[0]));
    EXPECT_EQ(found[1], 3);
    EXPECT_TRUE(std::isnan(found[2]));
}

TEST(Years, AreThoseThatAPeriodTouches) {
    using namespace std::chrono;
    const auto at = [](int year, int month, int day) {
        return physics::Seconds(sys_days(std::chrono::year(year) / month / day));
    };
    const YearSpan years = years_of({{"training", at(2021, 12, 31), at(2022, 6, 1)},
                                     {"held_out", at(2022, 6, 1), at(2023, 1, 1)}});
    EXPECT_EQ(years.first, 2021);
    EXPECT_EQ(years.last, 2022);  // ends with the year
}

TEST(Readings, OfAWholeMonthAreKept) {
    EXPECT_EQ(readings(counting_meter(physics::Interval::monthly, 0, 61),
                       {"p", test::day(0), test::day(30)}),
              (std::vector<double>{0}));
}

// Bills of 3, 4 and 7 days; the period begins inside of the first.
TEST(Readings, OfBillsAreThoseThatLieWholeInThePeriod) {
    Meter meter = counting_meter(physics::Interval::hourly, 2, 16);
    meter.interval = {physics::Interval::monthly,
                      {test::day(2), test::day(5), test::day(9), test::day(16)}};
    const auto all = readings(meter, {"p", test::day(3), test::day(16)});
    ASSERT_EQ(all.size(), 3U);
    EXPECT_TRUE(std::isnan(all[0]));
    EXPECT_EQ(all[1], 3 * 24);  // the bill stands at its first hour
    EXPECT_EQ(all[2], 7 * 24);
    const auto cut = readings(meter, {"p", test::day(5), test::day(15)});
    ASSERT_EQ(cut.size(), 2U);
    EXPECT_EQ(cut[0], 3 * 24);
    EXPECT_TRUE(std::isnan(cut[1]));
}

TEST(Readings, AtAnotherStepThanTheSimulationsAreRefused) {
    EXPECT_NO_THROW(readings(counting_meter(physics::Interval::step, 0, 2),
                             {"p", test::day(0), test::day(1)}));
    Meter meter = counting_meter(physics::Interval::step, 0, 2);
    meter.axis.step_s = 600;
    EXPECT_THROW(readings(meter, {"p", test::day(0), test::day(1)}),
                 std::invalid_argument);
}

TEST(CaseDrive, CoversThePeriodAfterItsWarmUp) {
    const Case made = test::small_case();
    const physics::Drive drive = drive_of(made, made.periods[0]);
    EXPECT_EQ(drive.n_warm_up, 96);
    EXPECT_EQ(drive.n_steps(), 96 + 240);
    EXPECT_EQ(drive.axis.begin_of(drive.n_warm_up), made.periods[0].from);
    EXPECT_EQ(axis_of(made, made.periods[0]).n_steps, 240);
}

/// Air of 10 degC on the first day from `first_day` on, 1 K more each day.
Meter thermometer(int first_day, int last_day) {
    Meter meter = counting_meter(physics::Interval::hourly, first_day, last_day);
    meter.quantity = physics::Quantity::air_temperature;
    for (std::size_t k = 0; k < meter.values.size(); ++k)
        meter.values[k] = 10 + static_cast<double>(k / 24);
    return meter;
}

TEST(CaseDrive, StartsFromWhatTheThermometerShows) {
    Case made = test::small_case();
    made.meters = {counting_meter(physics::Interval::hourly, 0, 20), thermometer(0, 20)};
    const Period period{"p", test::day(7), test::day(9)};
    const physics::Drive drive = drive_of(made, period);
    EXPECT_EQ(drive.n_warm_up, 96);
    EXPECT_EQ(drive.theta_start, 13);
}

TEST(CaseDrive, WarmsUpOnWhatIsThereWhereTheStartIsMeasured) {
    Case made = test::small_case();
    made.meters = {thermometer(0, 20)};
    made.warm_up_hours = 240;
    const Period period{"p", test::day(6), test::day(9)};
    const physics::Drive drive = drive_of(made, period);
    EXPECT_EQ(drive.n_warm_up, 144);
    EXPECT_EQ(drive.theta_start, 10);
    EXPECT_EQ(drive.theta_e[0], made.weather.theta_e[0]);
}

TEST(CaseDrive, StartsAsEverWhereNothingIsMeasured) {
    Case made = test::small_case();
    made.warm_up_hours = 240;
    const Period period{"p", test::day(6), test::day(9)};
    for (const std::vector<Meter>& meters :
         {std::vector<Meter>{}, {thermometer(1, 20)}}) {
        made.meters = meters;
        const physics::Drive drive = drive_of(made, period);
        EXPECT_EQ(drive.n_warm_up, 240);
        EXPECT_EQ(drive.theta_start, physics::start_temperature);
    }
}

}  // namespace
}  // namespace bemcal::study
