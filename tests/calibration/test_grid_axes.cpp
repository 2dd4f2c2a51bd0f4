#include "calibration/grid_axes.hpp"

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using Values = std::vector<double>;

TEST(GridAxes, CountEveryCombinationAndTheLastRunsFastest) {
    const calibration::Grid grid{{1, 2}, {5}, {7, 8, 9}};
    EXPECT_EQ(calibration::size_of(grid), 6U);
    const Matrix points = calibration::points_of(grid, 2, 3);
    EXPECT_EQ(points.values, (Values{1, 5, 9, 2, 5, 7, 2, 5, 8}));
}

// Paper 3, Table 1: 6 x 8 x 4 x 4 x 5 = 3840 jobs.
TEST(GridAxes, ThePapersFirstGridHas3840Points) {
    const calibration::Grid grid{{3, 4, 5, 6, 7, 8},
                                 {3, 4, 5, 6, 7, 8, 9, 10},
                                 {16, 17, 18, 19},
                                 {15, 16, 17, 18},
                                 {1, 3, 5, 7, 9}};
    EXPECT_EQ(calibration::size_of(grid), 3840U);
}

TEST(GridAxes, AGridTooLargeToCountIsStillLarge) {
    EXPECT_GT(calibration::size_of(calibration::Grid(40, Values(1000))),
              std::size_t{1} << 60);
}

// The paper's own example: of lighting, 4 with its neighbours 3 and 5 becomes 3.5,
// 4, 4.5.
TEST(Midpoints, LieBetweenAValueAndItsNeighboursOnTheGrid) {
    EXPECT_EQ(calibration::with_midpoints({3, 4, 5, 6, 7, 8}, {4}, {0, 100}),
              (Values{3.5, 4, 4.5}));
    EXPECT_EQ(calibration::with_midpoints({1, 3, 9}, {3}, {0, 100}), (Values{2, 3, 6}));
}

TEST(Midpoints, LieHalfAStepOutsideAtTheEndsUnlessTheRangeForbidsIt) {
    const Values axis{16, 17, 18, 19};
    EXPECT_EQ(calibration::with_midpoints(axis, {16, 19}, {10, 30}),
              (Values{15.5, 16, 16.5, 18.5, 19, 19.5}));
    EXPECT_EQ(calibration::with_midpoints(axis, {16, 19}, {16, 19.4}),
              (Values{16, 16.5, 18.5, 19}));
}

// The survivors of the paper's Table 2 under its own rule, within the first grid's
// ranges: 8 x 7 x 6 x 4 = 1344, with the air change fixed.
TEST(Midpoints, OfThePapersSurvivorsMake1344Points) {
    const calibration::Grid refined{
        calibration::with_midpoints({3, 4, 5, 6, 7, 8}, {3, 4, 5, 6}, {3, 8}),
        calibration::with_midpoints({3, 4, 5, 6, 7, 8, 9, 10}, {7, 9, 10}, {3, 10}),
        calibration::with_midpoints({16, 17, 18, 19}, {17, 18, 19}, {16, 19}),
        calibration::with_midpoints({15, 16, 17, 18}, {17, 18}, {15, 18}),
        {3}};
    EXPECT_EQ(calibration::size_of(refined), 1344U);
}

TEST(Midpoints, AreNotMadeForOneValueOrWhereOnlyTheGivenOnesMakeSense) {
    EXPECT_EQ(calibration::with_midpoints({3}, {3}, {0, 9}), (Values{3}));
    EXPECT_EQ(calibration::with_midpoints({1, 2, 3}, {2}, {0, 9, false}), (Values{2}));
}

}  // namespace
}  // namespace bemcal::study
