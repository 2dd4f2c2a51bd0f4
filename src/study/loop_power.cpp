#include "study/loop_power.hpp"

#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bemcal::study {
namespace {

/// An effect of the catalogue in all its shapes and places.
struct Named {
    std::vector<effects::Effect> variants;
    std::optional<Screened> screened{};
};

std::vector<Named> by_name(const LoopData& data, const Place& place) {
    std::vector<Named> all;
    for (effects::Effect& effect :
         effects::named_candidates(*place.surroundings, data.quantities())) {
        if (all.empty() || all.back().variants[0].name != effect.name) all.emplace_back();
        all.back().variants.push_back(std::move(effect));
    }
    return all;
}

/// The catalogue's effects, each in the first of its variants that moves a meter.
std::vector<Screened> one_of_each(const LoopData& data, const Place& place,
                                  const Standing& standing) {
    std::vector<Named> all = by_name(data, place);
    std::vector<effects::Effect> tried;
    for (std::size_t variant = 0; variant == 0 || !tried.empty(); ++variant) {
        tried.clear();
        for (const Named& named : all)
            if (!named.screened && variant < named.variants.size())
                tried.push_back(named.variants[variant]);
        for (Screened& screened :
             screen(data, place, standing, tried, Keep::of_typical)) {
            const auto same = [&](const Named& named) {
                return named.variants[0].name == screened.effect.name;
            };
            std::ranges::find_if(all, same)->screened = std::move(screened);
        }
    }
    std::vector<Screened> chosen;
    for (Named& named : all)
        if (named.screened) chosen.push_back(std::move(*named.screened));
    return chosen;
}

void find_alias(std::size_t row, PowerTable& table) {
    Power& power = table.rows[row];
    if (is_in_parameters(power)) {
        power.alias = effects::same_as(power.effect);
        power.correlation = 1;
        if (!power.alias.empty()) return;
        power.alias = "the calibrated parameters themselves";
        power.correlation = std::sqrt(1 - power.visibility);
        return;
    }
    for (std::size_t other = 0; other < table.rows.size(); ++other) {
        if (other == row) continue;
        const double rho = correlation_of(table.screened[row].signature,
                                          table.screened[other].signature, table.weights);
        if (std::abs(rho) <= std::abs(power.correlation)) continue;
        power.correlation = rho;
        power.alias = table.rows[other].effect.name;
    }
}

void find_bias(const Standing& standing, const Screened& screened, Power& power) {
    for (std::size_t k = 0; k < screened.bias.size(); ++k)
        if (std::abs(screened.bias[k]) > std::abs(power.bias)) {
            power.bias = screened.bias[k];
            power.parameter = standing.built.unknowns[k].name;
        }
}

}  // namespace

bool is_in_parameters(const Power& power) {
    constexpr double same = 0.98;  ///< correlation of what is one signature
    return power.visibility < 1 - same * same;
}

bool can_be_seen(const Power& power) {
    constexpr double least = 5;
    return power.detectability >= least;
}

double correlation_of(std::span<const double> a, std::span<const double> b,
                      std::span<const double> weights) {
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ab += weights[k] * a[k] * b[k];
        aa += weights[k] * a[k] * a[k];
        bb += weights[k] * b[k] * b[k];
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

PowerTable power_of(const LoopData& data, const Place& place, const Standing& standing) {
    PowerTable table;
    table.screened = one_of_each(data, place, standing);
    table.weights = weights_of(data.targets, standing.noise);
    for (const Screened& screened : table.screened) {
        Power power{screened.effect, 0, 0, {}, 0, {}, 0};
        power.detectability =
            std::abs(screened.effect.typical) * std::sqrt(screened.information);
        power.visibility = screened.visibility;
        find_bias(standing, screened, power);
        table.rows.push_back(std::move(power));
    }
    for (std::size_t row = 0; row < table.rows.size(); ++row) find_alias(row, table);
    return table;
}

}  // namespace bemcal::study
