/// A prior as a distribution of t, cut to a range: masses and quantiles from the nearer
/// tail, moments of a cut one by the trapezoidal rule in z with t = quantile(Phi(z)).
/// Source: textbook; the functions themselves are Boost's, by way of distributions. Fixed
/// values are no distribution and are left to the caller.
#include "stats/prior_standard.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {
namespace {

Distribution distribution_of(const Prior& p) {
    switch (p.kind) {
        case PriorKind::normal:
            return {Family::normal, p.a, p.b};
        case PriorKind::lognormal:
            return {Family::lognormal, p.a, p.b};
        case PriorKind::gamma:
            return {Family::gamma, p.a, p.b};
        case PriorKind::beta:
            return {Family::beta, p.a, p.b};
        default:
            return {Family::beta, 1, 1};
    }
}

bool is_on_unit(const Prior& p) {
    return p.is_normalised || p.kind == PriorKind::beta || p.kind == PriorKind::uniform;
}

/// By the shares on either side: p + rest = 1.
double quantile_of(const StandardPrior& s, double p, double rest) {
    const double below = s.distribution.cdf(s.least) + p * s.mass();
    const double above = s.distribution.upper(s.most) + rest * s.mass();
    const double t = below < 0.5 ? s.distribution.quantile(below)
                                 : s.distribution.upper_quantile(std::min(1.0, above));
    return std::clamp(t, s.least, s.most);
}

/// Mean of f(t): the trapezoidal rule in z with t = quantile(Phi(z)), which converges
/// faster than any power of the step.
template <class F>
double mean_of(const StandardPrior& s, F f) {
    constexpr double step = 0.125;
    double sum = 0;
    for (int k = -72; k <= 72; ++k) {
        const double z = k * step;
        const double weight = Distribution{Family::normal, 0, 1}.density(z);
        sum += weight * f(quantile_of(s, normal_cdf(z), normal_cdf(-z)));
    }
    return step * sum;
}

}  // namespace

StandardPrior::StandardPrior(const Prior& p)
    : distribution(distribution_of(p)),
      offset(is_on_unit(p) ? p.least : 0),
      scale(is_on_unit(p) ? p.most - p.least : 1),
      least(std::max(is_on_unit(p) ? 0 : p.least, distribution.least())),
      most(std::min(is_on_unit(p) ? 1 : p.most, distribution.most())) {}

bool StandardPrior::is_whole() const {
    return least == distribution.least() && most == distribution.most();
}

double StandardPrior::mass_between(double from, double to) const {
    const double below = distribution.cdf(from);
    if (below > 0.5) return distribution.upper(from) - distribution.upper(to);
    return distribution.cdf(to) - below;
}

double StandardPrior::quantile(double p) const {
    return quantile_of(*this, p, 1 - p);
}

double StandardPrior::mean() const {
    if (is_whole()) return distribution.mean();
    return mean_of(*this, [](double t) { return t; });
}

double StandardPrior::sd() const {
    if (is_whole()) return distribution.sd();
    const double centre = mean();
    return std::sqrt(
        mean_of(*this, [centre](double t) { return (t - centre) * (t - centre); }));
}

double fixed_value(const Prior& p) {
    return p.is_normalised ? p.least + p.a * (p.most - p.least) : p.a;
}

}  // namespace bemcal::stats
