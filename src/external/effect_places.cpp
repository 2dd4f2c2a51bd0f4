/// Effects as columns of numbers in places of templates.
/// Follows from `HookSeries`: each goes to the place of its hook, facade and meter.
/// Left out: openings that follow the room, which need a temperature beside their hours.
#include "external/effect_places.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::external {
namespace {

/// "aperture, south facade"
std::string words_of(const effects::HookSeries& at) {
    std::string words = at.hook;
    for (const std::string& where : {at.facade, at.meter})
        if (!where.empty()) words += ", " + where;
    return words;
}

std::string lines_of(const std::vector<double>& hours) {
    std::string text;
    for (const double value : hours)
        fmt::format_to(std::back_inserter(text), "{}{:.9g}", text.empty() ? "" : "\n",
                       value);
    return text;
}

}  // namespace

PlacedEffects placed(std::span<const EffectPlace> places,
                     std::span<const study::GivenEffect> effects, std::size_t n_hours) {
    std::vector<std::vector<double>> sums(places.size(), std::vector<double>(n_hours));
    PlacedEffects result;
    for (const study::GivenEffect& effect : effects)
        for (const effects::HookSeries& at : effect.at) {
            const auto place = std::ranges::find_if(places, [&](const EffectPlace& one) {
                return effects::is_same_place(one, at);
            });
            if (place == places.end()) {
                result.left_out.push_back(
                    fmt::format("{}: no [[simulator.effect]] takes it", words_of(at)));
                continue;
            }
            auto& sum = sums[static_cast<std::size_t>(place - places.begin())];
            for (std::size_t h = 0; h < n_hours; ++h) sum[h] += at.values[h];
        }
    for (const auto& sum : sums) result.texts.push_back(lines_of(sum));
    return result;
}

}  // namespace bemcal::external
