/// Whether chains agree: R-hat of ranks and of distances from the median, effective sizes
/// of bulk and tails, Monte Carlo errors.
/// Source: Vehtari et al. 2021, as the R package posterior 1.4 has it; normal scores by
/// Blom 1958. Left out: plots, and joint statistics of several quantities.
/// Autocorrelation is effective_size's.
#include "stats/convergence.hpp"

#include "base/nan.hpp"
#include "stats/chain_moments.hpp"
#include "stats/distributions.hpp"
#include "stats/effective_size.hpp"
#include "stats/gelman_rubin.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::stats {
namespace {

std::vector<double> sorted(const Matrix& draws) {
    std::vector<double> values = draws.values;
    std::sort(values.begin(), values.end());
    return values;
}

template <class F>
Matrix each(Matrix draws, F f) {
    for (double& value : draws.values) value = f(value);
    return draws;
}

Matrix indicators(const Matrix& draws, double limit) {
    return each(draws, [limit](double x) { return x <= limit ? 1.0 : 0.0; });
}

Matrix folded(const Matrix& draws, double median) {
    return each(draws, [median](double x) { return std::abs(x - median); });
}

/// Normal scores of the ranks among all draws (Blom 1958); equal draws share the mean of
/// their ranks.
Matrix normal_scores(const Matrix& draws) {
    const auto& x = draws.values;
    std::vector<std::size_t> order(x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
    Matrix scores(draws.rows, draws.cols);
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        while (end < order.size() && x[order[end]] == x[order[first]]) ++end;
        const double rank = 0.5 * static_cast<double>(first + 1 + end);
        const double score =
            normal_quantile((rank - 0.375) / (static_cast<double>(x.size()) + 0.25));
        for (std::size_t k = first; k < end; ++k) scores.values[order[k]] = score;
    }
    return scores;
}

/// About the median of the halves: without the draws that splitting leaves out.
double folded_rhat(const Matrix& halves) {
    const double median = quantile_of_sorted(sorted(halves), 0.5);
    return basic_rhat(normal_scores(folded(halves, median)));
}

double ess_below(const Matrix& draws, double limit) {
    return effective_size(split_chains(indicators(draws, limit)));
}

double mcse_of_sd(const Matrix& draws, double mean) {
    const Matrix squares =
        each(draws, [mean](double x) { return (x - mean) * (x - mean); });
    const double variance = mean_of(squares.values);
    const double fourth = mean_of(each(squares, [](double s) { return s * s; }).values);
    const double of_variance =
        (fourth - variance * variance) / effective_size(split_chains(squares));
    return std::sqrt(of_variance / variance / 4);
}

/// The fields that need halves of chains, of draws that are finite and not all equal. Of
/// whole numbers, one tail or the distances may be all equal: the other counts.
void fill(Convergence& c, const Matrix& draws) {
    const Matrix halves = split_chains(draws);
    const std::vector<double> values = sorted(draws);
    const Matrix scores = normal_scores(halves);
    c.rhat_split = basic_rhat(halves);
    c.rhat_rank = std::fmax(basic_rhat(scores), folded_rhat(halves));
    c.ess_bulk = effective_size(scores);
    c.ess_mean = effective_size(halves);
    c.ess_tail = std::fmin(ess_below(draws, quantile_of_sorted(values, 0.05)),
                           ess_below(draws, quantile_of_sorted(values, 0.95)));
    c.mcse_mean = c.sd / std::sqrt(c.ess_mean);
    c.mcse_sd = mcse_of_sd(draws, c.mean);
}

}  // namespace

Convergence convergence_of(const Matrix& draws) {
    Convergence c{nan, nan, nan, nan, nan, nan, nan, nan, nan, nan};
    c.mean = mean_of(draws.values);
    c.sd = std::sqrt(variance_of(draws.values));
    if (!is_finite_and_varied(draws)) return c;
    c.gelman_rubin = gelman_rubin_of(draws).r;
    fill(c, draws);
    return c;
}

double ess_of_quantile(const Matrix& draws, double p) {
    if (!is_finite_and_varied(draws)) return nan;
    return ess_below(draws, quantile_of_sorted(sorted(draws), p));
}

}  // namespace bemcal::stats
