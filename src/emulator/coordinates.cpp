/// From the real line to a likelihood's arguments (logit, log, rate = -4 log rho), with
/// priors and Jacobians, and starts drawn from the priors.
/// Source: Kennedy and O'Hagan's parameters as Chong and Menberg 2018 have them (rho =
/// exp(-rate / 4)). Which arguments there are is model's; a prior's density is
/// PriorDensity's.
#include "emulator/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::emulator {

namespace {

constexpr double farthest_start = 30;  ///< of the real line: e^-30 from an end

struct Argument {
    double value, slope;
};

/// rate = -4 log rho; without loss where rho(u) is near 1.
Argument rate_of(const stats::Transform& transform, double u) {
    if (transform.least == 0 && transform.most == 1) {
        const double e = std::exp(-std::abs(u));
        return {4 * (std::max(-u, 0.0) + std::log1p(e)), -4 * (u < 0 ? 1 : e) / (1 + e)};
    }
    const stats::Mapped rho = transform.at(u);
    return {-4 * std::log(rho.x), -4 * rho.slope / rho.x};
}

Argument argument_of(const Coordinate& c, double u) {
    if (c.is_flat) return {u, 1};
    if (c.role == Role::correlation) return rate_of(c.density.transform(), u);
    const stats::Mapped x = c.density.transform().at(u);
    if (c.role != Role::precision) return {x.x, x.slope};
    const bool is_log =
        c.density.transform().least == 0 && std::isinf(c.density.transform().most);
    return is_log ? Argument{u, 1} : Argument{std::log(x.x), x.slope / x.x};
}

double fixed_argument(Role role, double value) {
    if (role == Role::correlation) return -4 * std::log(value);
    return role == Role::precision ? std::log(value) : value;
}

bool is_possible(Role role, const stats::Prior& prior) {
    const bool fixed = prior.kind == stats::PriorKind::fixed;
    const stats::Transform on = stats::transform_of(prior);
    switch (role) {
        case Role::correlation:
            return fixed ? on.least > 0 && on.least < 1 : on.least >= 0 && on.most <= 1;
        case Role::precision:
            return fixed ? on.least > 0 : on.least >= 0;
        default:
            return std::isfinite(on.least) || !fixed;
    }
}

stats::Prior uniform_share() {
    return {stats::PriorKind::uniform, 0, 1, 0, 1, false};
}

}  // namespace

Coordinates::Coordinates(const Layout& layout, const Priors& priors)
    : layout_(layout), fixed_(layout.size(), 0.0) {
    if (!priors.t.empty() && priors.t.size() != layout.q)
        throw std::invalid_argument(
            fmt::format("{} priors for {} calibrated inputs", priors.t.size(), layout.q));
    for (std::size_t k = 0; k < layout.q; ++k)
        add(Role::t, layout.t() + k, priors.t.empty() ? uniform_share() : priors.t[k],
            "a calibrated input");
    for (std::size_t k = 0; k < layout.p + layout.q; ++k)
        add(Role::correlation, layout.rate_eta() + k, priors.rho_eta, "rho_eta");
    for (std::size_t k = 0; k < layout.p; ++k)
        add(Role::correlation, layout.rate_delta() + k, priors.rho_delta, "rho_delta");
    add(Role::precision, layout.log_lambda_eta(), priors.lambda_eta, "lambda_eta");
    add(Role::precision, layout.log_lambda_delta(), priors.lambda_delta, "lambda_delta");
    add(Role::precision, layout.log_lambda_e(), priors.lambda_e, "lambda_e");
    add(Role::plain, layout.regression(), priors.regression, "the regression factor");
    for (std::size_t k = 0; layout.samples_beta && k < layout.n_beta(); ++k)
        free_.push_back(
            {Role::plain, layout.beta() + k, {}, stats::PriorDensity({}), true});
}

void Coordinates::add(Role role, std::size_t argument, const stats::Prior& prior,
                      const char* what) {
    const std::string complaint = stats::complaint_about(prior);
    if (!complaint.empty())
        throw std::invalid_argument(fmt::format("prior of {}: {}", what, complaint));
    if (!is_possible(role, prior))
        throw std::invalid_argument(
            fmt::format("prior of {}: expected one {}", what,
                        role == Role::correlation ? "on 0 to 1" : "on positive numbers"));
    if (prior.kind == stats::PriorKind::fixed)
        fixed_[argument] = fixed_argument(role, stats::transform_of(prior).least);
    else
        free_.push_back({role, argument, prior, stats::PriorDensity(prior), false});
}

double Coordinates::place(const double* u, double* arguments, double* slopes,
                          double* gradient) const {
    std::ranges::copy(fixed_, arguments);
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) {
        const Coordinate& c = free_[k];
        const Argument argument = argument_of(c, u[k]);
        arguments[c.argument] = argument.value;
        slopes[k] = argument.slope;
        const stats::LogDensity prior =
            c.is_flat ? stats::LogDensity{} : c.density.on_the_line(u[k]);
        sum += prior.value;
        gradient[k] = prior.derivative;
    }
    return sum;
}

double Coordinates::value(std::size_t k, double u) const {
    return free_[k].is_flat ? u : free_[k].density.transform().at(u).x;
}

std::vector<double> Coordinates::draw(Stream& random) const {
    std::vector<double> u(size());
    for (std::size_t k = 0; k < size(); ++k) {
        const double share = random.uniform();
        if (free_[k].is_flat)
            u[k] = 4 * share - 2;  // where standardised outputs are
        else
            u[k] = std::clamp(
                free_[k].density.transform().inverse(free_[k].prior.quantile(share)),
                -farthest_start, farthest_start);
    }
    return u;
}

}  // namespace bemcal::emulator
