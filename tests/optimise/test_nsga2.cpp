#include "optimise/fronts.hpp"
#include "optimise/functions.hpp"
#include "optimise/nsga2.hpp"

#include <gtest/gtest.h>

namespace bemcal::optimise {
namespace {

Matrix rows(std::initializer_list<std::array<double, 2>> points) {
    Matrix matrix(0, 2);
    for (const auto& point : points) {
        matrix.values.insert(matrix.values.end(), point.begin(), point.end());
        ++matrix.rows;
    }
    return matrix;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Fronts, PeelOffWhatNothingDominates) {
    const auto fronts = sort_into_fronts(
        rows({{1, 4}, {2, 2}, {4, 1}, {3, 3}, {5, 5}, {2, 2}, {infinity, infinity}}));
    using Rows = std::vector<std::size_t>;
    EXPECT_EQ(fronts, (std::vector<Rows>{{0, 1, 2, 5}, {3}, {4}, {6}}));
}

/// A front is what a plain search for undominated rows finds, again and again.
TEST(Fronts, EqualAPlainSearch) {
    Stream random(1, 0, 0);
    Matrix objectives(80, 3);
    for (double& value : objectives.values)
        value = std::floor(6 * random.uniform());  // with ties
    std::vector<bool> gone(80);
    for (const auto& front : sort_into_fronts(objectives)) {
        std::vector<std::size_t> expected;
        for (std::size_t r = 0; r < 80; ++r) {
            bool is_dominated = gone[r];
            for (std::size_t o = 0; o < 80 && !is_dominated; ++o)
                is_dominated =
                    !gone[o] && dominates(objectives.row(o), objectives.row(r));
            if (!is_dominated) expected.push_back(r);
        }
        EXPECT_EQ(front, expected);
        for (const std::size_t r : front) gone[r] = true;
    }
    EXPECT_EQ(std::ranges::count(gone, true), 80);
}

TEST(Crowding, IsTheSidesOfTheBoxBetweenNeighbours) {
    const Matrix objectives = rows({{0, 10}, {1, 6}, {4, 5}, {10, 0}});
    const std::vector<std::size_t> front{0, 1, 2, 3};
    const auto crowding = crowding_of(objectives, front);
    EXPECT_EQ(crowding[0], infinity);
    EXPECT_DOUBLE_EQ(crowding[1], 0.4 + 0.5);
    EXPECT_DOUBLE_EQ(crowding[2], 0.9 + 0.6);
    EXPECT_EQ(crowding[3], infinity);
}

TEST(Hypervolume, IsTheAreaOfTheSteps) {
    EXPECT_DOUBLE_EQ(test::hypervolume(rows({{1, 3}, {2, 1}, {2, 2}, {5, 0}}), 4, 4),
                     3 * 1 + 2 * 2);
    EXPECT_EQ(test::hypervolume(rows({{5, 5}}), 4, 4), 0);
}

/// Zitzler, Deb and Thiele 2000; Deb et al. 2002 run it with 100 x 250.
TEST(Nsga2, CoversTheFrontOfZdt1) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Nsga2Options options;
        options.seed = seed;
        const Matrix front = test::run_zdt1(make_nsga2(options));
        EXPECT_GE(test::hypervolume(front, 1.1, 1.1), 0.99 * test::zdt1_hypervolume);
    }
}

/// Schaffer's problem with x from a table: the front is x = 0 .. 2.
TEST(Nsga2, FindsAFrontOfDiscreteVariables) {
    Variable x;
    for (int k = -40; k <= 40; ++k) x.values.push_back(0.25 * k);
    Nsga2Options options{20, 30};
    Optimiser optimiser(Space({x, {0, 1}}), 2, {}, make_nsga2(options));
    for (Matrix points = optimiser.next_points(); points.rows > 0;
         points = optimiser.next_points()) {
        Matrix values(points.rows, 2);
        for (std::size_t r = 0; r < points.rows; ++r) {
            values(r, 0) = std::pow(points(r, 0), 2) + points(r, 1);
            values(r, 1) = std::pow(points(r, 0) - 2, 2) + points(r, 1);
        }
        optimiser.tell(values);
    }
    const Matrix found = optimiser.found_points();
    ASSERT_GT(found.rows, 5U);
    for (std::size_t r = 0; r < found.rows; ++r) {
        EXPECT_GE(found(r, 0), -0.25);
        EXPECT_LE(found(r, 0), 2.25);
        EXPECT_LT(found(r, 1), 0.05);
    }
}

/// Of one variable with few values, so that children are often their parents.
TEST(Nsga2, APointIsInTheFrontOnce) {
    Variable x;
    for (int k = 0; k <= 4; ++k) x.values.push_back(0.5 * k);
    Optimiser optimiser(Space({x}), 2, {}, make_nsga2({20, 10}));
    for (Matrix points = optimiser.next_points(); points.rows > 0;
         points = optimiser.next_points()) {
        Matrix values(points.rows, 2);
        for (std::size_t r = 0; r < points.rows; ++r) {
            values(r, 0) = std::pow(points(r, 0), 2);
            values(r, 1) = std::pow(points(r, 0) - 2, 2);
        }
        optimiser.tell(values);
    }
    std::vector<double> front = optimiser.found_points().values;
    std::ranges::sort(front);
    EXPECT_EQ(front, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
}

TEST(Nsga2, RefusesAnOddPopulation) {
    EXPECT_THROW(make_nsga2({3, 10}), std::invalid_argument);
    EXPECT_THROW(make_nsga2({7, 10}), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::optimise
