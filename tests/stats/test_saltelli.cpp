#include "stats/saltelli.hpp"
#include "support/csv_table.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

struct Reference {
    const char* file;
    int dimension;
    double low, high;  ///< range that the file's rows are scaled to
};

class SaltelliRows : public testing::TestWithParam<Reference> {};

TEST_P(SaltelliRows, EqualSalib) {
    const auto [name, d, low, high] = GetParam();
    const auto file = test::shared_file(std::string("sobol/") + name);
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const test::CsvTable table(file, test::Header::absent);
    ASSERT_EQ(table.n_rows(), 20U);
    const Matrix design = saltelli_points(0, 20, d, false, 0);
    for (std::size_t r = 0; r < table.n_rows(); ++r) {
        const auto expected = table.numbers(r, static_cast<std::size_t>(d));
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(low + (high - low) * design(r, i), expected[i]) << r << ' ' << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Salib, SaltelliRows,
    testing::Values(Reference{"saltelli_ishigami_N256_first20.csv", 3, -std::numbers::pi,
                              std::numbers::pi},
                    Reference{"saltelli_sobolG8_N256_first20.csv", 8, 0, 1},
                    Reference{"saltelli_sobolG19_N256_first20.csv", 19, 0, 1}));

TEST(SaltelliPoints, ExchangeOneColumnInEachMixedRow) {
    const Matrix design = saltelli_points(5, 3, 4, true, 11);
    ASSERT_EQ(design.rows, 18U);
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_EQ(design(6 * j + 1 + i, k), design(6 * j + (k == i ? 5 : 0), k));
}

TEST(SaltelliPoints, BlocksEqualTheWhole) {
    const Matrix whole = saltelli_points(0, 20, 3, true, 4),
                 part = saltelli_points(7, 6, 3, true, 4);
    for (std::size_t r = 0; r < part.rows; ++r)
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(part(r, i), whole(35 + r, i));
}

}  // namespace
}  // namespace bemcal::stats
