/// Writes what is stored of chains: draws, their statistics, draws of the prior, a table
/// of moments, quantiles and convergence, and the sentence that says what falls short.
/// Source: the layout of ArviZ's InferenceData.
/// Leaves out warm-up and failed chains. Predictions are added by `Posterior::conclude`.
#include "posterior/chain_results.hpp"

#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

constexpr std::size_t n_prior_draws = 1000;
constexpr std::uint32_t prior_stream = 0x70726972;  // of the job's random numbers

double quantile(std::vector<double> values, double p) {
    std::ranges::sort(values);
    return stats::quantile_of_sorted(values, p);
}

void add_draws(const Posterior& posterior, const std::vector<Matrix>& unknowns,
               const ChainDraws& draws, study::DatasetBuilder& datasets) {
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        datasets.array("posterior/" + posterior.unknowns()[u].name, {"chain", "draw"},
                       {draws.n_chains, draws.n_draws}, unknowns[u].values,
                       posterior.unknowns()[u].unit);
    for (std::size_t s = 0; s < sampling::n_statistics; ++s)
        datasets.array(std::string("sample_stats/") +
                           sampling::name_of(static_cast<sampling::Statistic>(s)),
                       {"chain", "draw"}, {draws.n_chains, draws.n_draws},
                       draws.statistics.column(s));
    datasets.array("sample_stats/lp", {"chain", "draw"}, {draws.n_chains, draws.n_draws},
                   log_densities(draws).values);
}

void add_prior(const Posterior& posterior, const Matrix& prior,
               study::DatasetBuilder& datasets) {
    for (std::size_t u = 0; u < posterior.unknowns().size(); ++u)
        datasets.array("prior/" + posterior.unknowns()[u].name, {"chain", "draw"},
                       {1, prior.rows}, prior.column(u), posterior.unknowns()[u].unit);
}

void add_names(const Posterior& posterior, study::DatasetBuilder& datasets) {
    std::vector<std::string> names, units;
    for (const Unknown& unknown : posterior.unknowns()) {
        names.push_back(unknown.name);
        units.push_back(unknown.unit);
    }
    names.emplace_back("log_density");
    units.emplace_back("-");
    datasets.texts("unknown", "unknown", std::move(names));
    datasets.texts("unknown_unit", "unknown", std::move(units));
}

struct Column {
    const char* leaf;
    double stats::Convergence::* value;
};
constexpr Column columns[] = {{"posterior_mean", &stats::Convergence::mean},
                              {"posterior_sd", &stats::Convergence::sd},
                              {"gelman_rubin", &stats::Convergence::gelman_rubin},
                              {"rhat_split", &stats::Convergence::rhat_split},
                              {"rhat_rank", &stats::Convergence::rhat_rank},
                              {"ess_bulk", &stats::Convergence::ess_bulk},
                              {"ess_tail", &stats::Convergence::ess_tail},
                              {"mcse_mean", &stats::Convergence::mcse_mean}};

void add_convergence(const ConvergenceTable& table, study::DatasetBuilder& datasets) {
    for (const Column& column : columns) {
        std::vector<double> values;
        values.reserve(table.rows.size());
        for (const auto& row : table.rows) values.push_back(row.*column.value);
        datasets.vector(column.leaf, "unknown", std::move(values));
    }
}

/// Of every unknown, the log density last.
struct Quantiles {
    std::vector<double> q05, q50, q95;
};

Quantiles quantiles_of(const std::vector<Matrix>& unknowns, const ChainDraws& draws) {
    Quantiles quantiles;
    const auto add = [&](const std::vector<double>& values) {
        quantiles.q05.push_back(quantile(values, 0.05));
        quantiles.q50.push_back(quantile(values, 0.5));
        quantiles.q95.push_back(quantile(values, 0.95));
    };
    for (const Matrix& unknown : unknowns) add(unknown.values);
    add(log_densities(draws).values);
    return quantiles;
}

void add_quantiles(const Quantiles& quantiles, study::DatasetBuilder& datasets) {
    datasets.vector("posterior_q05", "unknown", quantiles.q05);
    datasets.vector("posterior_q50", "unknown", quantiles.q50);
    datasets.vector("posterior_q95", "unknown", quantiles.q95);
}

std::vector<study::FoundValue> values_of(const Posterior& posterior,
                                         const ConvergenceTable& table,
                                         const Quantiles& quantiles) {
    std::vector<study::FoundValue> values;
    values.reserve(posterior.unknowns().size());
    for (std::size_t u = 0; u < posterior.unknowns().size(); ++u)
        values.push_back({posterior.unknowns()[u].name, table.rows[u].mean,
                          quantiles.q05[u], quantiles.q95[u]});
    return values;
}

std::string chains_that_failed(const ChainDraws& draws) {
    if (draws.failures.empty()) return {};
    return fmt::format("; chains that did not start: {} ({})", draws.failures.size(),
                       draws.failures[0]);
}

}  // namespace

Matrix draw_prior(const Posterior& posterior, std::size_t n, Stream& random) {
    const auto density = posterior.make_density();
    Matrix draws(n, posterior.unknowns().size());
    for (std::size_t r = 0; r < n; ++r)
        posterior.read(density->draw_start(random), draws.row(r));
    return draws;
}

std::string shortfall_of(const ConvergenceTable& table, const ChainOptions& options,
                         const ChainDraws& draws) {
    if (draws.n_chains == 0)
        return fmt::format("not converged: no chain started{}",
                           chains_that_failed(draws));
    if (table.meets(options)) {
        const std::string failed = chains_that_failed(draws);
        return failed.empty() ? failed : "converged" + failed;
    }
    return fmt::format(
        "not converged: after {} draws of each of {} chains (the budget) "
        "rank R-hat is up to {:.3f}, to be at most {}; the effective "
        "draws are at least {:.0f}, to be at least {}{}",
        draws.n_draws, draws.n_chains, table.worst_rhat(), options.target_rhat,
        table.least_ess(), options.target_ess, chains_that_failed(draws));
}

study::Conclusion conclude_chains(const std::string& stage, const Posterior& posterior,
                                  const ChainOptions& options, const ChainDraws& draws) {
    study::DatasetBuilder datasets(stage);
    datasets.kind(posterior.kind());
    add_names(posterior, datasets);
    const std::vector<Matrix> unknowns = draws_of_unknowns(posterior, draws);
    const ConvergenceTable table = convergence_table(posterior, draws);
    const std::string shortfall = shortfall_of(table, options, draws);
    datasets.text("convergence", shortfall.empty() ? "converged" : shortfall);
    datasets.scalar("target_rhat", options.target_rhat);
    datasets.scalar("target_ess", options.target_ess);
    std::vector<study::Summary> summaries(1);
    summaries[0].study = stage;
    if (!shortfall.empty())
        summaries[0].findings.push_back(
            {"posterior", shortfall, "its values are doubtful"});
    if (draws.n_draws == 0) {
        summaries[0].failure = shortfall;
        return {datasets.take(), std::move(summaries)};
    }
    add_convergence(table, datasets);
    const Quantiles quantiles = quantiles_of(unknowns, draws);
    add_quantiles(quantiles, datasets);
    summaries[0].values = values_of(posterior, table, quantiles);
    add_draws(posterior, unknowns, draws, datasets);
    Stream random(options.seed, prior_stream, 0);
    add_prior(posterior, draw_prior(posterior, n_prior_draws, random), datasets);
    posterior.conclude(draws, datasets, summaries);
    return {datasets.take(), std::move(summaries)};
}

}  // namespace bemcal::posterior
