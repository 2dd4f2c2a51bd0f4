/// The optimisers for one objective. The counts of 20 seeds are for these seeds; that
/// they hold for others, too, is what bench_optimisers prints.
#include "optimise/facades.hpp"
#include "optimise/functions.hpp"
#include "optimise/methods.hpp"

#include <gtest/gtest.h>

namespace bemcal::optimise {
namespace {

constexpr int n_seeds = 20;
constexpr std::size_t budget = 50000;

MethodOptions options_of(std::uint64_t seed, MethodKind kind) {
    MethodOptions options;
    options.kind = kind;
    options.seed = seed;
    return options;
}

Method hybrid(std::uint64_t seed) {
    return make_method(options_of(seed, MethodKind::swarm_then_pattern));
}

auto of(test::Problem (*make)(std::size_t, std::uint64_t), std::size_t d) {
    return [make, d](std::uint64_t seed) { return make(d, seed); };
}

double bowl(std::span<const double> x) {
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
        sum += (x[k] - 0.3) * (x[k] - 0.3) * static_cast<double>(k + 1);
    return sum;
}

Optimiser bowl_optimiser(std::size_t d, MethodKind kind, std::size_t evaluations) {
    Limits limits;
    limits.evaluations = evaluations;
    return {Space(std::vector<Variable>(d)), 1, limits, make_method(options_of(3, kind))};
}

TEST(Hybrid, SolvesRosenbrockInTenDimensions) {
    EXPECT_GE(test::trials(of(test::rosenbrock, 10), hybrid, n_seeds, budget).n_successes,
              16);
}

TEST(Hybrid, SolvesRastriginInFiveDimensionsEveryTime) {
    EXPECT_EQ(test::trials(of(test::rastrigin, 5), hybrid, n_seeds, budget).n_successes,
              n_seeds);
}

TEST(Hybrid, FindsTheEnumeratedOptimumOfMixedVariablesEveryTime) {
    EXPECT_EQ(test::trials(test::facade, hybrid, n_seeds, budget).n_successes, n_seeds);
}

TEST(Hybrid, FindsTheOptimumOfMillionsOfCombinationsMostly) {
    EXPECT_GE(test::trials(test::facades, hybrid, n_seeds, budget).n_successes, 16);
}

TEST(Hybrid, ComesCloseOnGriewankInFiveDimensions) {
    const auto all = test::trials(of(test::griewank, 5), hybrid, 8, budget);
    EXPECT_LE(test::median(all.errors), 0.03);
}

/// All that it asks of a bowl, in its order.
std::vector<double> points_of(const MethodOptions& options) {
    Optimiser optimiser(Space(std::vector<Variable>(4)), 1, {5000}, make_method(options));
    std::vector<double> all;
    test::run(optimiser, [&](std::span<const double> x) {
        all.insert(all.end(), x.begin(), x.end());
        return bowl(x);
    });
    return all;
}

TEST(Hybrid, AsksTheSameOfTheSameSeedOnly) {
    const auto of_seed = [](std::uint64_t seed) {
        return points_of(options_of(seed, MethodKind::swarm_then_pattern));
    };
    EXPECT_EQ(of_seed(1), of_seed(1));
    EXPECT_NE(of_seed(1), of_seed(2));
}

TEST(Hybrid, WithoutKicksEndsAfterTheSameStart) {
    MethodOptions options = options_of(1, MethodKind::swarm_then_pattern);
    const std::vector<double> all = points_of(options);
    options.with_kicks = false;
    const std::vector<double> start = points_of(options);
    ASSERT_LT(start.size(), all.size());
    EXPECT_TRUE(std::ranges::equal(start, std::span(all).first(start.size())));
}

TEST(Hybrid, StartsAtTheDescribedPoint) {
    const Optimiser optimiser(Space({{10, 20, {}, 11}, {0, 1, {5, 7, 9}, 8.8}}), 1, {},
                              hybrid(1));
    EXPECT_NEAR(optimiser.next_points()(0, 0), 11, 0.5 * 0x1p-12 * 10);  // on the mesh
    EXPECT_EQ(optimiser.next_points()(0, 1), 9);
}

TEST(Hybrid, StaysInTheRangesAndTables) {
    Optimiser optimiser(Space({{-2, 3}, {0, 1, {5, 7, 9}}}), 1, {400}, hybrid(4));
    for (Matrix points = optimiser.next_points(); points.rows > 0;
         points = optimiser.next_points()) {
        for (std::size_t r = 0; r < points.rows; ++r) {
            EXPECT_GE(points(r, 0), -2);
            EXPECT_LE(points(r, 0), 3);
            EXPECT_TRUE(points(r, 1) == 5 || points(r, 1) == 7 || points(r, 1) == 9);
        }
        optimiser.tell(Matrix(points.rows, 1, 1.0));
    }
}

TEST(Hybrid, EndsWhenAllPointsOfSmallTablesAreKnown) {
    Optimiser optimiser(Space({{0, 1, {1, 2, 3}}, {0, 1, {1, 2}}}), 1, {}, hybrid(1));
    test::run(optimiser, [](std::span<const double> x) { return -x[0] * x[1]; });
    EXPECT_LE(optimiser.n_evaluated(), 6U);
    EXPECT_EQ(optimiser.found_points().values, (std::vector<double>{3, 2}));
}

TEST(Hybrid, KnowsAllOfASmallSpaceAtItsEnd) {
    Stream random(1, 0, 0);
    Optimiser optimiser(Space(std::vector<Variable>(6, test::one_of(3))), 1, {},
                        hybrid(1));
    test::run(optimiser, [&](std::span<const double>) { return random.uniform(); });
    EXPECT_EQ(optimiser.n_evaluated(), 729U);
}

TEST(Hybrid, TakesFailedPointsAsInfinitelyBad) {
    Optimiser optimiser(Space(std::vector<Variable>(2)), 1, {2000}, hybrid(1));
    test::run(optimiser, [](std::span<const double> x) {
        return x[0] < 0.4 ? std::nan("") : bowl(x);
    });
    EXPECT_NEAR(optimiser.found_points()(0, 0), 0.4, 1e-4);
    EXPECT_NEAR(optimiser.found_points()(0, 1), 0.3, 1e-4);
}

TEST(Hybrid, GoesOnWhereEveryPointFails) {
    Optimiser optimiser(Space(std::vector<Variable>(2)), 1, {300}, hybrid(1));
    test::run(optimiser, [](std::span<const double>) { return std::nan(""); });
    EXPECT_EQ(optimiser.n_evaluated(), 300U);
    EXPECT_TRUE(std::isinf(optimiser.found()[0].objectives[0]));
}

TEST(EveryMethod, FindsTheBottomOfABowl) {
    for (const auto kind :
         {MethodKind::swarm_then_pattern, MethodKind::swarm, MethodKind::pattern}) {
        Optimiser optimiser = bowl_optimiser(3, kind, 8000);
        test::run(optimiser, bowl);
        EXPECT_LT(optimiser.found()[0].objectives[0], 1e-5) << static_cast<int>(kind);
    }
}

TEST(EveryMethod, SpendsNoMoreThanItsBudget) {
    for (const auto kind :
         {MethodKind::swarm_then_pattern, MethodKind::swarm, MethodKind::pattern})
        for (const std::size_t budget_of : {1U, 31U, 100U}) {
            Optimiser optimiser = bowl_optimiser(5, kind, budget_of);
            test::run(optimiser, bowl);
            EXPECT_EQ(optimiser.n_evaluated(), budget_of);
        }
}

TEST(EveryMethod, NeverAsksForAPointTwice) {
    for (const auto kind :
         {MethodKind::swarm_then_pattern, MethodKind::swarm, MethodKind::pattern}) {
        Optimiser optimiser = bowl_optimiser(2, kind, 3000);
        std::set<std::vector<double>> seen;
        std::size_t n = 0;
        test::run(optimiser, [&](std::span<const double> x) {
            seen.insert({x.begin(), x.end()});
            ++n;
            return bowl(x);
        });
        EXPECT_EQ(seen.size(), n);
    }
}

TEST(PatternSearch, HalvesItsStepToTheLast) {
    MethodOptions options = options_of(1, MethodKind::pattern);
    options.pattern = {0.25, 0.125};
    Optimiser optimiser(Space(std::vector<Variable>(1, {0, 1})), 1, {},
                        make_method(options));
    test::run(optimiser, bowl);  // 0.5, then 0.25; 0.75; 0; 0.125; 0.375
    EXPECT_EQ(optimiser.found_points()(0, 0), 0.25);
    EXPECT_EQ(optimiser.n_evaluated(), 6U);
}

TEST(PatternSearch, LeavesWhatIsHeldWhereItIs) {
    MethodOptions options = options_of(1, MethodKind::pattern);
    options.pattern.held = {false, true, false};
    Optimiser optimiser(Space(std::vector<Variable>(3)), 1, {}, make_method(options));
    test::run(optimiser, [](std::span<const double> x) {
        EXPECT_EQ(x[1], 0.5);
        return bowl(x);
    });
    EXPECT_NEAR(optimiser.found_points()(0, 0), 0.3, 1e-5);
    EXPECT_NEAR(optimiser.found_points()(0, 2), 0.3, 1e-5);
}

TEST(Space, RefusesAVariableWithoutARange) {
    EXPECT_THROW(Space({}), std::invalid_argument);
    EXPECT_THROW(Space({{1, 1}}), std::invalid_argument);
    EXPECT_THROW(Space({{0, std::nan("")}}), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::optimise
