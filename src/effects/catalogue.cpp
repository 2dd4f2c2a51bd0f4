/// The rows of the groups in one list, by number, and what is looked up there: a row by
/// name, shapes of thresholds, windows, seasons and dates.
/// Plain bookkeeping; the rows are judgement (envelope_rows, use_rows, plant_rows). Dates
/// of steps are tried by months, up to the 23rd: finer ones are left to the search.
#include "effects/catalogue.hpp"

#include "effects/rows.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

constexpr int last_number = 45;

std::vector<Entry> all_rows() {
    std::vector<Entry> rows;
    for (int number = 1; number <= last_number; ++number)
        for (const auto& group : {envelope_rows(), use_rows(), plant_rows()})
            std::copy_if(
                group.begin(), group.end(), std::back_inserter(rows),
                [&](const Entry& entry) { return entry.effect.number == number; });
    return rows;
}

const Entry* find(const std::string& name) {
    const auto rows = catalogue();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Entry& entry) {
        return entry.effect.name == name;
    });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Shape> at_each(Form form, std::initializer_list<double> thresholds) {
    std::vector<Shape> shapes;
    shapes.reserve(thresholds.size());
    for (const double at : thresholds) shapes.push_back({form, at});
    return shapes;
}

std::vector<Shape> windows(std::initializer_list<Hours> ends) {
    std::vector<Shape> shapes;
    shapes.reserve(ends.size());
    for (const Hours& window : ends)
        shapes.push_back({Form::within, window.from, window.until});
    return shapes;
}

std::vector<Shape> seasons() {
    return windows({{334, 59},
                    {59, 151},
                    {151, 243},
                    {243, 334},
                    {304, 59},
                    {120, 243},
                    {90, 273},
                    {273, 90}});
}

std::vector<Shape> dates() {
    std::vector<Shape> shapes;
    for (int month = 1; month < 24; ++month) shapes.push_back({Form::over, month / 12.0});
    return shapes;
}

std::span<const Entry> catalogue() {
    static const std::vector<Entry> rows = all_rows();
    return rows;
}

const Entry* entry_of(const Effect& effect) {
    return effect.number == 0 ? nullptr : find(effect.name);
}

std::string same_as(const Effect& effect) {
    const Entry* entry = entry_of(effect);
    return entry == nullptr ? "" : entry->same_as;
}

Effect with_days(const std::string& name, std::vector<Days> days) {
    const Entry* entry = find(name);
    if (entry == nullptr || entry->each != Each::found_days)
        throw std::invalid_argument(
            fmt::format("'{}' is no effect of days that are found", name));
    Effect effect = entry->effect;
    effect.days = std::move(days);
    return effect;
}

Effect closed_days(std::vector<Days> days) {
    return with_days("holidays", std::move(days));
}

}  // namespace bemcal::effects
