#include "base/random.hpp"
#include "stats/functions.hpp"
#include "stats/saltelli.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Expected {
    std::vector<double> first_order, total_order;  ///< SALib's estimates
    std::vector<double> exact_first_order, exact_total_order;
};

/// Rows of SALib's table for one function, sample size and sampling.
Expected expected_for(const std::string& function, const std::string& n,
                      const std::string& sampling) {
    Expected found;
    const test::CsvTable table(test::shared_file("sobol/expected_sobol.csv"));
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
        if (table.text(row, "function") != function || table.text(row, "N") != n ||
            table.text(row, "sampling") != sampling ||
            table.text(row, "second_order") != "0")
            continue;
        found.exact_first_order.push_back(table.number(row, "S1_analytic"));
        found.exact_total_order.push_back(table.number(row, "ST_analytic"));
        found.first_order.push_back(table.number(row, "S1_salib"));
        found.total_order.push_back(table.number(row, "ST_salib"));
    }
    return found;
}

bool reference_is_here() {
    return !test::is_absent(test::shared_file("sobol/expected_sobol.csv"));
}

SobolIndices indices_of(const std::string& function, std::size_t n, bool scramble,
                        std::uint64_t seed, int n_bootstrap = 0) {
    const int d = test::dimension_of(function);
    const Matrix design = saltelli_points(0, n, d, scramble, seed);
    return sobol_indices(test::evaluate(function, design), d, n_bootstrap, seed);
}

double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

using Size = std::tuple<std::string, std::string>;  ///< function, n
class Indices : public testing::TestWithParam<Size> {};

TEST_P(Indices, EqualSalibOnTheSameDesign) {
    if (!reference_is_here()) GTEST_SKIP() << "expected_sobol.csv is not here";
    const auto [function, n] = GetParam();
    const Expected expected = expected_for(function, n, "sobol_unscrambled_from0");
    const SobolIndices found = indices_of(function, std::stoul(n), false, 0);
    const double first = largest_error(found.first_order, expected.first_order),
                 total = largest_error(found.total_order, expected.total_order);
    test::print_measured("Sobol indices against SALib, " + function + ", N = " + n,
                         std::max(first, total), "-", "1e-10");
    EXPECT_LT(first, 1e-10);
    EXPECT_LT(total, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
    Salib, Indices,
    testing::Combine(testing::Values("ishigami", "sobolG8", "sobolG19"),
                     testing::Values("256", "1024", "4096", "16384")));

/// Median over 31 scrambles of the largest error of any index, with SciPy 1.10's
/// qmc.Sobol(scramble=True) and the same estimators.
struct ErrorSize {
    const char* function;
    std::size_t n;
    double first_order, total_order;
};
void PrintTo(const ErrorSize& size, std::ostream* out) {
    *out << size.function << " n " << size.n;
}

constexpr ErrorSize scipy_errors[] = {
    {"ishigami", 256, 0.042, 0.057},     {"ishigami", 1024, 0.0068, 0.0047},
    {"ishigami", 4096, 0.0013, 0.00085}, {"ishigami", 16384, 0.00025, 9.1e-05},
    {"sobolG8", 256, 0.027, 0.025},      {"sobolG8", 1024, 0.0034, 0.0045},
    {"sobolG8", 4096, 0.00068, 0.0007},  {"sobolG8", 16384, 0.00013, 9.9e-05},
    {"sobolG19", 256, 0.054, 0.044},     {"sobolG19", 1024, 0.016, 0.014},
    {"sobolG19", 4096, 0.0058, 0.005},   {"sobolG19", 16384, 0.0019, 0.0027}};

class ScrambledIndices : public testing::TestWithParam<ErrorSize> {};

double median(std::vector<double> values) {
    std::ranges::nth_element(values,
                             values.begin() + static_cast<long>(values.size() / 2));
    return values[values.size() / 2];
}

// The logarithm of one scramble's error has a standard deviation of about 1.3: a median
// of 15 is above three times a median of 31 in 2 % of seeds (they are fixed).
TEST_P(ScrambledIndices, ErrAsScipysDo) {
    if (!reference_is_here()) GTEST_SKIP() << "expected_sobol.csv is not here";
    const ErrorSize size = GetParam();
    const Expected exact = expected_for(size.function, std::to_string(size.n),
                                        "sobol_lms_scrambled_seed2024");
    std::vector<double> first, total;
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
        const SobolIndices found = indices_of(size.function, size.n, true, seed);
        first.push_back(largest_error(found.first_order, exact.exact_first_order));
        total.push_back(largest_error(found.total_order, exact.exact_total_order));
    }
    EXPECT_LT(median(first), 3 * size.first_order);
    EXPECT_LT(median(total), 3 * size.total_order);
}

INSTANTIATE_TEST_SUITE_P(Scipy, ScrambledIndices, testing::ValuesIn(scipy_errors));

