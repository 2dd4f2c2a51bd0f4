/// The log density of a prior on its own scale and on the real line (logit, log), with
/// derivatives. Both share one formula of t, log t and log (1 - t); on the line the
/// logarithms come from u itself, so that nothing is lost where x is rounded.
/// Source: textbook densities and Jacobians. Masses of cut ranges are prior_standard's.
#include "stats/prior.hpp"
#include "stats/prior_standard.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// t with the logarithms of t and 1 - t, and the derivatives of all three.
struct Place {
    double t, log_t, log_rest;
    double by_t, by_log_t, by_log_rest;
};

Place place_at(double t, double slope) {
    return {t, std::log(t), std::log1p(-t), slope, slope / t, -slope / (1 - t)};
}

/// c v, where a factor of zero wins over an infinite v.
double times(double c, double v) {
    return c == 0 ? 0 : c * v;
}

/// The log density of t without its constant.
LogDensity kernel_of(const Prior& p, const Place& at) {
    const double z = ((p.kind == PriorKind::lognormal ? at.log_t : at.t) - p.a) / p.b;
    switch (p.kind) {
        case PriorKind::normal:
            return {-z * z / 2, -z / p.b * at.by_t};
        case PriorKind::lognormal:
            if (std::isinf(z)) return {-unbounded, 0};
            return {-z * z / 2 - at.log_t, -(z / p.b + 1) * at.by_log_t};
        case PriorKind::gamma:
            return {times(p.a - 1, at.log_t) - p.b * at.t,
                    times(p.a - 1, at.by_log_t) - p.b * at.by_t};
        case PriorKind::beta:
            return {times(p.a - 1, at.log_t) + times(p.b - 1, at.log_rest),
                    times(p.a - 1, at.by_log_t) + times(p.b - 1, at.by_log_rest)};
        default:
            return {};
    }
}

/// The constant that belongs to kernel_of on the full support.
double constant_of(const Prior& p) {
    constexpr double half_log_two_pi = 0.91893853320467274178;
    switch (p.kind) {
        case PriorKind::normal:
        case PriorKind::lognormal:
            return -half_log_two_pi - std::log(p.b);
        case PriorKind::gamma:
            return p.a * std::log(p.b) - log_gamma(p.a);
        case PriorKind::beta:
            return log_gamma(p.a + p.b) - log_gamma(p.a) - log_gamma(p.b);
        default:
            return 0;
    }
}

double soft_plus(double u) {
    return std::max(u, 0.0) + std::log1p(std::exp(-std::abs(u)));
}
double logistic(double u) {
    const double e = std::exp(-std::abs(u));
    return (u < 0 ? e : 1) / (1 + e);
}

Mapped logit_at(double least, double most, double u) {
    const double range = most - least, share = logistic(u), rest = logistic(-u);
    return {u < 0 ? least + range * share : most - range * rest, range * share * rest,
            std::log(range) - soft_plus(u) - soft_plus(-u), rest - share};
}

}  // namespace

Mapped Transform::at(double u) const {
    if (least == most) return {least, 0, 0, 0};
    const bool has_least = std::isfinite(least), has_most = std::isfinite(most);
    if (has_least && has_most) return logit_at(least, most, u);
    if (has_least) return {least + std::exp(u), std::exp(u), u, 1};
    if (has_most) return {most - std::exp(-u), std::exp(-u), -u, -1};
    return {u, 1, 0, 0};
}

double Transform::inverse(double x) const {
    if (least == most) return 0;
    const bool has_least = std::isfinite(least), has_most = std::isfinite(most);
    if (has_least && has_most) return std::log((x - least) / (most - x));
    if (has_least) return std::log(x - least);
    if (has_most) return -std::log(most - x);
    return x;
}

Transform transform_of(const Prior& prior) {
    if (prior.kind == PriorKind::fixed) return {fixed_value(prior), fixed_value(prior)};
    const bool is_positive =
        prior.kind == PriorKind::lognormal || prior.kind == PriorKind::gamma;
    if (!is_positive || prior.is_normalised) return {prior.least, prior.most};
    return {std::max(0.0, prior.least), prior.most};
}

PriorDensity::PriorDensity(const Prior& prior)
    : prior_(prior), transform_(transform_of(prior)) {
    if (prior.kind == PriorKind::fixed) return;
    const StandardPrior standard(prior);
    offset_ = standard.offset;
    scale_ = standard.scale;
    constant_ = constant_of(prior) - std::log(scale_);
    if (!standard.is_whole()) constant_ -= std::log(standard.mass());
}

LogDensity PriorDensity::at(double x) const {
    if (x < transform_.least || x > transform_.most) return {-unbounded, 0};
    const LogDensity kernel =
        kernel_of(prior_, place_at((x - offset_) / scale_, 1 / scale_));
    return {kernel.value + constant_, kernel.derivative};
}

LogDensity PriorDensity::on_the_line(double u) const {
    const Mapped mapped = transform_.at(u);
    if (std::isinf(mapped.x)) return {-unbounded, 0};
    Place place = place_at((mapped.x - offset_) / scale_, mapped.slope / scale_);
    const bool is_logit =
        std::isfinite(transform_.least) && std::isfinite(transform_.most);
    if (transform_.least == offset_) {
        place.log_t = is_logit
                          ? std::log((transform_.most - offset_) / scale_) - soft_plus(-u)
                          : u - std::log(scale_);
        place.by_log_t = is_logit ? logistic(-u) : 1;
    }
    if (is_logit && transform_.most == offset_ + scale_) {
        place.log_rest = -soft_plus(u);
        place.by_log_rest = -logistic(u);
    }
    const LogDensity kernel = kernel_of(prior_, place);
    return {kernel.value + constant_ + mapped.log_slope,
            kernel.derivative + mapped.log_slope_derivative};
}

/// Of a beta by its distance from either end.
double PriorDensity::quantile_on_the_line(double p) const {
    constexpr double most_u = 700;  // its exponential is a number
    double u = transform_.inverse(prior_.quantile(p));
    if (prior_.kind == PriorKind::beta) {
        const Distribution share{Family::beta, prior_.a, prior_.b};
        const Distribution rest{Family::beta, prior_.b, prior_.a};
        u = std::log(share.quantile(p)) - std::log(rest.upper_quantile(p));
    }
    return std::clamp(u, -most_u, most_u);
}

}  // namespace bemcal::stats
