/// Points of functions: between them, at them and beyond.
#include "functions/points.hpp"

#include <gtest/gtest.h>

namespace bemcal::functions {
namespace {

using Series = std::vector<std::vector<double>>;

std::vector<Points> one_of_each() {
    return {{Points::Kind::hours},
            {Points::Kind::knots, {-5, 0, 20}},
            {Points::Kind::hours_at_knots, {0, 10}},
            {Points::Kind::fortnights, {}, 30}};
}

TEST(Points, HaveTheirValuesWhereTheyLie) {
    for (const Points& points : one_of_each()) {
        std::vector<double> values;
        for (std::size_t p = 0; p < points.size(); ++p)
            values.push_back(static_cast<double>(p * p) - 3);
        EXPECT_EQ(function_over(points, values, points.drivers_at()), values);
    }
}

TEST(Points, HoursFromADayAreNothingBeforeIt) {
    const Points points{Points::Kind::hours_from, {0.5}};
    std::vector<double> values(72, 1);
    values[30] = 4;
    EXPECT_EQ(function_over(points, values, Series{{7, 7, 30, 30}, {0, 0.5, 0.49, 9}}),
              (std::vector<double>{0, 1, 0, 4}));
    EXPECT_EQ(points.drivers_at().size(), 1U);
}

TEST(Points, WeightsSumToOne) {
    for (const Points& points : one_of_each())
        for (const double at : {0.0, 0.3, 1.7, 7.0, 23.0})
            for (const double other : {-10.0, 3.0, 10.0, 99.0}) {
                const auto w = points.weights(std::vector{at, other});
                EXPECT_DOUBLE_EQ(w.weight[0] + w.weight[1], 1);
                for (const std::size_t p : w.point) EXPECT_LT(p, points.size());
            }
}

TEST(Points, AreStraightBetweenKnotsAndLevelBeyond) {
    const Points points{Points::Kind::knots, {-5, 0, 20}};
    EXPECT_EQ(function_over(points, std::vector<double>{1, 2, 4},
                            Series{{-99, -5, -2.5, 0, 5, 20, 99}}),
              (std::vector<double>{1, 1, 1.5, 2, 2.5, 4, 4}));
}

TEST(Points, TheConstantFollowsNothing) {
    EXPECT_EQ(function_over({}, std::vector<double>{7}, Series{{3, -1}}),
              (std::vector<double>{7, 7}));
    EXPECT_TRUE(Points{}.drivers_at().empty());
}

// A year of 26 fortnights: the half after it may be a season or a level. Of three years
// the level goes on.
TEST(Points, InUnderTwoYearsALevelMayBeASeason) {
    std::vector<double> values(26, 0.0);
    values[5] = 8;
    values[25] = 2;
    const double in_fortnight_5 = 5.5 / fortnights_of_year;
    const Series drivers{{in_fortnight_5, 1 + in_fortnight_5, 1.5}};
    EXPECT_EQ(function_over({Points::Kind::fortnights, {}, 26}, values, drivers),
              (std::vector<double>{8, 5, 1}));
    values.assign(79, 0.0);
    values[78] = 2;
    EXPECT_EQ(function_over({Points::Kind::fortnights, {}, 79}, values, Series{{3.5}}),
              std::vector<double>{2});
}

// 52 fortnights are shorter than two years, 53 are longer.
TEST(Points, TwoYearsShowASeason) {
    const auto goes_on = [](std::size_t n) {
        std::vector<double> values(n, 0.0);
        values.back() = 2;
        return function_over({Points::Kind::fortnights, {}, n}, values, Series{{2.5}})[0];
    };
    EXPECT_EQ(goes_on(52), 1);
    EXPECT_EQ(goes_on(53), 2);
}

}  // namespace
}  // namespace bemcal::functions
