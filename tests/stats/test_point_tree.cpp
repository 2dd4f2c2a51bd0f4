#include "stats/density_avoidance.hpp"
#include "stats/point_tree.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

/// Every answer of the tree against a loop over all points, while points come and go.
void expect_like_a_loop(const Matrix& points, double radius, Stream& random) {
    PointTree tree(points);
    std::vector<char> left(points.rows, 1);
    for (std::size_t round = 0; round < 2 * points.rows; ++round) {
        const std::size_t moved = random.below(points.rows);
        left[moved] = round % 3 == 0 ? 1 : 0;
        left[moved] != 0 ? tree.restore(moved) : tree.remove(moved);
        const auto place = points.row(random.below(points.rows));
        std::size_t count = 0, nearest = PointTree::none;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < points.rows; ++r) {
            ASSERT_EQ(tree.has(r), left[r] != 0);
            if (left[r] == 0) continue;
            const double square = plain_distance(points.row(r), place);
            count += square <= radius * radius ? 1 : 0;
            if (square >= least) continue;
            least = square;
            nearest = r;
        }
        ASSERT_EQ(tree.count_within(place, radius * radius, points.rows), count);
        ASSERT_EQ(tree.count_within(place, radius * radius, 3) > 3, count > 3);
        ASSERT_EQ(tree.nearest(place), nearest);
    }
}

TEST(PointTree, AnswersLikeALoopOverAllPoints) {
    Stream random(1, 0, 0);
    for (const std::size_t d : {1U, 2U, 3U, 6U})
        for (const std::size_t n : {1U, 7U, 9U, 64U, 200U}) {
            expect_like_a_loop(uniform_points(n, d, random), 4, random);
            expect_like_a_loop(clustered_points(n, d, random), 0.5, random);
            expect_like_a_loop(tied_points(n, d, random), 1, random);
            expect_like_a_loop(Matrix(n, d, 1.0), 0, random);
        }
}

TEST(PointTree, FindsNothingWhereNothingIsLeft) {
    PointTree tree(Matrix(2, 2, 1.0));
    tree.remove(0);
    tree.remove(1);
    const std::vector<double> place{1, 1};
    EXPECT_EQ(tree.nearest(place), PointTree::none);
    EXPECT_EQ(tree.count_within(place, 100, 10), 0U);
}

}  // namespace
}  // namespace bemcal::stats
