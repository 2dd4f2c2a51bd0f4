/// Functions' columns: their mean and size over training, their ends, their interactions.
#include "functions/basis.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::functions {
namespace {

/// Hours of eight weeks from a Monday, as points of hours_of_week.
std::vector<double> hours() {
    std::vector<double> points;
    for (int day = 0; day < 56; ++day)
        for (int hour = 0; hour < 24; ++hour)
            points.push_back((day % 7 == 5 ? 24 : day % 7 == 6 ? 48 : 0) + hour);
    return points;
}

std::vector<double> swinging(double period) {
    std::vector<double> values;
    for (int k = 0; k < 56 * 24; ++k) values.push_back(10 + 8 * std::sin(k / period));
    return values;
}

/// Mean over the steps of each column, and of their squares' sum.
void expect_centred_and_of_size_one(const Basis& basis,
                                    const std::vector<std::vector<double>>& drivers,
                                    double most_mean = 1e-9) {
    const Matrix columns = columns_of(basis, drivers);
    double squares = 0;
    for (std::size_t c = 0; c < columns.cols; ++c) {
        double sum = 0;
        for (std::size_t k = 0; k < columns.rows; ++k) {
            sum += columns(k, c);
            squares += columns(k, c) * columns(k, c);
        }
        EXPECT_NEAR(sum / static_cast<double>(columns.rows), 0, most_mean)
            << basis.driver;
    }
    // A tenth goes with the components that are left out, and between knots.
    EXPECT_NEAR(squares / static_cast<double>(columns.rows), 1, 0.15) << basis.driver;
}

}  // namespace

TEST(Basis, FunctionsHaveMeanZeroAndMeanSquareOneInTraining) {
    const auto of_hours = hours(), slow = swinging(150);
    expect_centred_and_of_size_one(hours_of_week("hours", of_hours), {of_hours});
    expect_centred_and_of_size_one(smooth_of("slow", slow), {slow});
    std::vector<double> of_day;
    for (const double point : of_hours)
        of_day.push_back(std::fmod(point, 24) + (point >= 24 ? 24 : 0));
    // Its margins are taken off as if the two were independent.
    expect_centred_and_of_size_one(hours_times("both", of_day, slow), {of_day, slow},
                                   0.01);
}

TEST(Basis, HoursFromADayAreNothingBeforeItAndOfSizeOneInTraining) {
    const auto of_hours = hours();
    std::vector<double> years;
    for (std::size_t k = 0; k < of_hours.size(); ++k)
        years.push_back(static_cast<double>(k) / 8766);
    const std::size_t first = of_hours.size() / 4;
    const Matrix columns =
        columns_of(hours_from("hours", of_hours, years, years[first]), {of_hours, years});
    double squares = 0, behind = 0;
    for (std::size_t k = 0; k < columns.rows; ++k)
        for (std::size_t c = 0; c < columns.cols; ++c) {
            squares += columns(k, c) * columns(k, c);
            if (k < first)
                EXPECT_EQ(columns(k, c), 0);
            else
                behind += columns(k, c);
        }
    EXPECT_NEAR(squares / static_cast<double>(columns.rows), 1, 0.15);
    EXPECT_GT(std::abs(behind), 1);  // what all hours share is not taken off
}

TEST(Basis, PointsThatAreGivenHaveTheSameColumns) {
    const auto of_hours = hours(), slow = swinging(150);
    const std::vector<double> years{0, 0.3, 0.7, 1.1, 1.9};
    std::vector<double> of_day;
    for (const double point : of_hours)
        of_day.push_back(std::fmod(point, 24) + (point >= 24 ? 24 : 0));
    const auto expect_same = [](const Basis& one,
                                const std::vector<std::vector<double>>& drivers) {
        const Basis again = basis_at(one.driver, one.points, drivers);
        EXPECT_EQ(again.at_points.values, one.at_points.values) << one.driver;
    };
    expect_same(hours_of_week("hours", of_hours), {of_hours});
    expect_same(smooth_of("slow", slow), {slow});
    expect_same(hours_times("both", of_day, slow), {of_day, slow});
    expect_same(wandering("time", years), {years});
    EXPECT_EQ(basis_at("one", {}, {{0, 0}}).at_points.values, std::vector<double>{1});
}

