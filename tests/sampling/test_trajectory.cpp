/// The iterative checks for U-turns against all checks made plainly, and the weights.
#include "sampling/normal.hpp"
#include "sampling/trajectory.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

using Momenta = std::vector<std::vector<double>>;

std::vector<double> sum_of(const Momenta& p, std::size_t first, std::size_t end) {
    std::vector<double> sum(p[0].size());
    for (std::size_t k = first; k < end; ++k)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += p[k][i];
    return sum;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

bool goes_on(const Momenta& p, std::size_t first, std::size_t last) {
    const auto sum = sum_of(p, first, last + 1);
    return dot(p[first], sum) > 0 && dot(p[last], sum) > 0;
}

/// Stan's build_tree and its three criteria, on leaves [first, first + size).
bool turns_plainly(const Momenta& p, std::size_t first, std::size_t size) {
    if (size == 1) return false;
    const std::size_t half = size / 2, last = first + size - 1;
    if (turns_plainly(p, first, half) || turns_plainly(p, first + half, half))
        return true;
    return !(goes_on(p, first, last) && goes_on(p, first, first + half) &&
             goes_on(p, first + half - 1, last));
}

/// Leaves until a subtree of so many turns.
std::size_t first_turn_plainly(const Momenta& p) {
    for (std::size_t n = 1; n <= p.size(); ++n)
        for (std::size_t size = 2; size <= n; size *= 2)
            if (n % size == 0 && turns_plainly(p, n - size, size)) return n;
    return p.size() + 1;
}

/// Momenta that turn slowly, so that U-turns come at all sizes.
Momenta slow_momenta(Stream& random, std::size_t n, double turn) {
    Momenta p;
    const double phase = random.uniform() * 6;
    for (std::size_t k = 0; k < n; ++k) {
        const double angle = phase + turn * static_cast<double>(k);
        p.push_back({std::cos(angle) + 0.1 * standard_normal(random),
                     std::sin(angle) + 0.1 * standard_normal(random),
                     0.3 * standard_normal(random)});
    }
    return p;
}

/// Grows a subtree of 2^depth leaves from these momenta; how many it takes.
std::size_t first_turn(const Momenta& p, int depth, Stream& random) {
    Trajectory tree(1, 3, depth + 1);
    tree.root().momentum = {1, 0, 0};
    tree.begin();
    for (int d = 0; d < depth; ++d) {  // straight on, to the depth wanted
        tree.begin_subtree(random);
        while (!tree.subtree_is_complete()) {
            tree.edge().momentum = {1, 0, 0};
            EXPECT_TRUE(tree.add_leaf(random));
        }
        EXPECT_TRUE(tree.join(random));
    }
    tree.begin_subtree(random);
    for (std::size_t n = 1; n <= p.size(); ++n) {
        tree.edge().momentum = p[n - 1];
        if (!tree.add_leaf(random)) return n;
    }
    EXPECT_TRUE(tree.subtree_is_complete());
    return p.size() + 1;
}

TEST(Trajectory, TurnsWhereTheRecursionTurns) {
    Stream random(1, 2, 3);
    std::vector<int> found(66);
    for (int repeat = 0; repeat < 2000; ++repeat) {
        const Momenta p = slow_momenta(random, 64, 3.1 * std::pow(random.uniform(), 4));
        const std::size_t expected = first_turn_plainly(p);
        ASSERT_EQ(first_turn(p, 6, random), expected);
        ++found[expected];
    }
    // The comparison saw turns of all sizes, and none.
    for (const std::size_t n : {2, 4, 8, 16, 32, 65}) EXPECT_GT(found[n], 0) << n;
}

/// A trajectory of three points, two of them new.
double third_point_share(double energy_of_third) {
    int n_third = 0;
    constexpr int n = 20'000;
    for (int k = 0; k < n; ++k) {
        Stream random(5, 0, static_cast<std::uint64_t>(k));
        Trajectory tree(1, 1, 2);
        tree.root().momentum = {1};
        tree.root().point.x = {0};
        tree.begin();
        tree.begin_subtree(random);
        tree.edge().point.x = {1};
        tree.add_leaf(random);
        tree.join(random);
        tree.begin_subtree(random);
        for (const double x : {2.0, 3.0}) {
            tree.edge().point.x = {x};
            tree.edge().energy = x == 3 ? energy_of_third : 0;
            tree.add_leaf(random);
        }
        tree.join(random);
        n_third += tree.sample().x[0] == 3 ? 1 : 0;
    }
    return static_cast<double>(n_third) / n;
}

TEST(Trajectory, DrawsTheNewHalfByItsWeight) {
    // The new half weighs 1 + w against 2: it is taken with min(1, (1 + w) / 2), and its
    // last point with w / (1 + w) of that. |z| < 4.5: false alarm 1e-5.
    const double w = std::exp(-0.7);
    const double expected = (1 + w) / 2 * w / (1 + w);
    EXPECT_NEAR(third_point_share(0.7), expected, 4.5 * std::sqrt(expected / 20'000));
}

TEST(Trajectory, DivergesPastAnEnergyErrorOf1000OrWithoutOne) {
    Stream random(1, 1, 1);
    for (const auto& [energy, diverges] :
         {std::pair{999.0, false}, std::pair{1001.0, true}, std::pair{std::nan(""), true},
          std::pair{HUGE_VAL, true}}) {
        Trajectory tree(1, 1, 1);
        tree.begin();
        tree.begin_subtree(random);
        tree.edge().energy = energy;
        EXPECT_NE(tree.add_leaf(random), diverges);
        EXPECT_EQ(tree.diverging(), diverges);
    }
}

}  // namespace
}  // namespace bemcal::sampling
