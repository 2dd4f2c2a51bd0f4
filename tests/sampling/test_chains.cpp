/// What holds for all methods: draws depend on seed, chain and round alone; a chain that
/// cannot start, or meets points without a density, disturbs nobody.
#include "sampling/densities.hpp"
#include "sampling/quantities.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

const test::Gaussian target{4, 0.5, 4};

struct Case {
    const char* name;
    SamplerOptions options;
    bool has_whole_numbers = false;
};

Case make_case(const char* name, Method method, std::vector<double> inverse_temperatures,
               bool has_whole_numbers) {
    SamplerOptions options;
    options.method = method;
    options.n_warm_up = 100;
    options.inverse_temperatures = std::move(inverse_temperatures);
    return {name, options, has_whole_numbers};
}

const std::vector<double> hot{1, 0.5, 0.2};
const Case cases[] = {make_case("nuts", Method::nuts, {1}, false),
                      make_case("random_walk", Method::random_walk, {1}, false),
                      make_case("gibbs", Method::gibbs, {1}, false),
                      make_case("tempered_nuts", Method::nuts, hot, false),
                      make_case("tempered_random_walk", Method::random_walk, hot, true),
                      make_case("tempered_gibbs", Method::gibbs, hot, true),
                      make_case("nuts_whole_numbers", Method::nuts, {1}, true)};

/// Four Gaussian coordinates, and a fifth whose values shift the first.
test::PlainDensity density_of(const Case& c, std::size_t width) {
    if (!c.has_whole_numbers) return {4, target, width};
    test::PlainDensity density(
        5,
        [](std::span<const double> x, test::PlainDensity::Values& out) {
            target(x.first(4), out);
            out.likelihood += 0.5 * x[4] * x[0];
            out.likelihood_gradient[0] += 0.5 * x[4];
        },
        width);
    density.set_levels({0, 0, 0, 0, 3});
    return density;
}

class Chains : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, Chains, testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

TEST_P(Chains, AreTheSameAloneOrWithSevenOthers) {
    const Case& c = GetParam();
    auto narrow = density_of(c, 1), wide = density_of(c, 8);
    const auto company = test::sample(wide, c.options, 8, 30);
    const std::vector<ChainTask> alone{{1, 5, 0, {}}};
    auto part = run_chains(narrow, c.options, alone, 0).at(0);
    part = run_chains(narrow, c.options, {{1, 5, 1, part.state}}, 30).at(0);
    EXPECT_EQ(part.draws.values, company[5].draws.values);
    EXPECT_EQ(part.statistics.values, company[5].statistics.values);
    EXPECT_EQ(part.state, company[5].state);
    EXPECT_NE(company[4].draws.values, company[5].draws.values);
    EXPECT_EQ(wide.most_points(), 8U);
    EXPECT_EQ(narrow.most_points(), 1U);
}

TEST_P(Chains, GoOnFromTheStateOfTheirLastRound) {
    const Case& c = GetParam();
    auto density = density_of(c, 4);
    const ChainPart warm = run_chains(density, c.options, {{7, 2, 0, {}}}, 99).at(0);
    EXPECT_EQ(warm.draws.rows, 0U);
    const ChainPart first =
        run_chains(density, c.options, {{7, 2, 1, warm.state}}, 50).at(0);
    const ChainPart second =
        run_chains(density, c.options, {{7, 2, 2, first.state}}, 50).at(0);
    const ChainPart again =
        run_chains(density, c.options, {{7, 2, 2, first.state}, {7, 3, 2, first.state}},
                   50)
            .at(0);
    EXPECT_EQ(first.draws.rows, 50U);
    EXPECT_EQ(second.draws.values, again.draws.values);
    EXPECT_EQ(second.state, again.state);
    EXPECT_NE(first.draws.values, second.draws.values);
    EXPECT_EQ(first.state.size(), warm.state.size());
}

TEST_P(Chains, ReportWhatTheDensityIsAtEachDraw) {
    const Case& c = GetParam();
    auto density = density_of(c, 4);
    const auto parts = test::sample(density, c.options, 2, 20);
    Evaluations values;
    density.evaluate(parts[1].draws, false, values);
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_EQ(parts[1].statistics(i, 0), values.prior[i]);
        EXPECT_EQ(parts[1].statistics(i, 1), values.likelihood[i]);
    }
}

TEST_P(Chains, ThinnedDrawsAreEveryThird) {
    const Case& c = GetParam();
    auto density = density_of(c, 4);
    SamplerOptions thinned = c.options;
    thinned.thin = 3;
    const ChainPart warm = run_chains(density, c.options, {{7, 2, 0, {}}}, 0).at(0);
    const ChainPart all =
        run_chains(density, c.options, {{7, 2, 1, warm.state}}, 60).at(0);
    const ChainPart few = run_chains(density, thinned, {{7, 2, 1, warm.state}}, 20).at(0);
    for (std::size_t i = 0; i < 20; ++i)
        for (std::size_t j = 0; j < few.draws.cols; ++j)
            EXPECT_EQ(few.draws(i, j), all.draws(3 * i + 2, j));
    EXPECT_EQ(few.state, all.state);
}

