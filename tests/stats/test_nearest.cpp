#include "stats/density_avoidance.hpp"

#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

using Points = Matrix (*)(std::size_t, std::size_t, Stream&);

/// Against the plain transcription, in several dimensions, radii and thresholds.
void expect_plain_result(Points make, std::size_t n) {
    Stream random(7, 1, n);
    std::size_t n_tagged = 0;
    for (const std::size_t d : {1U, 2U, 3U, 4U, 7U})
        for (const double radius : {0.05, 0.5, 2.5, 40.0})
            for (const double threshold : {0.0, 0.01, 0.5}) {
                const Matrix points = make(n, d, random);
                const std::vector<double> reference(d, 0.25);
                const NearestOptions options{9, CountRule::given, radius, threshold};
                const Selection fast =
                    nearest_avoiding_density(points, reference, options);
                const auto tags = plain_tags(points, reference, {radius, threshold});
                ASSERT_EQ(fast.is_high_density, tags) << d << " " << radius;
                ASSERT_EQ(fast.nearest, plain_nearest(points, reference, tags, 9));
                n_tagged += static_cast<std::size_t>(std::ranges::count(tags, 1));
            }
    EXPECT_GT(n_tagged, n);  // or nothing was compared
}

TEST(DensityAvoidance, EqualsThePlainTranscriptionOnRandomPoints) {
    expect_plain_result(uniform_points, 300);
}

TEST(DensityAvoidance, EqualsThePlainTranscriptionOnClusteredPoints) {
    expect_plain_result(clustered_points, 400);
}

TEST(DensityAvoidance, EqualsThePlainTranscriptionWhereDistancesAreEqual) {
    expect_plain_result(tied_points, 250);
}

TEST(DensityAvoidance, EqualsThePlainTranscriptionByItsOwnRule) {
    Stream random(8, 1, 0);
    for (const Points make : {uniform_points, clustered_points, tied_points})
        for (const std::size_t d : {1U, 2U, 5U}) {
            const Matrix points = make(500, d, random);
            const std::vector<double> reference(d, 0.5);
            const Selection fast = nearest_avoiding_density(points, reference, {});
            const auto tags = plain_tags(points, reference, fast.crowding);
            EXPECT_EQ(fast.is_high_density, tags);
            EXPECT_EQ(fast.nearest, plain_nearest(points, reference, tags, 7));
        }
}

// By hand on a line, radius 1, n = 6, length of the 1-ball 2: one neighbour within the
// radius is a density of 1/12, two are 1/6. Visits: 0 at 0.1 has 1 at 0.6 and 2 at 1.0
// and tags 1; 2 then has 0 alone; 3 at 5 has 4 and 5 and tags 4; 5 has 3 alone.
TEST(DensityAvoidance, TagsTheVisitedPointsNearestNeighbourWhereItIsCrowded) {
    Matrix points(6, 1);
    points.values = {0.1, 0.6, 1.0, 5, 5.5, 5.9};
    const std::vector<double> origin{0};
    const Selection found =
        nearest_avoiding_density(points, origin, {4, CountRule::given, 1.0, 0.1});
    EXPECT_EQ(found.is_high_density, (std::vector<char>{0, 1, 0, 0, 1, 0}));
    EXPECT_EQ(found.nearest, (std::vector<std::size_t>{0, 2, 3, 5}));
    EXPECT_EQ(nearest(points, origin, 4), (std::vector<std::size_t>{0, 1, 2, 3}));
}

// One neighbour is a density of 1/4/2 = 0.125, two are 0.25: only the visit to the second
// point sees two, and tags the nearer of them, which may be the first.
TEST(DensityAvoidance, MayTagAPointThatWasVisitedBefore) {
    Matrix points(4, 1);
    points.values = {0, 0.9, 1.7, 9};
    const std::vector<double> origin{0};
    const Selection found =
        nearest_avoiding_density(points, origin, {3, CountRule::given, 1.0, 0.2});
    EXPECT_EQ(found.is_high_density, (std::vector<char>{0, 0, 1, 0}));
    points.values = {0, 0.7, 1.7, 9};
    EXPECT_EQ(nearest_avoiding_density(points, origin, {3, CountRule::given, 1.0, 0.2})
                  .is_high_density,
              (std::vector<char>{1, 0, 0, 0}));
}

// At one place: the first tags the second, then the third tags the first.
TEST(DensityAvoidance, TakesFewerThanKWhereTheOthersAreTagged) {
    const Matrix points(3, 2, 1.0);
    const std::vector<double> reference{0, 0};
    const Selection found =
        nearest_avoiding_density(points, reference, {3, CountRule::given, 0.5, 0.1});
    EXPECT_EQ(found.nearest, (std::vector<std::size_t>{2}));
}

TEST(DensityAvoidance, FindsNothingCrowdedWhereTheKthLiesOnTheReference) {
    Matrix points(10, 2, 1.0);
    const std::vector<double> reference{1, 1};
    const Selection found = nearest_avoiding_density(points, reference, {});
    EXPECT_EQ(found.nearest, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(DensityAvoidance, ItsRuleIsHalfTheDistanceOfTheKthAndTheDensityThere) {
    Matrix points(100, 2, 50.0);
    for (std::size_t r = 0; r < 7; ++r)
        points(r, 0) = points(r, 1) = static_cast<double>(r + 1);
    const std::vector<double> origin{0, 0};
    const Crowding rule = default_crowding(points, origin, {});
    EXPECT_DOUBLE_EQ(rule.radius, 7 * std::numbers::sqrt2 / 2);
    EXPECT_NEAR(rule.threshold, 0.07 / (std::numbers::pi * 98), 1e-12);
    const Crowding half_given =
        default_crowding(points, origin, {7, CountRule::given, 3.0, std::nullopt});
    EXPECT_EQ(half_given.radius, 3);
    EXPECT_EQ(half_given.threshold, rule.threshold);
}

TEST(NeighbourCount, IsAsGivenOrTheSquareRootButNotMoreThanThereAre) {
    EXPECT_EQ(neighbour_count({}, 3840), 7U);
    EXPECT_EQ(neighbour_count({}, 5), 5U);
    NearestOptions options;
    options.count_rule = CountRule::square_root;
    EXPECT_EQ(neighbour_count(options, 3840), 62U);  // as the paper has it
}

TEST(BallVolume, IsThatOfIntervalDiscAndBall) {
    EXPECT_DOUBLE_EQ(ball_volume(1, 3), 6);
    EXPECT_DOUBLE_EQ(ball_volume(2, 3), 9 * std::numbers::pi);
    EXPECT_NEAR(ball_volume(3, 3), 36 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(ball_volume(10, 1), std::pow(std::numbers::pi, 5) / 120, 1e-12);
}

TEST(Nearest, RefusesWhatIsNoNumber) {
    Matrix points(2, 1, 1.0);
    points.values[1] = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> origin{0}, plane{0, 0};
    EXPECT_THROW(nearest(points, origin, 1), std::invalid_argument);
    EXPECT_THROW(nearest_avoiding_density(points, origin, {}), std::invalid_argument);
    points.values[1] = 2;
    EXPECT_THROW(nearest(points, plane, 1), std::invalid_argument);
    EXPECT_THROW(
        nearest_avoiding_density(points, origin, {1, CountRule::given, -1.0, 1.0}),
        std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::stats