TEST(Basis, InteractionsHaveNoMeanOverHoursOrOverTheOther) {
    const auto of_hours = hours(), slow = swinging(150);
    std::vector<double> of_day;
    for (const double point : of_hours)
        of_day.push_back(std::fmod(point, 24) + (point >= 24 ? 24 : 0));
    const Basis basis = hours_times("both", of_day, slow);
    // At one hour, over all of the other, and at one point of the other, over all hours.
    const std::size_t n_knots = basis.at_points.rows / 48;
    for (std::size_t c = 0; c < basis.n_columns(); ++c) {
        std::vector<double> share(n_knots, 0.0);
        for (std::size_t k = 0; k < slow.size(); ++k) {
            const Points::Weights w =
                basis.points.weights(std::vector{of_day[k], slow[k]});
            for (std::size_t i = 0; i < 2; ++i)
                share[w.point[i] % n_knots] += w.weight[i];
        }
        for (std::size_t hour = 0; hour < 48; ++hour) {
            double sum = 0;
            for (std::size_t knot = 0; knot < n_knots; ++knot)
                sum += share[knot] * basis.at_points(hour * n_knots + knot, c);
            ASSERT_NEAR(sum / static_cast<double>(slow.size()), 0, 1e-9);
        }
    }
}

// What a report draws between is straight, so that it is the function itself.
TEST(Basis, ItsPointsAreWhereItsColumnsAre) {
    const auto of_hours = hours(), slow = swinging(150);
    std::vector<double> of_day, years;
    for (const double point : of_hours)
        of_day.push_back(std::fmod(point, 24) + (point >= 24 ? 24 : 0));
    for (std::size_t k = 0; k < of_hours.size(); ++k)
        years.push_back(static_cast<double>(k) / (24 * 365.25));
    for (const Basis& basis :
         {hours_of_week("hours", of_hours), smooth_of("slow", slow),
          hours_times("both", of_day, slow), wandering("time", years)}) {
        const Matrix columns = columns_of(basis, basis.points.drivers_at());
        ASSERT_EQ(columns.rows, basis.at_points.rows) << basis.driver;
        for (std::size_t p = 0; p < columns.rows; ++p)
            for (std::size_t c = 0; c < columns.cols; ++c)
                EXPECT_NEAR(columns(p, c), basis.at_points(p, c), 1e-12) << basis.driver;
    }
    EXPECT_TRUE(constant().points.drivers_at().empty());
}

TEST(Basis, BeyondTrainingTheEndsAreHeld) {
    const auto slow = swinging(150);
    const Basis basis = smooth_of("slow", slow);
    const Matrix columns = columns_of(basis, {{18, 30, 100, 2, -40}});
    for (std::size_t c = 0; c < columns.cols; ++c) {
        EXPECT_EQ(columns(0, c), columns(2, c));
        EXPECT_EQ(columns(1, c), columns(2, c));
        EXPECT_EQ(columns(3, c), columns(4, c));
    }
}

TEST(Basis, AWanderingLevelStaysWhereItEnded) {
    std::vector<double> years;
    for (int day = 0; day < 740; ++day) years.push_back(day / 365.25);
    const Basis basis = wandering("time", years);
    const Matrix columns = columns_of(basis, {{years.back(), 2.5, 3, 0, -0.2}});
    for (std::size_t c = 0; c < columns.cols; ++c) {
        EXPECT_EQ(columns(0, c), columns(1, c));
        EXPECT_EQ(columns(0, c), columns(2, c));
        EXPECT_EQ(columns(3, c), columns(4, c));
    }
}

// In less than two years what follows time may be a season: half of each is foretold, as
// often as years pass; where the time of the year was not there, the last level alone.
TEST(Basis, AWanderingLevelOfOneYearMayBeASeason) {
    std::vector<double> years;
    for (int day = 0; day < 300; ++day) years.push_back(day / 365.25);
    const Matrix columns =
        columns_of(wandering("time", years), {{years.back(), 0.3, 1.3, 2.3, 0.95}});
    for (std::size_t c = 0; c < columns.cols; ++c) {
        const double last = columns(0, c), season = columns(1, c);
        EXPECT_NEAR(columns(2, c), 0.5 * (last + season), 1e-12);
        EXPECT_NEAR(columns(3, c), 0.5 * (last + season), 1e-12);
        EXPECT_EQ(columns(4, c), last);
    }
}

TEST(Basis, HasAsManyKnotsAsItMay) {
    const auto slow = swinging(150);
    EXPECT_EQ(smooth_of("slow", slow).points.knots.size(), 8U);
    std::vector<double> of_two_days;
    for (int k = 0; k < 56 * 24; ++k) of_two_days.push_back(k % 48);
    EXPECT_EQ(hours_times("both", of_two_days, slow).points.knots.size(), 5U);
}

TEST(Basis, ADriverThatNeverChangesHasNoFunction) {
    const std::vector<double> same(100, 5.0);
    const Matrix columns = columns_of(smooth_of("same", same), {same});
    for (const double value : columns.values) EXPECT_NEAR(value, 0, 1e-6);
}

}  // namespace bemcal::functions
