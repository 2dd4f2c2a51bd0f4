/// Priors as distributions of t = (x - offset) / scale, cut to a range: what the
/// functions of a prior share.
///
/// A uniform is a beta with both exponents 1. Masses and quantiles are taken from the
/// tail that is nearer, so that a range far out in a tail is as exact as any other.
#pragma once

#include "stats/distributions.hpp"
#include "stats/prior.hpp"

namespace bemcal::stats {

/// The distribution of t and the range that it is cut to; not of a fixed value.
struct StandardPrior {
    explicit StandardPrior(const Prior& prior);

    Distribution distribution;
    double offset, scale;  ///< x = offset + scale t
    double least, most;    ///< of t

    double t(double x) const { return (x - offset) / scale; }
    double x(double t) const { return offset + scale * t; }
    /// Nothing is cut off.
    bool is_whole() const;
    double mass_between(double from, double to) const;
    double mass() const { return mass_between(least, most); }
    double quantile(double p) const;
    double mean() const;  ///< of t
    double sd() const;
};

double fixed_value(const Prior& prior);

}  // namespace bemcal::stats
