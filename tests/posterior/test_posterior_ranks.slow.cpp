/// Simulation-based calibration of the posterior of one building (Talts et al. 2018).
#include "posterior/posterior_cases.hpp"

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

/// 50 fits to data of the model's own, ranks of the truth among 19 draws in 5 bins,
/// 3 parameters and 3 of the noise: rejected by chance once in 100.
TEST(Posterior, RanksOfTheTruthAreUniform) {
    Case made = test::fortnight();
    made.meters.resize(1);
    posterior::PosteriorOptions options = test::quick_options();
    options.chains.sampler.n_warm_up = 150;
    const test::FitOfSimulatedData fit(made, options);
    std::vector<std::vector<int>> ranks(6);
    for (std::uint64_t k = 0; k < 50; ++k) {
        const test::SimulatedFit one = fit.run(100 + k, 50, 19);
        ASSERT_EQ(one.ranks.size(), ranks.size());
        for (std::size_t u = 0; u < ranks.size(); ++u) ranks[u].push_back(one.ranks[u]);
    }
    std::vector<double> p_values;
    for (const auto& of_one : ranks)
        p_values.push_back(test::uniformity_p(of_one, 19, 5));
    EXPECT_GT(test::least_holm_p(p_values), 0.01);
}

}  // namespace
}  // namespace bemcal::study
