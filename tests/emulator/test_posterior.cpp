/// The reference posterior by a short tempered run; bench_koh_posterior makes the long
/// one.
#include "emulator/reference_data.hpp"
#include "sampling/chains.hpp"

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

/// False alarms: 15 means of some 300 effective draws or more, 0.35 sd = 6 standard
/// errors: 3e-8. The seed is fixed.
TEST(KohPosterior, AShortTemperedRunFindsTheReferenceMeans) {
    if (is_reference_absent()) GTEST_SKIP() << "the reference data are not here";
    KohDensity density(reference_data(), {});
    sampling::SamplerOptions options;
    options.n_warm_up = 250;
    options.target_acceptance = 0.9;
    options.inverse_temperatures = {1, 0.5};
    constexpr std::size_t chains = 4;
    constexpr int draws = 200;
    std::vector<sampling::ChainTask> tasks(chains);
    for (std::size_t c = 0; c < chains; ++c)
        tasks[c] = {5, static_cast<std::uint32_t>(c), 0, {}};
    const auto warm = sampling::run_chains(density, options, tasks, 0);
    for (std::size_t c = 0; c < chains; ++c) {
        tasks[c].round = 1;
        tasks[c].state = warm[c].state;
    }
    const auto parts = sampling::run_chains(density, options, tasks, draws);
    std::vector<double> means(density.dimension(), 0.0);
    for (const sampling::ChainPart& part : parts) {
        ASSERT_EQ(part.failure, "");
        for (std::size_t i = 0; i < part.draws.rows; ++i) {
            const std::vector<double> values = density.values(part.draws.row(i));
            for (std::size_t k = 0; k < means.size(); ++k)
                means[k] += values[k] / (chains * draws);
        }
    }
    const CsvTable reference(shared_file("koh/reference_posterior.csv"));
    for (std::size_t k = 0; k < means.size(); ++k)
        EXPECT_NEAR(means[k], reference.number(k, "\"mean\""),
                    0.35 * reference.number(k, "\"sd\""))
            << density.names()[k];
}

}  // namespace
}  // namespace bemcal::emulator::test
