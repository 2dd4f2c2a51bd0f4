/// The posterior of bc-stan's example (15 parameters) by the default sampler, against the
/// published reference posterior and prediction: 20 chains from random starts.
///
/// Lines: name value unit reference ratio. Reference data lie beside the project; without
/// them nothing is printed and the exit code is 77. bc-stan by Stan's NUTS: 0.07 to 0.7
/// effective draws per CPU second, the worst parameter.
/// Usage: bench_koh_posterior [chains] [warm-up] [draws]
#include "emulator/prediction.hpp"
#include "emulator/reference_data.hpp"
#include "sampling/chains.hpp"
#include "stats/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

namespace bemcal::emulator {

namespace {

using test::CsvTable;
using test::shared_file;

struct Plan {
    std::size_t chains;
    int warm_up, draws;
};

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void print(const std::string& name, double value, const char* unit, double reference) {
    fmt::print("{} {:.5g} {} {:.5g} {:.4g}\n", name, value, unit, reference,
               value / reference);
}

sampling::SamplerOptions sampler(const Plan& plan) {
    sampling::SamplerOptions options;
    options.n_warm_up = plan.warm_up;
    options.target_acceptance = 0.9;
    options.inverse_temperatures = {1, 0.55, 0.3};
    return options;
}

struct Posterior {
    std::vector<sampling::ChainPart> chains;
    double warm_up_seconds = 0, seconds = 0;
};

Posterior sample(KohDensity& density, const Plan& plan) {
    std::vector<sampling::ChainTask> tasks(plan.chains);
    for (std::size_t c = 0; c < tasks.size(); ++c)
        tasks[c] = {1, static_cast<std::uint32_t>(c), 0, {}};
    Posterior made;
    const double start = cpu_seconds();
    const auto warm = sampling::run_chains(density, sampler(plan), tasks, 0);
    for (std::size_t c = 0; c < tasks.size(); ++c)
        tasks[c] = {1, static_cast<std::uint32_t>(c), 1, warm[c].state};
    made.warm_up_seconds = cpu_seconds() - start;
    made.chains = sampling::run_chains(density, sampler(plan), tasks, plan.draws);
    made.seconds = cpu_seconds() - start;
    return made;
}

/// [chains x draws] of a parameter.
Matrix values_of(const KohDensity& density, const Posterior& posterior, std::size_t k) {
    const auto& chains = posterior.chains;
    Matrix made(chains.size(), chains[0].draws.rows);
    for (std::size_t c = 0; c < made.rows; ++c)
        for (std::size_t i = 0; i < made.cols; ++i)
            made(c, i) = density.values(chains[c].draws.row(i))[k];
    return made;
}

double quantile(std::vector<double> values, double p) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
}

/// Chains of which more than 0.1 % of the draws are in the spurious mode.
std::size_t n_trapped(const Matrix& rho_eta_1) {
    std::size_t n = 0;
    for (std::size_t c = 0; c < rho_eta_1.rows; ++c) {
        std::size_t inside = 0;
        for (const double rho : rho_eta_1.row(c)) inside += rho > 0.45;
        n += static_cast<double>(inside) > 1e-3 * static_cast<double>(rho_eta_1.cols);
    }
    return n;
}

struct Worst {
    double ess = INFINITY, rhat = 0, mean_mcse = 0, mean_sd = 0, sd_low = INFINITY,
           sd_high = 0, quantile_sd = 0;
};

Worst compare(const KohDensity& density, const Posterior& posterior) {
    const CsvTable reference(shared_file("koh/reference_posterior.csv"));
    Worst worst;
    for (std::size_t k = 0; k < density.dimension(); ++k) {
        const Matrix draws = values_of(density, posterior, k);
        const stats::Convergence c = stats::convergence_of(draws);
        const auto expected = [&](const char* name) {
            return reference.number(k, fmt::format("\"{}\"", name));
        };
        const double sd = expected("sd"), off = std::abs(c.mean - expected("mean"));
        worst.ess = std::min({worst.ess, c.ess_bulk, c.ess_tail});
        worst.rhat = std::max(worst.rhat, c.rhat_rank);
        worst.mean_mcse = std::max(worst.mean_mcse,
                                   off / std::hypot(c.mcse_mean, expected("mcse_mean")));
        worst.mean_sd = std::max(worst.mean_sd, off / sd);
        worst.sd_low = std::min(worst.sd_low, c.sd / sd);
        worst.sd_high = std::max(worst.sd_high, c.sd / sd);
        for (const auto& [p, name] : {std::pair{0.05, "5%"}, {0.5, "50%"}, {0.95, "95%"}})
            worst.quantile_sd =
                std::max(worst.quantile_sd,
                         std::abs(quantile(draws.values, p) - expected(name)) / sd);
    }
    return worst;
}

/// CV(RMSE) with n - 1, per cent of the measured mean.
double cv_rmse(std::span<const double> predicted, const std::vector<double>& measured) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        squares += (predicted[i] - measured[i]) * (predicted[i] - measured[i]);
        sum += measured[i];
    }
    const double n = static_cast<double>(measured.size());
    return 100 * std::sqrt(squares / (n - 1)) / (sum / n);
}