/// Chains start where their stream says; one in two starts is impossible on the left, and
/// further out the density is not a number.
test::PlainDensity holed_density() {
    return {2, [](std::span<const double> x, test::PlainDensity::Values& out) {
                for (std::size_t i = 0; i < 2; ++i) {
                    out.prior -= 0.5 * x[i] * x[i];
                    out.prior_gradient[i] = -x[i];
                }
                if (x[0] < 0) out.likelihood = -HUGE_VAL;
                if (x[1] > 1.5)
                    out.likelihood = out.likelihood_gradient[0] = std::nan("");
                if (x[1] < -1.5) out.prior_gradient[1] = std::nan("");
            }};
}

TEST_P(Chains, MeetPointsWithoutADensity) {
    auto density = holed_density();
    for (const ChainPart& part : test::sample(density, GetParam().options, 3, 200)) {
        ASSERT_EQ(part.failure, "");
        for (std::size_t i = 0; i < 200; ++i) {
            EXPECT_GE(part.draws(i, 0), 0);
            EXPECT_LE(part.draws(i, 1), 1.5);
            for (std::size_t s = 0; s < n_statistics; ++s)
                EXPECT_TRUE(std::isfinite(part.statistics(i, s)));
        }
    }
}

/// Finite where |x| < 0.1 only: a chain with one start is lucky or fails.
test::PlainDensity small_target() {
    return {1, [](std::span<const double> x, test::PlainDensity::Values& out) {
                out.prior = std::abs(x[0]) < 0.5 ? 0 : -HUGE_VAL;
            }};
}

TEST(ChainsThatCannotStart, SaySoAndDisturbNobody) {
    auto density = small_target();
    SamplerOptions options;
    options.method = Method::random_walk;
    options.n_start_candidates = 2;
    std::vector<ChainTask> tasks;
    for (std::uint32_t chain = 0; chain < 8; ++chain) tasks.push_back({1, chain, 0, {}});
    const auto parts = run_chains(density, options, tasks, 0);
    int n_failed = 0;
    for (std::uint32_t chain = 0; chain < 8; ++chain) {
        const auto alone = run_chains(density, options, {tasks[chain]}, 0).at(0);
        EXPECT_EQ(alone.failure, parts[chain].failure);
        EXPECT_EQ(alone.state, parts[chain].state);
        if (parts[chain].failure.empty()) continue;
        ++n_failed;
        EXPECT_EQ(parts[chain].failure,
                  "no start with a finite log density among 2 draws from the prior");
        EXPECT_TRUE(parts[chain].state.empty());
    }
    EXPECT_GT(n_failed, 0);
    EXPECT_LT(n_failed, 8);
}

TEST(ChainsThatCannotStart, FailAsALadderToo) {
    auto density = small_target();
    SamplerOptions options;
    options.method = Method::random_walk;
    options.inverse_temperatures = {1, 0.5, 0.1, 0.01};
    options.n_start_candidates = 1;
    const auto part = run_chains(density, options, {{1, 0, 0, {}}}, 0).at(0);
    EXPECT_NE(part.failure, "");
    EXPECT_TRUE(part.state.empty());
}

TEST(ChainStates, OfAnotherSizeAreRefused) {
    auto density = small_target();
    const auto part = run_chains(density, {}, {{1, 0, 1, {1, 2}}}, 5).at(0);
    EXPECT_EQ(part.failure, "the chain's state has 2 numbers, expected 5");
    EXPECT_EQ(part.draws.rows, 0U);
}

TEST(ChainErrors, OfTheDensityAreThrown) {
    test::PlainDensity density(1, [](auto, auto&) { throw std::domain_error("no"); });
    EXPECT_THROW(run_chains(density, {}, {{1, 0, 0, {}}}, 0), std::domain_error);
}

TEST(SamplerOptions, OutOfRangeAreRefused) {
    auto density = small_target();
    const auto refuses = [&](auto change) {
        SamplerOptions options;
        change(options);
        EXPECT_THROW(run_chains(density, options, {{1, 0, 0, {}}}, 0),
                     std::invalid_argument);
    };
    refuses([](SamplerOptions& o) { o.n_warm_up = -1; });
    refuses([](SamplerOptions& o) { o.thin = 0; });
    refuses([](SamplerOptions& o) { o.most_depth = 0; });
    refuses([](SamplerOptions& o) { o.n_start_candidates = 0; });
    refuses([](SamplerOptions& o) { o.target_acceptance = 1; });
    refuses([](SamplerOptions& o) { o.inverse_temperatures = {}; });
    refuses([](SamplerOptions& o) { o.inverse_temperatures = {0.9}; });
    refuses([](SamplerOptions& o) { o.inverse_temperatures = {1, 1}; });
    refuses([](SamplerOptions& o) { o.inverse_temperatures = {1, -0.1}; });
}

}  // namespace
}  // namespace bemcal::sampling
