/// What is believed of a parameter before the data: a distribution on an interval.
///
/// Sampling happens on the whole real line: `Transform` maps it onto the prior's support
/// (logit for an interval, log for a half line), with the logarithm of its Jacobian.
#pragma once

#include <limits>
#include <string>

namespace bemcal::stats {

enum class PriorKind { fixed, uniform, normal, lognormal, beta, gamma };
const char* name_of(PriorKind kind);

/// A distribution, truncated to [least, most] where that is narrower than its support.
struct Prior {
    PriorKind kind = PriorKind::uniform;
    /// normal: mean, sd; lognormal: mean and sd of the logarithm; beta: its two
    /// exponents; gamma: shape, rate; fixed: the value; uniform: unused.
    double a = 0, b = 1;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    /// The distribution is that of (x - least) / (most - least): paper 1, Table 6. A beta
    /// always is.
    bool is_normalised = false;

    /// Log density at x, with its normalisation over [least, most]; -inf outside. Where
    /// it is wanted often, PriorDensity has the constant at hand.
    double log_density(double x) const;
    double cdf(double x) const;
    double quantile(double p) const;
    double mean() const;
    double sd() const;
};

Prior fixed_prior(double value);
Prior uniform_prior(double least, double most);
Prior normal_prior(double mean, double sd);
/// \param least  of its support; what is below has no mass
Prior lognormal_prior(double median, double sd_log, double least = 0);

/// What is wrong with a prior (no mass in its range, sd <= 0, ...); empty = nothing.
std::string complaint_about(const Prior& prior);

/// A point of the real line seen from the support.
struct Mapped {
    double x = 0;                     ///< in the support
    double slope = 1;                 ///< dx/du
    double log_slope = 0;             ///< log |dx/du|
    double log_slope_derivative = 0;  ///< of log |dx/du| by u
};

/// From the real line onto (least, most), rising: logit, log, or itself. Where both are
/// the same (a fixed value) every u is mapped there.
struct Transform {
    double least, most;
    Mapped at(double u) const;
    double inverse(double x) const;
};
Transform transform_of(const Prior& prior);

/// A log density and its derivative.
struct LogDensity {
    double value = 0, derivative = 0;
};

/// A prior made ready for many evaluations.
class PriorDensity {
  public:
    explicit PriorDensity(const Prior& prior);

    /// Of x, by x; -inf and 0 outside the support.
    LogDensity at(double x) const;
    /// Of u, by u, on the real line of the prior's Transform: the Jacobian is in it.
    /// Exact also where x(u) is so near an end of its range that it is rounded to it.
    LogDensity on_the_line(double u) const;
    /// The u of the quantile p, for starts: finite, also where x is rounded to an end.
    double quantile_on_the_line(double p) const;
    const Transform& transform() const { return transform_; }

  private:
    Prior prior_;
    Transform transform_;
    double offset_ = 0, scale_ = 1;  ///< the distribution is that of (x - offset) / scale
    double constant_ = 0;
};

}  // namespace bemcal::stats