void print_prediction(KohDensity& density, const Posterior& posterior) {
    constexpr std::size_t n = 4000;
    Matrix draws(n, density.dimension());
    const std::size_t chains = posterior.chains.size();
    for (std::size_t d = 0; d < n; ++d) {
        const Matrix& from = posterior.chains[d % chains].draws;
        std::ranges::copy(from.row(d / chains * (from.rows * chains) / n),
                          draws.row(d).begin());
    }
    Stream random(2, 0, 0);
    const Prediction made =
        predict(density, draws, density.data().data.measured_x, random);
    std::vector<double> measured, mean(made.mean.cols, 0.0);
    for (const double y : density.data().data.measured)
        measured.push_back(density.data().output.physical(y));
    double of_draws = 0, n_inside = 0;
    for (std::size_t d = 0; d < n; ++d) {
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += made.mean(d, i) / n;
        of_draws += cv_rmse(made.process.row(d), measured) / n;
    }
    for (std::size_t i = 0; i < mean.size(); ++i) {
        std::vector<double> column(n);
        for (std::size_t d = 0; d < n; ++d) column[d] = made.process(d, i);
        n_inside += measured[i] >= quantile(column, 0.05) &&
                    measured[i] <= quantile(column, 0.95);
    }
    print("koh_prediction_cv_rmse_of_mean", cv_rmse(mean, measured), "%", 1.52);
    print("koh_prediction_cv_rmse_of_draws", of_draws, "%", 2.63);
    print("koh_prediction_inside_90", n_inside, "points", 12);
}

void print_posterior(KohDensity& density, const Posterior& posterior) {
    const Worst worst = compare(density, posterior);
    print("koh_posterior_worst_mean_off", worst.mean_mcse, "mcse", 4);
    print("koh_posterior_worst_mean_off_sd", worst.mean_sd, "sd", 0.1);
    print("koh_posterior_least_sd_ratio", worst.sd_low, "-", 0.93);
    print("koh_posterior_most_sd_ratio", worst.sd_high, "-", 1.07);
    print("koh_posterior_worst_quantile_off", worst.quantile_sd, "sd", 0.15);
    print("koh_posterior_worst_rhat", worst.rhat, "-", 1.01);
    print("koh_posterior_worst_ess", worst.ess, "draws", 1600);
    print("koh_posterior_ess_per_cpu_second", worst.ess / posterior.seconds, "1/s", 0.7);
    print("koh_posterior_ess_per_cpu_second_after_warm_up",
          worst.ess / (posterior.seconds - posterior.warm_up_seconds), "1/s", 0.7);
    print("koh_posterior_cpu", posterior.seconds, "s", 300);
}

}  // namespace

int run_all(const Plan& plan) {
    if (test::is_reference_absent()) return 77;
    KohDensity density(test::reference_data(), {});
    const Posterior posterior = sample(density, plan);
    print("koh_chains_trapped",
          static_cast<double>(n_trapped(values_of(density, posterior, 3))), "chains",
          static_cast<double>(plan.chains));
    print_posterior(density, posterior);
    print_prediction(density, posterior);
    const JitterReport& jitter = density.jitter();
    print("koh_evaluations", static_cast<double>(jitter.n_with[0]), "-", 1);
    print("koh_evaluations_with_jitter",
          static_cast<double>(jitter.n_with[1] + jitter.n_with[2] + jitter.n_with[3]),
          "-", 1);
    print("koh_evaluations_failed", static_cast<double>(jitter.n_failed), "-", 1);
    return 0;
}

}  // namespace bemcal::emulator

int main(int argc, char** argv) {
    const auto argument = [&](int i, int otherwise) {
        return argc > i ? std::atoi(argv[i]) : otherwise;
    };
    return bemcal::emulator::run_all(
        {static_cast<std::size_t>(argument(1, 20)), argument(2, 500), argument(3, 1000)});
}
