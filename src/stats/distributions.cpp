/// Distribution functions by Boost.Math, which this file alone includes: in double only,
/// NaN where nothing is defined, no exceptions.
/// Source: Boost.Math's documentation. Left out: random numbers, and distributions cut to
/// a range (prior_standard).
#include "stats/distributions.hpp"

#include "base/nan.hpp"

#include <cmath>
#include <limits>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace bemcal::stats {
namespace {

namespace bm = boost::math;
using bm::policies::ignore_error;
using Policy = bm::policies::policy<
    bm::policies::promote_double<false>, bm::policies::domain_error<ignore_error>,
    bm::policies::pole_error<ignore_error>, bm::policies::overflow_error<ignore_error>,
    bm::policies::evaluation_error<ignore_error>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// f of Boost's distribution.
template <class F>
double with(const Distribution& d, F f) {
    switch (d.family) {
        case Family::normal:
            return f(bm::normal_distribution<double, Policy>(d.a, d.b));
        case Family::lognormal:
            return f(bm::lognormal_distribution<double, Policy>(d.a, d.b));
        case Family::beta:
            return f(bm::beta_distribution<double, Policy>(d.a, d.b));
        case Family::gamma:
            return f(bm::gamma_distribution<double, Policy>(d.a, 1 / d.b));
        case Family::student_t:
            return f(bm::students_t_distribution<double, Policy>(d.a));
    }
    return nan;
}

}  // namespace

double Distribution::least() const {
    return family == Family::normal || family == Family::student_t ? -infinity : 0;
}

double Distribution::most() const {
    return family == Family::beta ? 1 : infinity;
}

double Distribution::density(double x) const {
    if (x < least() || x > most() || std::isinf(x)) return 0;
    return with(*this, [x](const auto& d) { return bm::pdf(d, x); });
}

double Distribution::cdf(double x) const {
    if (x <= least()) return 0;
    if (x >= most()) return 1;
    return with(*this, [x](const auto& d) { return bm::cdf(d, x); });
}

double Distribution::upper(double x) const {
    if (x <= least()) return 1;
    if (x >= most()) return 0;
    return with(*this, [x](const auto& d) { return bm::cdf(bm::complement(d, x)); });
}

double Distribution::quantile(double p) const {
    if (p == 0) return least();
    if (p == 1) return most();
    return with(*this, [p](const auto& d) { return bm::quantile(d, p); });
}

double Distribution::upper_quantile(double p) const {
    if (p == 0) return most();
    if (p == 1) return least();
    return with(*this, [p](const auto& d) { return bm::quantile(bm::complement(d, p)); });
}

double Distribution::mean() const {
    return with(*this, [](const auto& d) { return bm::mean(d); });
}

double Distribution::sd() const {
    return with(*this, [](const auto& d) { return bm::standard_deviation(d); });
}

double normal_cdf(double z) {
    return Distribution{Family::normal, 0, 1}.cdf(z);
}

double normal_quantile(double p) {
    return Distribution{Family::normal, 0, 1}.quantile(p);
}

double log_gamma(double x) {
    return bm::lgamma(x, Policy());
}

}  // namespace bemcal::stats
