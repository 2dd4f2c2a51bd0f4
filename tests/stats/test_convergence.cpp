#include "base/random.hpp"
#include "stats/chain_moments.hpp"
#include "stats/convergence.hpp"
#include "stats/effective_size.hpp"
#include "stats/gelman_rubin.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Values of R's posterior 1.4.0 and coda 0.19-4, by "file,statistic"; "NA" is NaN.
std::map<std::string, std::map<std::string, double>> read_expected() {
    const test::CsvTable table(test::shared_file("convergence/expected.csv"));
    std::map<std::string, std::map<std::string, double>> expected;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
        const std::string value = table.text(row, "value");
        expected[table.text(row, "file")][table.text(row, "stat")] =
            value == "NA" ? nan : std::stod(value);
    }
    return expected;
}

Matrix read_draws(const std::string& file, std::size_t n_chains, std::size_t n_draws) {
    const test::CsvTable table(test::shared_file("convergence/" + file + ".csv"));
    Matrix draws(n_chains, n_draws);
    for (std::size_t row = 0; row < table.n_rows(); ++row)
        draws(static_cast<std::size_t>(table.number(row, "chain")) - 1,
              static_cast<std::size_t>(table.number(row, "iter")) - 1) =
            table.number(row, "x");
    return draws;
}

/// Everything that is compared, under the names of the table.
std::map<std::string, double> computed(const Matrix& draws) {
    const Convergence c = convergence_of(draws);
    const GelmanRubin g = gelman_rubin_of(draws);
    return {{"mean", c.mean},
            {"sd_pooled", c.sd},
            {"B", g.between},
            {"W", g.within},
            {"sigma_plus2", g.variance},
            {"GR1992_R", c.gelman_rubin},
            {"GR1992_sqrtR", std::sqrt(g.r)},
            {"rhat_nosplit_sqrt(sp2/W)", std::sqrt(g.variance / g.within)},
            {"rhat_nosplit_basic", basic_rhat(draws)},
            {"rhat_split_basic", c.rhat_split},
            {"rhat_rank", c.rhat_rank},
            {"ess_bulk", c.ess_bulk},
            {"ess_tail", c.ess_tail},
            {"ess_mean", c.ess_mean},
            {"ess_median", ess_of_quantile(draws, 0.5)},
            {"ess_q05", ess_of_quantile(draws, 0.05)},
            {"ess_q95", ess_of_quantile(draws, 0.95)},
            {"ess_basic_split", effective_size(split_chains(draws))},
            {"ess_basic_nosplit", effective_size(draws)},
            {"mcse_mean", c.mcse_mean},
            {"mcse_sd", c.mcse_sd}};
}

/// Of both NaN it is 0; of one NaN it is infinite.
double relative_difference(double found, double expected) {
    if (std::isnan(found) && std::isnan(expected)) return 0;
    const double difference = std::abs(found - expected);
    if (difference == 0) return 0;
    const double relative = difference / std::abs(expected);
    return std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative;
}

TEST(Convergence, IsThatOfPosteriorAndCoda) {
    if (test::is_absent(test::shared_file("convergence/expected.csv")))
        GTEST_SKIP() << "the reference draws are not here";
    const auto expected = read_expected();
    ASSERT_EQ(expected.size(), 10U);
    for (const auto& [file, table] : expected) {
        const Matrix draws =
            read_draws(file, static_cast<std::size_t>(table.at("n_chain")),
                       static_cast<std::size_t>(table.at("n_iter")));
        double worst = 0;
        for (const auto& [statistic, value] : computed(draws)) {
            const auto reference = table.find(statistic);
            const double difference = relative_difference(
                value, reference == table.end() ? nan : reference->second);
            EXPECT_LE(difference, 1e-10) << file << " " << statistic << " " << value;
            worst = std::max(worst, difference);
        }
        test::print_measured("worst relative difference of " + file, worst, "", "1e-10");
    }
}

/// Two chains of ten draws that anyone can type.
Matrix short_chains() {
    Matrix draws(2, 10);
    draws.values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 3, 1, 4, 1, 5, 9, 2, 6, 5, 3};
    return draws;
}

