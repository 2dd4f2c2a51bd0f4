/// Places a small effect at every hook, once to each side, and steps the buildings with
/// it beside the one without. Follows from `functions::linear_steps`. Hooks that only
/// open or shut, and those that move schedules, have no slope and are left out.
#include "loop/linear_model.hpp"

#include "base/error.hpp"
#include "effects/hooks.hpp"
#include "loop/decisions.hpp"

#include <memory>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using decisions::moved_share;

/// What may bring more or less than the description says: one effect for each hook, and
/// for those at a meter one for each meter.
std::vector<effects::Effect> hooks_of(const LoopData& data) {
    std::vector<effects::Effect> hooks;
    for (const effects::HookRow& row : effects::hook_rows()) {
        if (!(row.grammar.typical > 0)) continue;
        effects::Effect effect;
        effect.name = row.name;
        effect.hook = row.hook;
        effect.typical = row.grammar.typical;
        effect.most = row.grammar.most;
        effect.least = -effect.most;
        if (!row.is_at_a_meter) {
            hooks.push_back(effect);
            continue;
        }
        for (const physics::Quantity quantity : data.quantities()) {
            if (physics::is_temperature(quantity)) continue;
            effect.meter = quantity;
            effect.name = fmt::format("{} of {}", row.name, physics::name_of(quantity));
            hooks.push_back(effect);
        }
    }
    return hooks;
}

/// The standing model with a hook moved: buildings that bring more and less.
struct MovedModel {
    BuiltModel built;
    physics::Building more, less;
};

/// nullptr where the building has no such hook, or it cannot move both ways.
std::unique_ptr<MovedModel> moved_model(const Place& place, const Standing& standing,
                                        const effects::Effect& hook) {
    std::vector<effects::Effect> all = standing.model.effects;
    all.push_back(hook);
    try {
        auto moved = std::make_unique<MovedModel>();
        moved->built = place_only(place, all);
        const physics::Parameter& coefficient = moved->built.parameters.back();
        const double by = moved_share * hook.typical;
        if (coefficient.least > -by || coefficient.most < by) return nullptr;
        std::vector<double> values = values_in(moved->built, standing);
        values.back() = by;
        moved->more = building_at(moved->built, values);
        values.back() = -by;
        moved->less = building_at(moved->built, values);
        return moved;
    } catch (const CannotSimulate&) {
        return nullptr;
    }
}

}  // namespace

LinearModel linear_model(const LoopData& data, const Place& place,
                         const Standing& standing) {
    const BuiltModel built = place_only(place, standing.model.effects);
    const physics::Building base = building_at(built, values_in(built, standing));
    std::vector<std::unique_ptr<MovedModel>> models;
    std::vector<functions::Moved> moved;
    LinearModel linear;
    for (const effects::Effect& hook : hooks_of(data)) {
        auto model = moved_model(place, standing, hook);
        if (!model) continue;
        moved.push_back(
            {&model->more, &model->less, &model->built.placed->drive, moved_share});
        linear.hooks.push_back(hook);
        models.push_back(std::move(model));
    }
    linear.steps =
        functions::linear_steps(base, built.placed->drive, data.quantities(), moved);
    return linear;
}

}  // namespace bemcal::loop
