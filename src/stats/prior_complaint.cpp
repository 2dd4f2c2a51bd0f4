/// What can be wrong with a prior, in words: its numbers, its range, and the mass in it.
/// Follows from the definitions of the distributions; a mass below 1e-9, that of a normal
/// 6 sd away, counts as a mistake. Whether a prior is sensible is not judged.
#include "stats/prior.hpp"
#include "stats/prior_standard.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::stats {
namespace {

/// A mass below which a range is taken for a mistake: that of a normal that is 6 sd away.
constexpr double least_mass = 1e-9;

std::string named(const Prior& p) {
    if (p.kind == PriorKind::uniform)
        return fmt::format("uniform({}, {})", p.least, p.most);
    if (p.kind == PriorKind::fixed) return fmt::format("fixed({})", p.a);
    return fmt::format("{}({}, {}){}", name_of(p.kind), p.a, p.b,
                       p.is_normalised ? " of the range's share" : "");
}

/// What is wrong with the kind's own two numbers.
std::string complaint_about_numbers(const Prior& p) {
    if (p.kind == PriorKind::uniform) return {};
    if (!std::isfinite(p.a) || (p.kind != PriorKind::fixed && !std::isfinite(p.b)))
        return fmt::format("{}: its numbers must be finite", named(p));
    const bool is_normal = p.kind == PriorKind::normal || p.kind == PriorKind::lognormal;
    if (is_normal && p.b <= 0)
        return fmt::format("{}: the standard deviation {} must be above 0", named(p),
                           p.b);
    if (p.kind == PriorKind::beta && std::min(p.a, p.b) <= 0)
        return fmt::format("{}: both exponents must be above 0", named(p));
    if (p.kind == PriorKind::gamma && std::min(p.a, p.b) <= 0)
        return fmt::format("{}: shape and rate must be above 0", named(p));
    return {};
}

std::string complaint_about_range(const Prior& p) {
    if (std::isnan(p.least) || std::isnan(p.most))
        return fmt::format("{}: an end of its range is not a number", named(p));
    const bool needs_range = p.kind != PriorKind::fixed || p.is_normalised;
    if (needs_range && p.least >= p.most)
        return fmt::format("{}: its range from {} to {} is empty", named(p), p.least,
                           p.most);
    const bool needs_ends =
        p.is_normalised || p.kind == PriorKind::beta || p.kind == PriorKind::uniform;
    if (needs_ends && !std::isfinite(p.most - p.least))
        return fmt::format("{}: needs a finite range, not {} to {}", named(p), p.least,
                           p.most);
    return {};
}

std::string complaint_about_mass(const Prior& p) {
    if (p.kind == PriorKind::fixed) {
        const double x = fixed_value(p);
        if (x >= p.least && x <= p.most) return {};
        return fmt::format("{}: lies outside its range from {} to {}", named(p), p.least,
                           p.most);
    }
    const StandardPrior standard(p);
    const double mass = standard.least < standard.most ? standard.mass() : 0;
    if (mass >= least_mass) return {};
    return fmt::format("{} has a mass of {:.2g} between {} and {}", named(p), mass,
                       p.least, p.most);
}

}  // namespace

std::string complaint_about(const Prior& prior) {
    for (const auto check :
         {complaint_about_numbers, complaint_about_range, complaint_about_mass})
        if (std::string complaint = check(prior); !complaint.empty()) return complaint;
    return {};
}

}  // namespace bemcal::stats
