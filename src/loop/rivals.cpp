/// Says how probable the names are that could stand for what a step found: by what each
/// explains of blocks of the training period that are drawn with replacement.
/// Source: Huggins and Miller 2023 (Bayesian Analysis 18), bagged posteriors.
/// Leaves out names that were not judged, and causes that the catalogue lacks but as far
/// as a term of the grammar shows them.
#include "loop/rivals.hpp"

#include "base/random.hpp"
#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::loop {
namespace {

/// Of all claims of one name: their mean likelihood.
struct Shares {
    std::string name;
    std::vector<std::size_t> claims{};

    double log_weight(std::span<const double> totals) const {
        double most = -std::numeric_limits<double>::infinity(), sum = 0;
        for (const std::size_t claim : claims) most = std::max(most, totals[claim]);
        for (const std::size_t claim : claims)
            sum += std::exp(0.5 * (totals[claim] - most));
        return 0.5 * most + std::log(sum / static_cast<double>(claims.size()));
    }
};

std::vector<Shares> by_name(const std::vector<Claim>& claims) {
    std::vector<Shares> all;
    for (std::size_t k = 0; k < claims.size(); ++k) {
        auto shares = std::ranges::find(all, claims[k].name, &Shares::name);
        if (shares == all.end()) shares = all.insert(all.end(), {claims[k].name});
        shares->claims.push_back(k);
    }
    return all;
}

/// [claims] evidence over blocks that are drawn with replacement.
std::vector<double> drawn_totals(const std::vector<Claim>& claims, Stream& random) {
    const std::size_t n = claims.front().falls.size();
    std::vector<double> totals;
    totals.reserve(claims.size());
    for (const Claim& claim : claims) totals.push_back(claim.rest);
    for (std::size_t drawn = 0; drawn < n; ++drawn) {
        const std::size_t block = random.below(static_cast<std::uint32_t>(n));
        for (std::size_t k = 0; k < claims.size(); ++k)
            totals[k] += claims[k].falls[block];
    }
    return totals;
}

/// Adds shares of one, of exp(log weights).
void add_shares(std::span<const double> log_weights, std::vector<double>& shares) {
    const double most = std::ranges::max(log_weights);
    double sum = 0;
    for (const double weight : log_weights) sum += std::exp(weight - most);
    for (std::size_t k = 0; k < shares.size(); ++k)
        shares[k] += std::exp(log_weights[k] - most) / sum;
}

/// Weighted squares of what is left. [blocks]
std::vector<double> losses_of(const LoopData& data, const Standing& before,
                              std::span<const double> left) {
    const auto weights = weights_of(data.targets, before.noise);
    std::vector<double> losses(
        static_cast<std::size_t>(1 + *std::ranges::max_element(data.blocks)), 0.0);
    for (std::size_t k = 0; k < left.size(); ++k)
        losses[static_cast<std::size_t>(data.blocks[k])] +=
            weights[k] * left[k] * left[k];
    return losses;
}

/// The name that a candidate claims.
std::string claimed_by(const effects::Effect& effect) {
    return effect.is_named() ? effect.name : "";
}

/// Of the candidates that were judged.
std::vector<Claim> claims_of(const LoopData& data, const Standing& before,
                             const Step& step) {
    const auto losses = losses_of(data, before, before.residuals);
    std::vector<Claim> claims;
    for (const Refitted& candidate : step.ranking) {
        if (candidate.left_out.empty()) continue;
        Claim claim{claimed_by(candidate.effect),
                    losses_of(data, before, candidate.standing.residuals),
                    candidate.gain};
        for (std::size_t b = 0; b < losses.size(); ++b) {
            claim.falls[b] = losses[b] - claim.falls[b];
            claim.rest -= claim.falls[b];
        }
        claims.push_back(std::move(claim));
    }
    return claims;
}

/// The chosen one's name first; others as long as they are probable.
std::vector<Named> names_of(const std::string& chosen, std::vector<Named> all) {
    std::ranges::stable_sort(all, [&](const Named& a, const Named& b) {
        if ((a.name == chosen) != (b.name == chosen)) return a.name == chosen;
        return a.probability > b.probability;
    });
    std::erase_if(all, [&](const Named& one) {
        return one.name != chosen &&
               (one.name.empty() || one.probability < decisions::least_probability);
    });
    all.resize(std::min(all.size(), decisions::most_names_of_class));
    return all;
}

}  // namespace

std::vector<Named> bagged(const std::vector<Claim>& claims, std::uint64_t seed) {
    const std::vector<Shares> names = by_name(claims);
    std::vector<double> shares(names.size() + 1, 0.0), log_weights(shares.size(), 0.0);
    for (int draw = 0; draw < decisions::bagging_draws; ++draw) {
        Stream random(seed, 0, static_cast<std::uint64_t>(draw));
        const std::vector<double> totals = drawn_totals(claims, random);
        for (std::size_t k = 0; k < names.size(); ++k)
            log_weights[k] = names[k].log_weight(totals);  // the last is nothing: 0
        add_shares(log_weights, shares);
    }
    std::vector<Named> all{{"", shares.back() / decisions::bagging_draws}};
    for (std::size_t k = 0; k < names.size(); ++k) {
        const double probability = shares[k] / decisions::bagging_draws;
        if (names[k].name.empty())
            all.front().probability += probability;
        else
            all.push_back({names[k].name, probability});
    }
    return all;
}

EffectClass class_of(const LoopData& data, const Standing& before, const Step& step) {
    const Refitted& chosen = step.ranking[static_cast<std::size_t>(step.chosen)];
    EffectClass found;
    found.names = names_of(claimed_by(chosen.effect),
                           bagged(claims_of(data, before, step), data.options.seed));
    found.names.front().name = chosen.effect.name;
    for (const Refitted& other : step.ranking)
        if (&other != &chosen && !other.left_out.empty() &&
            found.rivals.size() < decisions::most_rivals)
            found.rivals.push_back(other.effect);
    return found;
}

}  // namespace bemcal::loop
