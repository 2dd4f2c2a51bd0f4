/// Gelman and Rubin's statistic from the variances between and within chains.
/// Source: Gelman and Rubin 1992; paper 1, eq. 14-15. Left out: ranks (convergence), the
/// multivariate statistic, the correction for degrees of freedom.
#include "stats/gelman_rubin.hpp"

#include "base/nan.hpp"
#include "stats/chain_moments.hpp"

#include <cmath>

namespace bemcal::stats {

GelmanRubin gelman_rubin_of(const Matrix& draws) {
    if (draws.rows < 2 || draws.cols < 2) return {nan, nan, nan, nan};
    const ChainMoments c = moments_of(draws);
    const double m = static_cast<double>(draws.rows), n = c.n_draws;
    GelmanRubin g;
    g.between = n * variance_of(c.means);
    g.within = mean_of(c.variances);
    g.variance = (n - 1) / n * g.within + g.between / n;
    g.r = (m + 1) / m * g.variance / g.within - (n - 1) / (m * n);
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
