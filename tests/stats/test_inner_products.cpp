#include "base/random.hpp"
#include "stats/inner_products.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::stats;

namespace {

template <class Number>
struct Block {
    std::size_t count, stride;
    std::vector<Number> values;

    Block(std::size_t n_rows, std::size_t length, int seed)
        : count(n_rows), stride(length), values(n_rows * length) {
        Stream random(static_cast<std::uint64_t>(seed), 0, 0);
        for (Number& value : values) value = static_cast<Number>(random.uniform() - 0.5);
    }
    NumberRows<Number> rows() const { return {values.data(), count, stride}; }
    double at(std::size_t row, std::size_t k) const { return values[row * stride + k]; }
};

/// Largest difference to plain sums, over the root of the length.
template <class Number>
double worst(std::size_t n_a, std::size_t n_b, std::size_t n) {
    const Block<Number> a(n_a, n + 3, 1), b(n_b, n + 1, 2);
    std::vector<double> sums(n_a * n_b, 1.0);
    add_inner_products(a.rows(), b.rows(), n, sums.data());
    double most = 0;
    for (std::size_t i = 0; i < n_a; ++i)
        for (std::size_t j = 0; j < n_b; ++j) {
            double sum = 1;
            for (std::size_t k = 0; k < n; ++k) sum += a.at(i, k) * b.at(j, k);
            most = std::max(most, std::abs(sums[i * n_b + j] - sum));
        }
    return most / std::sqrt(static_cast<double>(n) + 1);
}

}  // namespace

TEST(InnerProducts, ArePlainSumsWhateverTheNumberOfRowsAndTheLength) {
    for (const std::size_t n : {0, 1, 7, 8, 13, 511, 512, 513, 1300})
        for (const std::size_t n_a : {0, 1, 3, 4, 5, 9})
            for (const std::size_t n_b : {0, 1, 2, 3, 4, 7}) {
                EXPECT_LT(worst<double>(n_a, n_b, n), 1e-14)
                    << n_a << " " << n_b << " " << n;
                EXPECT_LT(worst<float>(n_a, n_b, n), 1e-6)
                    << n_a << " " << n_b << " " << n;
            }
}

TEST(InnerProducts, OfOneRowDoNotDependOnTheOthers) {
    constexpr std::size_t n = 700;
    const Block<double> a(9, n, 3), b(7, n, 4);
    std::vector<double> all(63, 0.0);
    add_inner_products(a.rows(), b.rows(), n, all.data());
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t j = 0; j < 7; ++j) {
            double one = 0;
            add_inner_products({a.values.data() + i * n, 1, n},
                               {b.values.data() + j * n, 1, n}, n, &one);
            EXPECT_EQ(one, all[i * 7 + j]);
        }
}