// Closed forms: Ishigami and Homma 1990 with a = 7, b = 0.1 (variance 13.8446). Typical
// errors of a scrambled design of 16384 base points are below 0.01.
TEST(SobolIndices, OfIshigamiAreTheClosedForm) {
    const SobolIndices found = indices_of("ishigami", 16384, true, 1);
    const std::vector<double> first{0.3139, 0.4424, 0}, total{0.5576, 0.4424, 0.2437};
    EXPECT_LT(largest_error(found.first_order, first), 0.01);
    EXPECT_LT(largest_error(found.total_order, total), 0.01);
    EXPECT_NEAR(found.mean, 3.5, 0.01);
    EXPECT_NEAR(found.variance, 13.8446, 0.05);
}

TEST(SobolIndices, LeaveABasePointWithAFailedRowOutWhole) {
    const Matrix design = saltelli_points(0, 256, 3, true, 3);
    std::vector<double> outputs = test::evaluate("ishigami", design);
    std::vector<double> without = outputs;
    without.erase(without.begin() + 5 * 17, without.begin() + 5 * 18);
    outputs[5 * 17 + 2] = nan;
    const SobolIndices found = sobol_indices(outputs, 3, 20, 1);
    const SobolIndices expected = sobol_indices(without, 3, 20, 1);
    EXPECT_EQ(found.n_used, 255);
    EXPECT_EQ(found.first_order, expected.first_order);
    EXPECT_EQ(found.total_half_width, expected.total_half_width);
}

TEST(SobolIndices, OfAConstantOutputAreUnknown) {
    const SobolIndices found = sobol_indices(std::vector<double>(5 * 64, 0.1), 3, 10, 1);
    EXPECT_TRUE(found.degenerate);
    for (const double s : found.total_order) EXPECT_TRUE(std::isnan(s));
}

TEST(SobolIndices, OfNothingButFailuresAreUnknown) {
    const SobolIndices found = sobol_indices(std::vector<double>(5 * 64, nan), 3, 10, 1);
    EXPECT_TRUE(found.degenerate);
    EXPECT_EQ(found.n_used, 0);
}

TEST(SobolIndices, DoNotChangeWithTheOutputsUnit) {
    const Matrix design = saltelli_points(0, 256, 3, true, 3);
    std::vector<double> outputs = test::evaluate("ishigami", design);
    const SobolIndices plain = sobol_indices(outputs, 3, 0, 1);
    for (double& y : outputs) y = 1e6 + 1000 * y;
    const SobolIndices scaled = sobol_indices(outputs, 3, 0, 1);
    EXPECT_LT(largest_error(plain.first_order, scaled.first_order), 1e-9);
    EXPECT_LT(largest_error(plain.total_order, scaled.total_order), 1e-9);
}

/// One resample by drawing whole base points, then the estimator on them: the slow way.
SobolIndices of_drawn(const std::vector<double>& outputs, int d, Stream& random) {
    const std::size_t rows = static_cast<std::size_t>(d) + 2, n = outputs.size() / rows;
    std::vector<double> drawn;
    for (std::size_t j = 0; j < n; ++j) {
        const auto begin =
            outputs.begin() +
            static_cast<long>(rows * random.below(static_cast<std::uint32_t>(n)));
        drawn.insert(drawn.end(), begin, begin + d + 2);
    }
    return sobol_indices(drawn, d, 0, 0);
}

// The standard deviation of 1000 resamples is known to 2.2 %; two independent ones differ
// by more than 16 % in 5e-7 of seeds per index. (The slow way centres B anew in each
// resample: < 1 %.)
TEST(SobolIndices, HalfWidthsAreThoseOfResampledBasePoints) {
    const Matrix design = saltelli_points(0, 512, 3, true, 3);
    const std::vector<double> outputs = test::evaluate("ishigami", design);
    const SobolIndices found = sobol_indices(outputs, 3, 1000, 9);
    Stream random(77, 0, 0);
    std::vector<double> sum(3, 0), square(3, 0);
    for (int r = 0; r < 1000; ++r) {
        const SobolIndices one = of_drawn(outputs, 3, random);
        for (std::size_t i = 0; i < 3; ++i) {
            sum[i] += one.total_order[i];
            square[i] += one.total_order[i] * one.total_order[i];
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double deviation = std::sqrt((square[i] - sum[i] * sum[i] / 1000) / 999);
        EXPECT_NEAR(found.total_half_width[i] / (1.96 * deviation), 1, 0.16);
    }
}

TEST(SobolIndices, BootstrapBelongsToTheSeed) {
    EXPECT_EQ(indices_of("ishigami", 64, true, 5, 10).total_half_width,
              indices_of("ishigami", 64, true, 5, 10).total_half_width);
}

}  // namespace
}  // namespace bemcal::stats
