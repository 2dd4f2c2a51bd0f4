/// Intervals of readings hold what they say, by level, by day and by night, and by month.
#include "base/random.hpp"
#include "loop/level_change.hpp"
#include "loop/reading_bands.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

constexpr int n_hours = 8760;

/// A load by day, whose errors are a tenth of it; at night 1 with errors of 0.5.
UnseenHours hours_of(std::uint64_t seed) {
    UnseenHours hours;
    Stream stream(seed, 0, 0);
    for (int k = 0; k < n_hours; ++k) {
        const bool is_day = k % 24 >= 7 && k % 24 < 19;
        const double load = is_day ? 20 + 10 * std::sin(k / 1390.0) : 1;
        hours.begins.push_back(physics::parse_time("2021-01-01") + std::chrono::hours(k));
        hours.predicted.push_back(load);
        hours.residuals.push_back((stream.uniform() - 0.5) * (is_day ? 0.2 * load : 1));
    }
    return hours;
}

double coverage(const ReadingBands& bands, const UnseenHours& hours, bool by_day) {
    double inside = 0, n = 0;
    for (int k = 0; k < n_hours; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if ((k % 24 >= 7 && k % 24 < 19) != by_day) continue;
        const Band band = bands.hour(hours.predicted[at], hours.begins[at]);
        const double reading = hours.predicted[at] + hours.residuals[at];
        inside += reading >= band.least && reading <= band.most ? 1 : 0;
        n += 1;
    }
    return inside / n;
}

// Of 4,380 hours: 0.01 is two standard errors, so that a year in twenty is outside.
TEST(ReadingBands, HoldNineTenthsOfAnotherYear) {
    const ReadingBands bands(hours_of(1), false);
    EXPECT_NEAR(coverage(bands, hours_of(2), true), 0.9, 0.02);
    EXPECT_NEAR(coverage(bands, hours_of(2), false), 0.9, 0.02);
}

TEST(ReadingBands, AreWiderWhereErrorsAreLarger) {
    const ReadingBands bands(hours_of(1), false);
    const auto noon = physics::parse_time("2021-06-01T12:00"),
               night = physics::parse_time("2021-06-01T02:00");
    const auto width = [&](double predicted, physics::Seconds time) {
        const Band band = bands.hour(predicted, time);
        return band.most - band.least;
    };
    EXPECT_NEAR(width(29, noon), 0.9 * 0.2 * 29, 0.4);
    EXPECT_NEAR(width(11, noon), 0.9 * 0.2 * 11, 0.4);
    EXPECT_NEAR(width(1, night), 0.9, 0.05);
}

TEST(ReadingBands, DayIsFromSevenToNineteen) {
    UnseenHours hours = hours_of(1);
    for (std::size_t k = 0; k < hours.residuals.size(); ++k) {
        const bool is_day = k % 24 >= 7 && k % 24 < 19;
        hours.predicted[k] = 5;
        hours.residuals[k] = (is_day ? 4 : 1) * (k % 2 == 0 ? 1 : -1);
    }
    const ReadingBands bands(hours, false);
    const auto most_at = [&](const char* time) {
        return bands.hour(5, physics::parse_time(time)).most - 5;
    };
    EXPECT_EQ(most_at("2021-06-01T06:00"), 1);
    EXPECT_EQ(most_at("2021-06-01T07:00"), 4);
    EXPECT_EQ(most_at("2021-06-01T18:00"), 4);
    EXPECT_EQ(most_at("2021-06-01T19:00"), 1);
}

TEST(ReadingBands, ShareWithinCountsWhatIsKnown) {
    const double unknown = std::nan("");
    const std::vector<Band> bands = {{0, 2}, {0, 2}, {0, 2}, {unknown, unknown}};
    EXPECT_EQ(share_within(bands, std::vector<double>{2, 2.1, unknown, 1}), 0.5);
    EXPECT_TRUE(std::isnan(share_within({}, {})));
}

// Errors of an hour that are independent: 730 of them have a sum of sqrt(730).
TEST(ReadingBands, OfMonthsGrowWithTheRootOfTheSum) {
    UnseenHours hours = hours_of(1);
    for (std::size_t k = 0; k < hours.residuals.size(); ++k) {
        hours.predicted[k] = 4;
        hours.residuals[k] = k % 2 == 0 ? 1 : -1;
        if (k / 730 % 2 == 0) hours.residuals[k] += 0.1;  // 73 in every other month
    }
    const ReadingBands bands(hours, false);
    const double whole = bands.month(2920).most - 2920;
    EXPECT_NEAR(whole, 1.645 * 73 / std::sqrt(2), 8);
    EXPECT_NEAR((bands.month(730).most - 730) / whole, 0.5, 1e-9);
}

// A level adds to errors in squares, on both sides.
TEST(ReadingBands, AreWiderByTheLevelOfAnotherYear) {
    const ReadingBands bands(hours_of(1), false);
    const auto noon = physics::parse_time("2021-06-01T12:00");
    const Band own = bands.hour(29, noon), other = bands.hour(29, noon, 0.06);
    const double of_level = 1.645 * 0.06 * 29;
    EXPECT_NEAR(other.most - 29, std::hypot(own.most - 29, of_level), 1e-9);
    EXPECT_NEAR(29 - other.least, std::hypot(29 - own.least, of_level), 1e-9);
    const Band month = bands.month(1000, 0.06);
    EXPECT_NEAR(month.most - 1000, std::hypot(bands.month(1000).most - 1000, 1.645 * 60),
                1e-9);
}

// Where nothing is ever read below the prediction, another year's level still may be.
TEST(ReadingBands, ALevelWidensBothSidesAlsoWhereErrorsHaveOneSign) {
    UnseenHours hours = hours_of(1);
    const auto noon = physics::parse_time("2021-06-01T12:00");
    const double of_level = 1.645 * 0.06 * 20;
    for (const double least : {0.0, 1.0, -3.0}) {
        for (std::size_t k = 0; k < hours.residuals.size(); ++k) {
            hours.predicted[k] = 20;
            hours.residuals[k] = least + (k % 2 == 0 ? 0 : 2);
        }
        const double nearest = least > 0 ? least : least + 2 < 0 ? least + 2 : 0;
        const Band band = ReadingBands(hours, false).hour(20, noon, 0.06);
        EXPECT_NEAR(20 + nearest - band.least, std::hypot(nearest - least, of_level),
                    1e-3);
        EXPECT_NEAR(band.most - 20 - nearest, std::hypot(least + 2 - nearest, of_level),
                    1e-3);
    }
}

TEST(ReadingBands, UsualChangesAreOfEnergies) {
    EXPECT_EQ(usual_level_change(physics::Quantity::electricity), 0.06);
    EXPECT_EQ(usual_level_change(physics::Quantity::gas), 0.18);
    EXPECT_EQ(usual_level_change(physics::Quantity::heating), 0.18);
    EXPECT_EQ(usual_level_change(physics::Quantity::air_temperature), 0);
}

TEST(ReadingBands, OfTooFewReadingsAreNotKnown) {
    UnseenHours few = hours_of(1);
    for (std::size_t k = 49; k < few.residuals.size(); ++k)
        few.residuals[k] = std::nan("");
    EXPECT_TRUE(std::isnan(ReadingBands(few, true).hour(20, few.begins[0]).least));
    few.residuals[49] = 0;
    EXPECT_FALSE(std::isnan(ReadingBands(few, true).hour(20, few.begins[0]).least));
}

}  // namespace
}  // namespace bemcal::loop