// By hand: means 5.5 and 3.9, variances 82.5/9 and 54.9/9, B = 10 * 1.28.
TEST(GelmanRubin, IsThatOfTheSumsByHand) {
    const GelmanRubin g = gelman_rubin_of(short_chains());
    EXPECT_NEAR(g.between, 12.8, 1e-12);
    EXPECT_NEAR(g.within, 137.4 / 18, 1e-12);
    EXPECT_NEAR(g.variance, 0.9 * 137.4 / 18 + 1.28, 1e-12);
    EXPECT_NEAR(g.r, 1.5 * g.variance / g.within - 9.0 / 20, 1e-12);
    EXPECT_EQ(convergence_of(short_chains()).gelman_rubin, g.r);
}

TEST(SplitRhat, IsThatOfTheHalvesByHand) {
    // halves' means 3, 8, 2.8, 5; variances 2.5, 2.5, 3.2, 7.5
    const double between = 5 * variance_of(std::vector<double>{3, 8, 2.8, 5});
    const double within = (2.5 + 2.5 + 3.2 + 7.5) / 4;
    EXPECT_NEAR(convergence_of(short_chains()).rhat_split,
                std::sqrt((between / within + 4) / 5), 1e-13);
}

/// Three chains of 24 draws by a formula.
Matrix formula_chains() {
    Matrix draws(3, 24);
    for (std::size_t c = 0; c < draws.rows; ++c)
        for (std::size_t k = 0; k < draws.cols; ++k)
            draws(c, k) = static_cast<double>((7 * k * k + 3 * k + 5 * c) % 23) +
                          0.5 * static_cast<double>(k);
    return draws;
}

// The numbers are those of the definitions in numpy and scipy 1.10 (rankdata, norm.ppf,
// beta.ppf), with plain sums of products for the autocovariance.
TEST(Convergence, OfTypedDrawsIsThatOfNumpyAndScipy) {
    EXPECT_NEAR(convergence_of(short_chains()).rhat_rank, 1.450485001550848, 1e-12);
    const Matrix draws = formula_chains();
    const Convergence c = convergence_of(draws);
    EXPECT_NEAR(c.rhat_rank, 1.1032236862844365, 1e-12);
    EXPECT_NEAR(c.ess_bulk, 23.600573597592106, 1e-10);
    EXPECT_NEAR(c.ess_mean, 23.81762509124303, 1e-10);
    EXPECT_NEAR(c.ess_tail, 60.76190476190477, 1e-10);
    EXPECT_NEAR(c.mcse_sd, 0.4844887349809892, 1e-12);
    EXPECT_NEAR(effective_size(draws), 26.903751268915755, 1e-10);
    EXPECT_NEAR(ess_of_quantile(draws, 0.5), 22.064068383360272, 1e-10);
}

std::vector<double> slow_autocovariance(const Matrix& draws) {
    std::vector<double> sums(draws.cols, 0.0);
    const double count = static_cast<double>(draws.rows * draws.cols);
    for (std::size_t chain = 0; chain < draws.rows; ++chain) {
        const double mean = mean_of(draws.row(chain));
        for (std::size_t lag = 0; lag < draws.cols; ++lag)
            for (std::size_t k = 0; k + lag < draws.cols; ++k)
                sums[lag] +=
                    (draws(chain, k) - mean) * (draws(chain, k + lag) - mean) / count;
    }
    return sums;
}

TEST(MeanAutocovariance, IsTheSumOfProducts) {
    const auto fast = mean_autocovariance(short_chains());
    const auto slow = slow_autocovariance(short_chains());
    ASSERT_EQ(fast.size(), slow.size());
    for (std::size_t lag = 0; lag < fast.size(); ++lag)
        EXPECT_NEAR(fast[lag], slow[lag], 1e-13) << lag;
}

/// x_t = phi x_(t-1) + noise of a uniform distribution, from the stationary variance.
Matrix autoregression(double phi, std::size_t n_chains, std::size_t n_draws) {
    Matrix draws(n_chains, n_draws);
    for (std::size_t chain = 0; chain < n_chains; ++chain) {
        Stream random(7, 1, chain);
        double x = 0;
        for (int k = 0; k < 1000; ++k) x = phi * x + random.uniform() - 0.5;
        for (double& draw : draws.row(chain)) draw = x = phi * x + random.uniform() - 0.5;
    }
    return draws;
}

