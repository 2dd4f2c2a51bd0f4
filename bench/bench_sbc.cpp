/// Simulation-based calibration of the two posteriors, of the simulator itself, without
/// and with effects or a function, and through Gaussian processes: fits to data that the
/// model itself made, of unknowns drawn from their priors; the rank of the truth among
/// the draws is uniform if, and almost only if, the posterior is right (Talts et al.
/// 2018, arXiv:1804.06788). Prints for each unknown the p-value of chi-square with 20
/// bins, and the least one after Holm's correction over all of them. Lines: name value
/// unit reference ratio. Usage: bench_sbc [fits of each
/// [koh|direct|effects|step|function]]
#include "job/small_office.hpp"
#include "study/sampled_shapes.hpp"
#include "study/small_case.hpp"
#include "support/simulated_fit.hpp"
#include "support/simulated_process.hpp"

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
namespace bemcal {
namespace {

constexpr int n_ranks = 99, n_bins = 20;

/// Heating by the hour, and the air temperature.
study::Case with_empty_meters(study::Case made) {
    made.meters = {test::empty_meter(made, physics::Quantity::heating),
                   test::empty_meter(made, physics::Quantity::air_temperature)};
    return made;
}

/// A fortnight of a small office: three parameters, heating by the hour and the air
/// temperature.
study::Case office() {
    study::Case made = test::small_case();
    made.periods = {{"training", test::day(7), test::day(21)}};
    return with_empty_meters(std::move(made));
}

/// Effects that are declared, with a coefficient each that is sampled: one at a set-point
/// in some hours, one that follows the wind.
constexpr const char* effects_text = R"(
[[effect]]
name = "warm evenings"
hook = "heating set-point"
gate = "weekday"
hours = [17, 22]
coefficient = 0.5

[[effect]]
name = "wind infiltration"
coefficient = 0.05

[[parameter]]
name = "warm evenings"
target = "effect.warm evenings"
min = -2
max = 3
prior = {kind = "normal", mean = 0.5, sd = 0.5}

[[parameter]]
name = "wind infiltration"
target = "effect.wind infiltration"
min = -0.05
max = 0.15
prior = {kind = "normal", mean = 0.05, sd = 0.02}
)";

/// A function of the hours of working days, Saturdays and Sundays, 72 values that are
/// sampled about these with a size that is sampled, too.
std::string function_text() {
    return fmt::format(R"(
[[effect]]
name = "use"
hook = "gains"
coefficient = 1

[[effect.function]]
driver = "hour of the week"
values = [{}]
spread = 2
)",
                       fmt::join(std::vector<double>(72, 1.0), ", "));
}

/// Heat that somebody brings from a day on, both of them sampled.
constexpr const char* step_text = R"(
[[effect]]
name = "tenant"
hook = "gains"
driver = "time elapsed"
since = "2021-01-11"
since_within = 4
coefficient = 4

[[parameter]]
name = "tenant"
target = "effect.tenant"
min = -10
max = 20
prior = {kind = "normal", mean = 4, sd = 2}
)";

/// A fortnight of another one, read from a job with effects.
study::Case office_with(const std::string& effects) {
    study::Case made = job::small_office_with(effects);
    made.periods = {{"training", physics::parse_time("2021-01-04"),
                     physics::parse_time("2021-01-18")}};
    std::vector<study::SampledFunction> functions;
    made = with_empty_meters(std::move(made));
    return study::with_sampled_shapes(made, made.periods.at(0), functions);
}

posterior::PosteriorOptions options() {
    posterior::PosteriorOptions options;
    options.chains.n_chains = 8;
    options.chains.sampler.n_warm_up = 300;
    options.residuals.discrepancy = true;
    return options;
}

/// Correlations away from 1, where a covariance of a few points is singular in doubles.
emulator::ModelOptions process() {
    emulator::ModelOptions options;
    options.priors.rho_eta = options.priors.rho_delta =
        stats::Prior{stats::PriorKind::beta, 2, 2, 0, 1};
    return options;
}

sampling::SamplerOptions sampler() {
    sampling::SamplerOptions options;
    options.n_warm_up = 400;
    options.target_acceptance = 0.9;
    return options;
}

/// [n_fits] of fits by their seeds.
template <class Fit>
std::vector<test::SimulatedFit> run(int n_fits, const Fit& fit) {
    std::vector<test::SimulatedFit> fits(static_cast<std::size_t>(n_fits));
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < n_fits; ++k)
        fits[static_cast<std::size_t>(k)] = fit(static_cast<std::uint64_t>(1000 + k));
    return fits;
}

std::vector<double> report(const char* name,
                           const std::vector<test::SimulatedFit>& fits) {
    std::vector<double> p_values;
    for (std::size_t u = 0; u < fits[0].names.size(); ++u) {
        std::vector<int> ranks;
        for (const auto& fit : fits) ranks.push_back(fit.ranks[u]);
        p_values.push_back(test::uniformity_p(ranks, n_ranks, n_bins));
        fmt::print("{}_p_value_{} {:.4f} 1 - -\n", name, fits[0].names[u],
                   p_values.back());
    }
    fmt::print("{}_fits {} 1 500 -\n", name, fits.size());
    return p_values;
}

std::vector<double> report_direct(const char* name, const study::Case& building,
                                  int n_fits) {
    const test::FitOfSimulatedData fit(building, options());
    return report(name, run(n_fits, [&](std::uint64_t seed) {
                      return fit.run(seed, 125, n_ranks);
                  }));
}

std::vector<double> report_koh(int n_fits) {
    const test::FitOfSimulatedProcess fit({6, 6, 6}, process(), sampler());
    return report("koh", run(n_fits, [&](std::uint64_t seed) {
                      return fit.run({seed, 8, 125}, n_ranks);
                  }));
}

}  // namespace
}  // namespace bemcal

int main(int argc, char** argv) {
    using namespace bemcal;
    const int n_fits = argc > 1 ? std::atoi(argv[1]) : 500;
    const std::string_view only = argc > 2 ? argv[2] : "";
    std::vector<double> p_values;
    const auto add = [&](const char* name, const auto& report) {
        if (!only.empty() && only != name) return;
        for (const double p : report()) p_values.push_back(p);
    };
    add("koh", [&] { return report_koh(n_fits); });
    add("direct", [&] { return report_direct("direct", office(), n_fits); });
    add("effects",
        [&] { return report_direct("effects", office_with(effects_text), n_fits); });
    add("step", [&] { return report_direct("step", office_with(step_text), n_fits); });
    add("function",
        [&] { return report_direct("function", office_with(function_text()), n_fits); });
    fmt::print("least_holm_p {:.4f} 1 0.01 -\n", test::least_holm_p(p_values));
}
