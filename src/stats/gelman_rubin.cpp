/// Gelman and Rubin's statistic from the variances between and within chains, plain, and
/// as coda corrects it for the degrees of freedom.
/// Source: Gelman and Rubin 1992; paper 1, eq. 14-15; coda 0.19-4 (gelman.diag). Left
/// out: ranks (convergence), the multivariate statistic, coda's transformations.
#include "stats/gelman_rubin.hpp"

#include "stats/chain_moments.hpp"
#include "stats/distributions.hpp"

#include <cmath>
#include <limits>

namespace bemcal::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Degrees of freedom by coda: of the pooled variance V, and of W.
struct Freedom {
    double pooled, within;
};

Freedom freedom_of(const ChainMoments& c, const GelmanRubin& g, double pooled) {
    const double m = static_cast<double>(c.means.size()), n = c.n_draws;
    const double grand = mean_of(c.means), b = 1 + 1 / m;
    std::vector<double> squares(c.means);
    for (double& value : squares) value *= value;
    const double var_within = variance_of(c.variances) / m;
    const double var_between = 2 * g.between * g.between / (m - 1);
    const double both = n / m *
                        (covariance_of(c.variances, squares) -
                         2 * grand * covariance_of(c.variances, c.means));
    const double var_pooled =
        ((n - 1) * (n - 1) * var_within + b * b * var_between + 2 * (n - 1) * b * both) /
        (n * n);
    return {2 * pooled * pooled / var_pooled, 2 * g.within * g.within / var_within};
}

/// With the pooled variance V = (n - 1)/n W + (1 + 1/m) B/n.
void correct(const ChainMoments& c, GelmanRubin& g) {
    const double m = static_cast<double>(c.means.size()), n = c.n_draws;
    const double fixed = (n - 1) / n, random = (1 + 1 / m) / n * g.between / g.within;
    const Freedom freedom = freedom_of(c, g, g.within * (fixed + random));
    const double factor = (freedom.pooled + 3) / (freedom.pooled + 1);
    const double f = fisher_f_quantile(0.975, m - 1, freedom.within);
    g.corrected = std::sqrt(factor * (fixed + random));
    g.corrected_upper95 = std::sqrt(factor * (fixed + f * random));
}

}  // namespace

GelmanRubin gelman_rubin_of(const Matrix& draws) {
    if (draws.rows < 2 || draws.cols < 2) return {nan, nan, nan, nan, nan, nan};
    const ChainMoments c = moments_of(draws);
    const double m = static_cast<double>(draws.rows), n = c.n_draws;
    GelmanRubin g;
    g.between = n * variance_of(c.means);
    g.within = mean_of(c.variances);
    g.variance = (n - 1) / n * g.within + g.between / n;
    g.r = (m + 1) / m * g.variance / g.within - (n - 1) / (m * n);
    correct(c, g);
    return g;
}

double basic_rhat(const Matrix& draws) {
    if (draws.rows < 2 || draws.cols < 2 || !is_finite_and_varied(draws)) return nan;
    const ChainMoments c = moments_of(draws);
    const double n = c.n_draws;
    const double ratio = n * variance_of(c.means) / mean_of(c.variances);
    return std::sqrt((ratio + n - 1) / n);
}

}  // namespace bemcal::stats
