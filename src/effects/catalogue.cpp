/// The rows of the groups in one list, by number, and what is looked up there by name.
/// Plain bookkeeping; the rows are judgement (envelope_rows, use_rows, plant_rows).
/// Shapes are left to shapes.
#include "effects/catalogue.hpp"

#include "effects/rows.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

/// Of one number in the order of the groups and of their rows.
std::vector<Entry> all_rows() {
    std::vector<Entry> rows;
    for (const auto& group : {envelope_rows(), use_rows(), plant_rows()})
        rows.insert(rows.end(), group.begin(), group.end());
    std::ranges::stable_sort(rows, {},
                             [](const Entry& row) { return row.effect.number; });
    return rows;
}

}  // namespace

std::span<const Entry> catalogue() {
    static const std::vector<Entry> rows = all_rows();
    return rows;
}

const Entry* entry_named(const std::string& name) {
    const auto rows = catalogue();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Entry& entry) {
        return entry.effect.name == name;
    });
    return found == rows.end() ? nullptr : &*found;
}

const Entry* entry_of(const Effect& effect) {
    return effect.is_named() ? entry_named(effect.name) : nullptr;
}

std::string same_as(const Effect& effect) {
    const Entry* entry = entry_of(effect);
    return entry == nullptr ? "" : entry->same_as;
}

Effect with_days(const std::string& name, std::vector<Days> days) {
    const Entry* entry = entry_named(name);
    if (entry == nullptr || entry->each != Each::found_days)
        throw std::invalid_argument(
            fmt::format("'{}' is no effect of days that are found", name));
    Effect effect = entry->effect;
    effect.days = std::move(days);
    return effect;
}

Effect with_hours(OtherHours hours) {
    const auto rows = catalogue();
    const auto row = std::ranges::find(rows, Each::found_hours, &Entry::each);
    Effect effect = row->effect;
    effect.place_name = "schedule " + hours.schedule;
    effect.other_hours = std::move(hours);
    return effect;
}

Effect closed_days(std::vector<Days> days) {
    return with_days("holidays", std::move(days));
}

}  // namespace bemcal::effects
