#include "base/random.hpp"
#include "stats/sums.hpp"
#include "stats/sums_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::stats;

namespace {

/// Readings of rows that need not begin where a register would like them to.
struct Readings {
    Readings(std::size_t n_rows, std::size_t n) : n(n), values(n_rows * (n + 1)) {
        Stream random(5, n_rows, n);
        for (double& value : values) value = random.uniform() - 0.4;
        for (std::size_t r = 0; r < n_rows; ++r) rows.push_back(&values[r * (n + 1)]);
    }
    std::size_t n;
    std::vector<double> values;
    Rows rows;
};

/// The plain version.
double sum_of(const double* a, const double* b, std::span<const double> weights) {
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * a[k] * b[k];
    return sum;
}

/// Of some the weight is 0, of a stretch of all.
std::vector<double> weights_of(std::size_t n) {
    std::vector<double> weights(n);
    Stream random(6, 0, n);
    for (std::size_t k = 0; k < n; ++k)
        weights[k] = k % 7 == 3 || k / stretch == 1 ? 0 : 0.5 + random.uniform();
    return weights;
}

constexpr std::size_t lengths[] = {0, 1, 7, 8, 9, 255, 256, 257, 1000};
constexpr std::size_t heights[] = {1, 2, 3, 4, 5, 6, 9};

}  // namespace

TEST(Sums, ProductsAreThoseOfOneReadingAfterTheOther) {
    for (const std::size_t n : lengths)
        for (const std::size_t n_rows : heights) {
            const Readings readings(n_rows, n);
            const std::span<const double> v(readings.rows.back(), n);
            const std::vector<double> sums = products(readings.rows, v);
            ASSERT_EQ(sums.size(), n_rows);
            for (std::size_t r = 0; r < n_rows; ++r)
                EXPECT_NEAR(
                    sums[r],
                    sum_of(readings.rows[r], v.data(), std::vector<double>(n, 1.0)),
                    1e-12);
        }
}

TEST(Sums, GramIsThatOfOneReadingAfterTheOther) {
    for (const std::size_t n : lengths)
        for (const std::size_t n_rows : heights) {
            const Readings readings(n_rows, n);
            const auto weights = weights_of(n);
            const std::vector<double> gram = weighted_gram(readings.rows, weights);
            ASSERT_EQ(gram.size(), n_rows * n_rows);
            for (std::size_t r = 0; r < n_rows; ++r)
                for (std::size_t s = 0; s < n_rows; ++s)
                    EXPECT_NEAR(gram[r * n_rows + s],
                                sum_of(readings.rows[r], readings.rows[s], weights),
                                1e-12);
        }
}

TEST(Sums, OfAStretchWithoutWeightNothingIsRead) {
    const std::vector<double> values(2 * stretch, std::nan(""));
    std::vector<double> weights(2 * stretch, 0.0);
    EXPECT_EQ(weighted_gram({values.data()}, weights), std::vector{0.0});
    weights[stretch] = 1;
    EXPECT_TRUE(std::isnan(weighted_gram({values.data()}, weights)[0]));
}

TEST(Sums, NewerProcessorsGetTheSameBits) {
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor lacks AVX2";
    for (const std::size_t n_rows : heights) {
        const Readings readings(n_rows, 1003);
        std::vector<double> plain(n_rows, 0.0), v3 = plain;
        const auto height = static_cast<long>(n_rows);
        const double* const* rows = readings.rows.data();
        sums_plain.add_products(rows, height, rows[0], 1003, plain.data());
        sums_v3.add_products(rows, height, rows[0], 1003, v3.data());
        EXPECT_EQ(plain, v3);
        const Readings scaled(n_rows, stretch - 1);
        std::vector<double> gram(n_rows * n_rows, 0.0), gram_v3 = gram;
        sums_plain.add_gram(scaled.values.data(), height, gram.data());
        sums_v3.add_gram(scaled.values.data(), height, gram_v3.data());
        EXPECT_EQ(gram, gram_v3);
    }
#else
    GTEST_SKIP() << "one kernel for all";
#endif
}
