#include "stats/sobol_sequence.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

TEST(SobolSequence, EqualsScipyBitForBit) {
    const auto file = test::shared_file("sobol/sobol_d40_first1024_scipy.csv");
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const test::CsvTable table(file, test::Header::absent);
    ASSERT_EQ(table.n_rows(), 1024U);
    const Matrix points = sobol_points(0, table.n_rows(), 40);
    int n_unequal = 0;
    for (std::size_t k = 0; k < table.n_rows(); ++k) {
        const std::vector<double> expected = table.numbers(k, 40);
        for (std::size_t d = 0; d < 40; ++d) n_unequal += points(k, d) != expected[d];
    }
    test::print_measured("Sobol coordinates that differ from SciPy's, of 40960",
                         n_unequal, "coordinates", "0");
    EXPECT_EQ(n_unequal, 0);
}

// scipy.stats.qmc.Sobol(d, scramble=False, bits=32), point 2^20 + 12345, SciPy 1.10.
TEST(SobolSequence, ReachesFarPointsDirectly) {
    const Matrix far = sobol_points((1 << 20) + 12345, 1, 5);
    const double expected[] = {0.6409316062927246, 0.657172679901123, 0.519355297088623,
                               0.32618284225463867, 0.2764430046081543};
    for (std::size_t d = 0; d < 5; ++d) EXPECT_EQ(far(0, d), expected[d]);
}

// The same for dimension 3667 (the last), points 1 to 4.
TEST(SobolSequence, HasAllDimensionsOfBoostsTable) {
    const Matrix points = sobol_points(1, 4, max_sobol_dimension);
    const double expected[] = {0.5, 0.25, 0.75, 0.625};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(points(k, max_sobol_dimension - 1), expected[k]);
    EXPECT_THROW(sobol_points(0, 1, max_sobol_dimension + 1), std::logic_error);
}

void expect_blocks_equal_the_whole(const Matrix& whole, auto block_of) {
    for (std::size_t first = 0; first < whole.rows; first += 37) {
        const std::size_t n = std::min<std::size_t>(37, whole.rows - first);
        const Matrix block = block_of(first, n);
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t d = 0; d < whole.cols; ++d)
                ASSERT_EQ(block(k, d), whole(first + k, d));
    }
}

TEST(SobolSequence, BlocksEqualTheWhole) {
    expect_blocks_equal_the_whole(
        sobol_points(0, 1000, 11),
        [](std::size_t first, std::size_t n) { return sobol_points(first, n, 11); });
    expect_blocks_equal_the_whole(scrambled_sobol_points(0, 1000, 11, 3),
                                  [](std::size_t first, std::size_t n) {
                                      return scrambled_sobol_points(first, n, 11, 3);
                                  });
}

// A linear scramble and a shift keep the net: each of 2^m equal intervals holds one of
// the first 2^m points, in every dimension.
TEST(ScrambledSobol, KeepsOnePointInEachInterval) {
    const Matrix points = scrambled_sobol_points(0, 1024, 38, 2024);
    for (std::size_t d = 0; d < points.cols; ++d) {
        std::set<int> intervals;
        for (std::size_t k = 0; k < points.rows; ++k)
            intervals.insert(static_cast<int>(points(k, d) * 1024));
        EXPECT_EQ(intervals.size(), 1024U) << "dimension " << d;
    }
}

// The first two dimensions are a (0, m, 2)-net in base 2; scrambling keeps that too.
TEST(ScrambledSobol, KeepsTheNetInTwoDimensions) {
    const Matrix points = scrambled_sobol_points(0, 1024, 2, 7);
    for (int power = 0; power <= 10; ++power) {
        std::set<std::pair<int, int>> boxes;
        for (std::size_t k = 0; k < points.rows; ++k)
            boxes.emplace(static_cast<int>(points(k, 0) * (1 << power)),
                          static_cast<int>(points(k, 1) * (1 << (10 - power))));
        EXPECT_EQ(boxes.size(), 1024U) << "2^" << power << " columns";
    }
}

TEST(ScrambledSobol, DependsOnSeedAndDimension) {
    const Matrix one = scrambled_sobol_points(0, 8, 3, 1),
                 two = scrambled_sobol_points(0, 8, 3, 2);
    EXPECT_NE(one.values, two.values);
    EXPECT_NE(one(0, 0), one(0, 1));
    const Matrix wider = scrambled_sobol_points(0, 8, 5, 1);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(wider(k, 2), one(k, 2));
}

}  // namespace
}  // namespace bemcal::stats
