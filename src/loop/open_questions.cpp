/// Makes the other models: a rival of its class in an effect's place, calibrated.
/// Follows from `class_of`. Left out: two questions at once; rivals of the grammar, which
/// have no name to tell; effects that are one with a parameter, which no reading tells.
#include "loop/open_questions.hpp"

#include "loop/decisions.hpp"
#include "loop/moves.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

/// The effect of a class that has this name; nullptr where it is only a word.
const effects::Effect* rival_named(const Found& found, const std::string& name) {
    const auto rival = std::ranges::find(found.rivals, name, &effects::Effect::name);
    return rival == found.rivals.end() ? nullptr : &*rival;
}

/// Nobody asks for slopes where it ends.
constexpr study::FitOptions settled{to_settle.most_steps, to_settle.tolerance,
                                    study::without_derivatives};

void add_rivals(const LoopData& data, const Place& place, const Standing& last,
                std::size_t effect, const Found& found, std::vector<OtherAnswer>& all) {
    const std::string& own = last.model.effects[effect].name;
    for (const auto& [name, probability] : found.names) {
        const effects::Effect* rival = rival_named(found, name);
        if (rival == nullptr || name == own) continue;
        const Standing other = with_in_place(
            data, place, last,
            {effect, *rival, start_of_rival(last, effect, *rival), settled});
        if (other.fit.failed) continue;
        all.push_back({fmt::format("{}, or {}?", own, name), other.model.effects,
                       other.fit.at.x, evidence(data, other, last)});
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
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < last.built.first_effect(); ++k) {
        const bool is_of_job = std::ranges::any_of(
            data.building.parameters, [&](const physics::Parameter& parameter) {
                return parameter.name == last.built.unknowns[k].name;
            });
        if (is_of_job && sds[k] > decisions::wide_parameter) found.push_back(k);
    }
    return found;
}

}  // namespace bemcal::loop
