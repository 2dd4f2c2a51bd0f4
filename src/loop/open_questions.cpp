/// Makes the other models: a rival of its class in an effect's place, calibrated.
/// Follows from `class_of`. Left out: two questions at once; rivals of the grammar, which
/// have no name to tell; effects that are one with a parameter, which no reading tells.
#include "loop/open_questions.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

/// The effect of a class that has this name; nullptr where it is only a word.
const effects::Effect* rival_named(const Found& found, const std::string& name) {
    const auto rival = std::ranges::find(found.rivals, name, &effects::Effect::name);
    return rival == found.rivals.end() ? nullptr : &*rival;
}

/// The rival in the place of an effect, calibrated; nothing where it cannot be simulated.
std::optional<Standing> in_place_of(const LoopData& data, const Place& place,
                                    const Standing& last, std::size_t effect,
                                    const effects::Effect& rival) {
    Standing other = last;
    other.model.effects[effect] = rival;
    try {
        other.built = build(place, other.model.effects);
    } catch (const CannotSimulate&) {
        return std::nullopt;
    }
    std::vector<double> start = last.fit.at.x;
    start[last.built.first_effect() + effect] = rival.most > 0 ? 0.5 : -0.5;
    refit(data, other, std::move(start), to_settle);
    if (other.fit.failed) return std::nullopt;
    return other;
}

void add_rivals(const LoopData& data, const Place& place, const Standing& last,
                std::size_t effect, const Found& found, std::vector<OtherAnswer>& all) {
    const std::string& own = last.model.effects[effect].name;
    for (const std::string& name : found.equivalents) {
        const effects::Effect* rival = rival_named(found, name);
        if (rival == nullptr || name == own) continue;
        auto other = in_place_of(data, place, last, effect, *rival);
        if (!other) continue;
        const double so_far = evidence(data, *other, last);
        all.push_back({fmt::format("{}, or {}?", own, name),
                       std::move(other->model.effects), std::move(other->fit.at.x),
                       so_far});
    }
}

}  // namespace

std::vector<OtherAnswer> other_answers(const LoopData& data, const Place& place,
                                       const Standing& last,
                                       const std::vector<Found>& found) {
    std::vector<OtherAnswer> all;
    for (std::size_t k = 0; k < found.size(); ++k)
        add_rivals(data, place, last, k, found[k], all);
    return all;
}

std::vector<std::size_t> wide_parameters(const LoopData& data, const Standing& last,
                                         std::span<const double> sds) {
    constexpr double wide = 0.5;  ///< of the prior's standard deviation
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < last.built.first_effect(); ++k) {
        const bool is_of_job = std::ranges::any_of(
            data.building.parameters, [&](const physics::Parameter& parameter) {
                return parameter.name == last.built.unknowns[k].name;
            });
        if (is_of_job && sds[k] > wide) found.push_back(k);
    }
    return found;
}

}  // namespace bemcal::loop
