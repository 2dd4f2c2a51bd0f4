/// Distribution functions by Boost.Math: the only door to it.
///
/// Everything is computed in double, without the wider types that differ from machine to
/// machine. What is not defined is NaN; nothing throws.
#pragma once

namespace bemcal::stats {

enum class Family { normal, lognormal, beta, gamma, student_t };

/// A distribution on its full support.
struct Distribution {
    Family family = Family::normal;
    /// normal: mean, sd; lognormal: mean and sd of the logarithm; beta: its two
    /// exponents; gamma: shape, rate; student_t: degrees of freedom, unused.
    double a = 0, b = 1;

    double least() const;  ///< of the support
    double most() const;

    double density(double x) const;
    double cdf(double x) const;
    double upper(double x) const;  ///< 1 - cdf, without cancellation
    double quantile(double p) const;
    double upper_quantile(double p) const;  ///< x with upper(x) = p
    double mean() const;
    double sd() const;
};

double normal_cdf(double z);       ///< of the standard normal
double normal_quantile(double p);  ///< of the standard normal
/// Of the standard normal: 90 % of it lies within so many standard deviations to both
/// sides, 95 % to one.
inline constexpr double z_90_two_sided = 1.645;
double log_gamma(double x);  ///< log |Gamma(x)|

}  // namespace bemcal::stats
