/// Says which candidates cannot be told from the chosen one: their losses in unseen
/// blocks, pair by pair, are larger by no more than chance shows in one of twenty.
/// Source: Hansen, Lunde and Nason 2011 (model confidence set), with pairs.
/// Leaves out candidates with clearly less evidence. A few blocks decide little, so
/// classes of weak effects are large.
#include "loop/rivals.hpp"

#include "effects/catalogue.hpp"
#include "loop/decisions.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

/// Weighted squares of what unseen blocks leave. [blocks]
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

/// Only what has most of the evidence, too; a term of the grammar, which often says the
/// same with other words, where it has clearly more.
bool is_near(const Refitted& other, const Refitted& chosen) {
    const double share = other.effect.is_named() ? decisions::rival_share
                                                 : decisions::rival_share_of_grammar;
    return other.gain > share * chosen.gain;
}

void add_alias(const Refitted& chosen, std::vector<std::string>& names) {
    const std::string alias = effects::same_as(chosen.effect);
    if (!alias.empty() && names.size() == 1) names.push_back(alias);
}

}  // namespace

bool is_as_good(std::span<const double> losses, std::span<const double> chosen) {
    const auto n = static_cast<double>(losses.size());
    double sum = 0, square = 0;
    for (std::size_t b = 0; b < losses.size(); ++b) {
        const double more = losses[b] - chosen[b];
        sum += more;
        square += more * more;
    }
    const double spread = std::sqrt(std::max(0.0, square - sum * sum / n));
    return sum <=
           std::max(stats::z_90_two_sided * spread, decisions::negligible_evidence);
}

EffectClass class_of(const LoopData& data, const Standing& before, const Step& step) {
    const Refitted& chosen = step.ranking[static_cast<std::size_t>(step.chosen)];
    const auto own = losses_of(data, before, chosen.left_out);
    EffectClass found{{chosen.effect.name}, {}, true};
    for (const Refitted& other : step.ranking) {
        if (&other == &chosen || other.left_out.empty()) continue;
        if (found.rivals.size() < decisions::most_rivals)
            found.rivals.push_back(other.effect);
        if (!is_near(other, chosen) || other.effect.name == chosen.effect.name ||
            !is_as_good(losses_of(data, before, other.left_out), own))
            continue;
        found.is_told = false;
        if (other.effect.is_named() &&
            found.names.size() < decisions::most_names_of_class &&
            std::ranges::find(found.names, other.effect.name) == found.names.end())
            found.names.push_back(other.effect.name);
    }
    add_alias(chosen, found.names);
    return found;
}

}  // namespace bemcal::loop