// An AR(1) process's mean is worth S (1 - phi) / (1 + phi) draws. The estimate strays by
// some 3 % (seen over 20 seeds); the limits are at five times that.
TEST(EffectiveSize, IsThatOfAnAutoregression) {
    EXPECT_NEAR(effective_size(autoregression(0, 8, 10000)) / 80000, 1, 0.15);
    EXPECT_NEAR(effective_size(autoregression(0.5, 8, 10000)) / 80000 * 3, 1, 0.15);
    EXPECT_NEAR(effective_size(autoregression(0.9, 8, 10000)) / 80000 * 19, 1, 0.15);
}

TEST(EffectiveSize, IsLargerThanTheNumberOfAntitheticDraws) {
    const double size = effective_size(autoregression(-0.9, 4, 1000));
    EXPECT_NEAR(size, 4000 * std::log10(4000), 1e-9);  // its bound
}

TEST(Convergence, OfTheBulkIsTheSameForAnyRisingFunction) {
    Matrix draws = autoregression(0.5, 4, 500);
    const double before = convergence_of(draws).ess_bulk;
    for (double& x : draws.values) x = std::exp(3 * x);
    EXPECT_EQ(convergence_of(draws).ess_bulk, before);
}

TEST(Convergence, FlagsChainsThatAreWiderThanOthers) {
    Matrix draws = autoregression(0, 4, 1000);
    for (double& x : draws.row(0)) x *= 3;
    EXPECT_LT(convergence_of(draws).rhat_split, 1.01);
    EXPECT_GT(convergence_of(draws).rhat_rank, 1.05);
}

TEST(Convergence, FlagsAChainThatIsElsewhere) {
    Matrix draws = autoregression(0, 4, 1000);
    for (double& x : draws.row(3)) x += 0.3;
    const Convergence c = convergence_of(draws);
    EXPECT_GT(c.gelman_rubin, 1.1);
    EXPECT_GT(c.rhat_split, 1.05);
    EXPECT_GT(c.rhat_rank, 1.05);
    EXPECT_LT(c.ess_bulk, 100);
}

TEST(Convergence, FlagsChainsThatNeverMove) {
    Matrix draws(3, 50);
    for (std::size_t chain = 0; chain < 3; ++chain)
        std::fill_n(draws.row(chain).begin(), 50, static_cast<double>(chain));
    const Convergence c = convergence_of(draws);
    EXPECT_GT(c.rhat_rank, 100);
    EXPECT_LT(c.ess_bulk, 4);
}

TEST(Convergence, IsUnknownOfDrawsThatAreAllEqualOrNotFinite) {
    const Matrix equal(4, 100, 2.5);
    Matrix broken = autoregression(0, 4, 100);
    broken(2, 17) = std::numeric_limits<double>::infinity();
    for (const Matrix& draws : {equal, broken, Matrix(2, 1, 0), Matrix()}) {
        const Convergence c = convergence_of(draws);
        for (const double value : {c.gelman_rubin, c.rhat_split, c.rhat_rank, c.ess_bulk,
                                   c.ess_tail, c.ess_mean, c.mcse_mean, c.mcse_sd})
            EXPECT_TRUE(std::isnan(value));
        EXPECT_TRUE(std::isnan(ess_of_quantile(draws, 0.5)));
    }
    EXPECT_EQ(convergence_of(equal).mean, 2.5);
    EXPECT_EQ(convergence_of(equal).sd, 0);
}

TEST(Convergence, OfOneChainHasNoGelmanRubin) {
    const Convergence c = convergence_of(autoregression(0.3, 1, 1000));
    EXPECT_TRUE(std::isnan(c.gelman_rubin));
    EXPECT_LT(c.rhat_rank, 1.02);
    EXPECT_GT(c.ess_tail, 200);
}

TEST(Convergence, OfTooFewDrawsIsUnknown) {
    const Convergence c = convergence_of(autoregression(0, 4, 4));  // halves of two
    EXPECT_TRUE(std::isnan(c.ess_bulk));
    EXPECT_TRUE(std::isnan(c.mcse_mean));
    EXPECT_TRUE(std::isfinite(c.rhat_split));
}

// A whole number with most draws at its largest value has no upper tail.
TEST(Convergence, OfFewLevelsTakesTheTailThatThereIs) {
    Matrix draws = autoregression(0, 4, 500);
    for (double& x : draws.values) x = x < -0.4 ? 0 : 1;
    const Convergence c = convergence_of(draws);
    EXPECT_GT(c.ess_tail, 1000);
    EXPECT_LT(c.rhat_rank, 1.02);
}

}  // namespace
}  // namespace bemcal::stats
