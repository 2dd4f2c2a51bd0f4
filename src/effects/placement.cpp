/// Puts effects into a building: each becomes a profile, changes of the inputs that its
/// hook names or a part that is added, and one parameter whose targets are all of them.
/// Follows from physics::Change. Ranges are twice what is plausible, cut where physics
/// ends.
/// Left out: fitting; ways of entering are in entering, by the hook's row.
#include "effects/placement.hpp"

#include "base/error.hpp"
#include "effects/decisions.hpp"
#include "effects/hooks.hpp"
#include "effects/placer.hpp"
#include "effects/profiles.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

using physics::ChangeKind;

/// Shares that keep 1 + coefficient x profile above 0.
Range positive_share(Range range, const std::vector<double>& profile) {
    const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
    if (*most > 0)
        range.least = std::max(range.least, -decisions::most_taken_away / *most);
    if (*least < 0)
        range.most = std::min(range.most, -decisions::most_taken_away / *least);
    return range;
}

/// A range about 0: wider than what is plausible, cut where physics ends.
Range range_of(const HookRow& hook, const Effect& effect,
               const std::vector<double>& profile) {
    if (effect.other_hours) return {1, 1};
    double most = decisions::times_plausible *
                  std::max(std::abs(effect.least), std::abs(effect.most));
    if (hook.range != nullptr) return hook.range(most);
    if (hook.kind == ChangeKind::schedule)
        most = std::min(most, decisions::most_of_another_day);
    const Range range{-most, most};
    return hook.kind == ChangeKind::factor ? positive_share(range, profile) : range;
}

void put_in(const Effect& effect, Placer& placer) {
    const HookRow& hook = row_of(effect.hook);
    const Range range = range_of(hook, effect, profile_of(effect, placer.around()));
    physics::Parameter coefficient;
    coefficient.name = placer.has(effect.name)
                           ? fmt::format("{}: {}", effect.name, sentence_of(effect))
                           : effect.name;
    coefficient.unit = unit_of(effect);
    coefficient.least = range.least;
    coefficient.most = range.most;
    placer.begin(std::move(coefficient));
    hook.enter(placer, hook, effect);
}

Placed placed(std::span<const Effect> effects, const Surroundings& around) {
    Placer placer(around);
    for (const Effect& effect : effects) put(effect, placer);
    return {std::move(placer.building()), placer.drive(), placer.parameters()};
}

bool has_other_hours(const Effect& effect) {
    return effect.other_hours.has_value();
}

}  // namespace

void put(const Effect& effect, Placer& placer) {
    try {
        put_in(effect, placer);
    } catch (const CannotSimulate& error) {
        throw CannotSimulate(fmt::format("effect '{}': {}", effect.name, error.what()));
    }
}

physics::Drive with_other_hours(std::span<const Effect> effects,
                                const physics::Drive& declared) {
    physics::Drive drive = declared;
    for (const Effect& effect : effects) {
        if (!effect.other_hours) continue;
        const OtherHours& other = *effect.other_hours;
        const auto numbers = drive.profiles.row(static_cast<std::size_t>(other.numbers));
        const auto row = drive.profiles.row(static_cast<std::size_t>(other.profile));
        for (std::size_t k = 0; k < row.size(); ++k)
            row[k] = physics::runs_at(other.hours, static_cast<int>(numbers[k]))
                         ? other.high
                         : other.low;
    }
    return drive;
}

Placed place(std::span<const Effect> effects, const Surroundings& around) {
    if (std::ranges::none_of(effects, has_other_hours)) return placed(effects, around);
    const physics::Drive drive = with_other_hours(effects, *around.drive);
    Surroundings moved = around;
    moved.drive = &drive;
    return placed(effects, moved);
}

std::optional<std::string> objection(const Effect& effect, const Surroundings& around) {
    Placer placer(around);
    try {
        put_in(effect, placer);
    } catch (const CannotSimulate& error) {
        return error.what();
    }
    if (!placer.acts()) return "it has no say at any step of this period";
    return std::nullopt;
}

}  // namespace bemcal::effects
