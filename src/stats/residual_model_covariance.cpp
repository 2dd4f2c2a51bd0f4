/// Covariances of the filter's state (a, m, d) before and after a reading, the gain, and
/// the way back through each step.
/// Source: the Kalman filter, textbook, written out for three states and differentiated
/// by hand. Left out: states themselves (residual_model_filter); smoothing.
#include "stats/residual_model_covariance.hpp"

namespace bemcal::stats::residual {

namespace {

/// P h, where h = (1, 1, 0) is how the state is seen.
State seen(const Covariance& p) {
    return {p.aa + p.am, p.am + p.mm, p.ad + p.md};
}

/// Derivative by P from that by P h.
Covariance seen_back(const State& b) {
    return {b.a, 0.5 * (b.a + b.m), 0.5 * b.d, b.m, 0.5 * b.d, all(0)};
}

/// T P T'.
Covariance congruence(const Transition& t, const Covariance& p) {
    const Lanes mm = t.mm * p.mm + t.md * p.md, md = t.mm * p.md + t.md * p.dd;
    const Lanes dm = t.dm * p.mm + t.dd * p.md, dd = t.dm * p.md + t.dd * p.dd;
    return {t.rho * t.rho * p.aa,
            t.rho * (t.mm * p.am + t.md * p.ad),
            t.rho * (t.dm * p.am + t.dd * p.ad),
            mm * t.mm + md * t.md,
            mm * t.dm + md * t.dd,
            dm * t.dm + dd * t.dd};
}

}  // namespace

Covariance operator+(const Covariance& p, const Covariance& q) {
    return {p.aa + q.aa, p.am + q.am, p.ad + q.ad, p.mm + q.mm, p.md + q.md, p.dd + q.dd};
}

Covariance choose(const Eigen::Array<bool, width, 1>& where, const Covariance& yes,
                  const Covariance& no) {
    if (!where.any()) return no;
    return {choose(where, yes.aa, no.aa), choose(where, yes.am, no.am),
            choose(where, yes.ad, no.ad), choose(where, yes.mm, no.mm),
            choose(where, yes.md, no.md), choose(where, yes.dd, no.dd)};
}

GainSlope choose(const Eigen::Array<bool, width, 1>& where, const GainSlope& yes,
                 const GainSlope& no) {
    if (!where.any()) return no;
    return {{choose(where, yes.k.a, no.k.a), choose(where, yes.k.m, no.k.m),
             choose(where, yes.k.d, no.k.d)},
            choose(where, yes.variance, no.variance)};
}

Covariance predicted(const Motion& motion, const Covariance& filtered) {
    Covariance p = congruence(motion.transition, filtered);
    p.aa += motion.noise.aa;
    p.mm += motion.noise.mm;
    p.md += motion.noise.md;
    p.dd += motion.noise.dd;
    return p;
}

Covariance predicted_back(const Transition& t, const Covariance& slope) {
    return congruence({t.rho, t.mm, t.dm, t.md, t.dd}, slope);
}

// By T it is 2 M T P, of which the entries outside the two blocks are not wanted.
void add_motion_slope(const Transition& t, const Covariance& p, const Covariance& m,
                      Motion& sum) {
    const State a{t.rho * p.aa, t.mm * p.am + t.md * p.ad, t.dm * p.am + t.dd * p.ad};
    const State b{t.rho * p.am, t.mm * p.mm + t.md * p.md, t.dm * p.mm + t.dd * p.md};
    const State c{t.rho * p.ad, t.mm * p.md + t.md * p.dd, t.dm * p.md + t.dd * p.dd};
    sum.transition.rho += 2 * (m.aa * a.a + m.am * a.m + m.ad * a.d);
    sum.transition.mm += 2 * (m.am * b.a + m.mm * b.m + m.md * b.d);
    sum.transition.md += 2 * (m.am * c.a + m.mm * c.m + m.md * c.d);
    sum.transition.dm += 2 * (m.ad * b.a + m.md * b.m + m.dd * b.d);
    sum.transition.dd += 2 * (m.ad * c.a + m.md * c.m + m.dd * c.d);
    sum.noise.aa += m.aa;
    sum.noise.mm += m.mm;
    sum.noise.md += m.md;
    sum.noise.dd += m.dd;
}

Gain gain_of(const Covariance& predicted) {
    const State b = seen(predicted);
    const Lanes variance = b.a + b.m;
    const Lanes precision = variance.inverse();
    return {{b.a * precision, b.m * precision, b.d * precision}, variance, precision};
}

Covariance gain_back(const Gain& gain, const GainSlope& slope) {
    const State &k = gain.k, &by_k = slope.k;
    const Lanes& precision = gain.precision;
    const Lanes by_variance =
        slope.variance - precision * (k.a * by_k.a + k.m * by_k.m + k.d * by_k.d);
    return seen_back({precision * by_k.a + by_variance, precision * by_k.m + by_variance,
                      precision * by_k.d});
}

Covariance filtered(const Covariance& p, const Gain& gain) {
    const State& k = gain.k;
    const State b{k.a * gain.variance, k.m * gain.variance, k.d * gain.variance};
    return {p.aa - k.a * b.a, p.am - k.a * b.m, p.ad - k.a * b.d,
            p.mm - k.m * b.m, p.md - k.m * b.d, p.dd - k.d * b.d};
}

// Of P - b b' / variance, where b = P h and variance = h' b: by b, -2 M k + (k' M k) h.
Covariance filtered_back(const Gain& gain, const Covariance& m) {
    const State& k = gain.k;
    const State mk{m.aa * k.a + m.am * k.m + m.ad * k.d,
                   m.am * k.a + m.mm * k.m + m.md * k.d,
                   m.ad * k.a + m.md * k.m + m.dd * k.d};
    const Lanes by_variance = k.a * mk.a + k.m * mk.m + k.d * mk.d;
    return m + seen_back({by_variance - 2 * mk.a, by_variance - 2 * mk.m, -2 * mk.d});
}

}  // namespace bemcal::stats::residual
