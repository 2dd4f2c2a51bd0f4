/// Simulation-based calibration of the direct posterior: fits to data that the model
/// itself made, of unknowns drawn from their priors; the rank of the truth among the
/// draws is uniform if, and almost only if, the posterior is right (Talts et al. 2018,
/// arXiv:1804.06788). Prints for each unknown the p-value of chi-square with 20 bins, and
/// the least one after Holm's correction. Lines: name value unit reference ratio.
#include "study/small_case.hpp"
#include "support/simulated_fit.hpp"

#include <cstdlib>

#include <fmt/format.h>
namespace bemcal {
namespace {

constexpr int n_ranks = 99, n_bins = 20;

/// A fortnight of a small office: three parameters, heating by the hour and the air
/// temperature.
study::Case office() {
    study::Case made = test::small_case();
    made.periods = {{"training", test::day(7), test::day(21)}};
    made.meters = {test::empty_meter(made, physics::Quantity::heating),
                   test::empty_meter(made, physics::Quantity::air_temperature)};
    return made;
}

study::PosteriorOptions options() {
    study::PosteriorOptions options;
    options.chains.n_chains = 8;
    options.chains.sampler.n_warm_up = 300;
    options.residuals.discrepancy = true;
    return options;
}

std::vector<test::SimulatedFit> run(int n_fits) {
    const test::FitOfSimulatedData fit(office(), options());
    std::vector<test::SimulatedFit> fits(static_cast<std::size_t>(n_fits));
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < n_fits; ++k)
        fits[static_cast<std::size_t>(k)] =
            fit.run(static_cast<std::uint64_t>(1000 + k), 125, n_ranks);
    return fits;
}

void report(const std::vector<test::SimulatedFit>& fits) {
    std::vector<double> p_values;
    for (std::size_t u = 0; u < fits[0].names.size(); ++u) {
        std::vector<int> ranks;
        for (const auto& fit : fits) ranks.push_back(fit.ranks[u]);
        p_values.push_back(test::uniformity_p(ranks, n_ranks, n_bins));
        fmt::print("p_value_{} {:.4f} 1 - -\n", fits[0].names[u], p_values.back());
    }
    fmt::print("direct_fits {} 1 500 -\n", fits.size());
    fmt::print("direct_least_holm_p {:.4f} 1 0.01 -\n", test::least_holm_p(p_values));
}

}  // namespace
}  // namespace bemcal

int main(int argc, char** argv) {
    bemcal::report(bemcal::run(argc > 1 ? std::atoi(argv[1]) : 500));
}
