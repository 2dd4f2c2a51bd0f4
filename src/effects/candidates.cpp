/// All effects that a loop may try: the catalogue's with every shape, facade and meter,
/// then the grammar's hook x driver x shape x gate. What a building cannot take is left
/// out.
/// Follows from the rows of the catalogue, of hooks and of drivers.
/// Whether an effect is there is not decided here, nor are days found.
#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "effects/placement.hpp"
#include "effects/profiles.hpp"
#include "effects/variants.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

/// The effects of a driver's cells, of columns one for each that the job has.
void add_cells(const DriverRow& driver, const Cells& cells, const Surroundings& around,
               std::vector<Effect>& all) {
    for (const Shape& shape : cells.shapes()) {
        const Effect effect{.driver = driver.driver, .shape = shape, .gate = cells.gate};
        if (driver.driver != Driver::column)
            all.push_back(effect);
        else
            for (const auto& [name, values] : around.columns) {
                all.push_back(effect);
                all.back().column = name;
            }
    }
}

/// All that the grammar tries at a hook, group by group.
std::vector<Effect> cells_of(const HookRow& hook, const Surroundings& around) {
    std::vector<Effect> all;
    for (const GroupRow& group : group_rows) {
        if ((hook.grammar.follows & group.group) == 0) continue;
        for (const DriverRow& driver : driver_rows())
            for (const Cells& cells : driver.grammar)
                if (cells.group == group.group) add_cells(driver, cells, around, all);
    }
    for (Effect& effect : all) effect.hook = hook.hook;
    return all;
}

/// Coefficients in the unit of the driver, by the largest value of its profile.
void scale(const HookRow& hook, const Surroundings& around, Effect& effect) {
    double largest = 0;
    for (const double value : profile_of(effect, around))
        largest = std::max(largest, std::abs(value));
    const double unit = largest > 0 && hook.is_per_driver ? largest : 1;
    effect.most = hook.grammar.most / unit;
    effect.least = -effect.most;
    effect.typical = hook.grammar.typical / unit;
}

bool can_enter(const Effect& effect, const Surroundings& around) {
    return !objection(effect, around).has_value();
}

/// The catalogue's, whether they can enter or not.
std::vector<Effect> expanded(const Surroundings& around,
                             std::span<const physics::Quantity> meters) {
    std::vector<Effect> all;
    for (const Entry& entry : catalogue()) {
        std::vector<Shape> shapes = entry.shapes;
        if (shapes.empty()) shapes.push_back(entry.effect.shape);
        for (const Shape& shape : shapes) {
            Effect effect = entry.effect;
            effect.shape = shape;
            for (Effect& one : variants(effect, entry.each, around, meters))
                all.push_back(std::move(one));
        }
    }
    return all;
}

}  // namespace

std::vector<Effect> named_candidates(const Surroundings& around,
                                     std::span<const physics::Quantity> meters) {
    std::vector<Effect> candidates = expanded(around, meters);
    std::erase_if(candidates,
                  [&](const Effect& effect) { return !can_enter(effect, around); });
    return candidates;
}

std::vector<Effect> generic_candidates(const Surroundings& around,
                                       std::span<const physics::Quantity> meters) {
    const std::vector<Effect> named = expanded(around, meters);
    const auto is_named = [&](const Effect& effect) {
        return std::any_of(named.begin(), named.end(),
                           [&](const Effect& one) { return are_equal(one, effect); });
    };
    std::vector<Effect> candidates;
    for (const HookRow& hook : hook_rows()) {
        const Each each = hook.is_at_a_meter ? Each::meter : Each::once;
        for (const Effect& cell : cells_of(hook, around))
            for (Effect& one : variants(cell, each, around, meters)) {
                if (is_named(one) || !can_enter(one, around)) continue;
                scale(hook, around, one);
                one.name = fmt::format("{}: {}", name_of(one.hook), sentence_of(one));
                candidates.push_back(std::move(one));
            }
    }
    return candidates;
}

}  // namespace bemcal::effects
