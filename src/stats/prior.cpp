/// What is asked of a prior now and then: names, probabilities, quantiles, moments.
/// Follows from the cut distribution in prior_standard. A density that is wanted often is
/// PriorDensity's (prior_density); faults are told by prior_complaint, not here.
#include "stats/prior.hpp"

#include "stats/prior_standard.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {

const char* name_of(PriorKind kind) {
    constexpr const char* names[] = {"fixed",     "uniform", "normal",
                                     "lognormal", "beta",    "gamma"};
    return names[static_cast<int>(kind)];
}

Prior fixed_prior(double value) {
    Prior prior;
    prior.kind = PriorKind::fixed;
    prior.a = value;
    return prior;
}

Prior uniform_prior(double least, double most) {
    Prior prior;
    prior.least = least;
    prior.most = most;
    return prior;
}

Prior normal_prior(double mean, double sd) {
    Prior prior;
    prior.kind = PriorKind::normal;
    prior.a = mean;
    prior.b = sd;
    return prior;
}

Prior lognormal_prior(double median, double sd_log, double least) {
    Prior prior;
    prior.kind = PriorKind::lognormal;
    prior.a = std::log(median);
    prior.b = sd_log;
    prior.least = least;
    return prior;
}

double Prior::log_density(double x) const {
    return PriorDensity(*this).at(x).value;
}

double Prior::cdf(double x) const {
    if (kind == PriorKind::fixed) return x >= fixed_value(*this) ? 1 : 0;
    const StandardPrior standard(*this);
    const double t = std::clamp(standard.t(x), standard.least, standard.most);
    return standard.mass_between(standard.least, t) / standard.mass();
}

double Prior::quantile(double p) const {
    if (kind == PriorKind::fixed) return fixed_value(*this);
    const StandardPrior standard(*this);
    return std::clamp(standard.x(standard.quantile(p)), least, most);
}

double Prior::mean() const {
    if (kind == PriorKind::fixed) return fixed_value(*this);
    const StandardPrior standard(*this);
    return standard.x(standard.mean());
}

double Prior::sd() const {
    if (kind == PriorKind::fixed) return 0;
    const StandardPrior standard(*this);
    return standard.scale * standard.sd();
}

}  // namespace bemcal::stats
