/// All effects that a loop may try: the catalogue's with every shape, facade and meter,
/// then the grammar's hook x driver x shape x gate. What a building cannot take is left
/// out.
/// The grammar's table is our own, of what makes physical sense; its ranges are
/// judgement. Whether an effect is there is not decided here, nor are days found.
#include "effects/placement.hpp"
#include "effects/variants.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

/// What a hook of the grammar may follow.
enum Group : unsigned {
    hours = 1,        ///< windows of three hours on weekdays
    days = 2,         ///< weekends and their days
    seasons_ = 4,     ///< windows of two months
    temperature = 8,  ///< hinges of outdoor temperature
    wind = 16,
    sun = 32,
    moisture = 64,
    occupation = 128,  ///< while nobody is there
    trend = 256,
    steps = 512,     ///< at every month
    columns = 1024,  ///< of the job, linear
    calendar = hours | days | seasons_,
    anything = calendar | temperature | occupation | steps | columns
};

/// A row of the grammar; coefficients of a profile that reaches 1.
struct Cell {
    Hook hook;
    unsigned groups;
    double most, typical;
    Each each = Each::once;
};

constexpr Cell grammar[] = {
    {Hook::outdoor_air, hours | seasons_ | columns, 4, 1},
    {Hook::supply_air, hours | seasons_ | temperature, 8, 2},
    {Hook::opaque_boundary, hours | seasons_ | wind, 10, 3},
    {Hook::window_boundary, seasons_ | sun, 6, 2},
    {Hook::infiltration, (anything & ~unsigned{steps}) | trend | sun, 4, 0.5},
    {Hook::ventilation, anything | trend | moisture, 1, 0.3},
    {Hook::opaque_conductance, seasons_ | wind | trend | columns, 0.6, 0.2},
    {Hook::window_conductance, hours | seasons_ | wind, 0.6, 0.2},
    {Hook::neighbour, columns, 0.5, 0.1},
    {Hook::aperture, hours | seasons_ | temperature | columns, 0.9, 0.4},
    {Hook::gains, anything | wind | sun | trend, 15, 4},
    {Hook::loads, calendar | temperature | columns, 1, 0.25},
    {Hook::lights_and_equipment, anything | sun | trend, 15, 4},
    {Hook::heating_set_point, anything | wind | sun, 6, 1.5},
    {Hook::cooling_set_point, anything | moisture | trend, 6, 1.5},
    {Hook::heating_efficiency, hours | seasons_ | temperature, 0.5, 0.15},
    {Hook::cooling_cop, hours | seasons_ | temperature | wind, 0.5, 0.15},
    {Hook::meter_addition, (anything & ~unsigned{columns}) | trend, 15, 3, Each::meter},
    {Hook::meter_factor, seasons_ | trend, 0.5, 0.15, Each::meter}};

std::vector<Effect> of_calendar(unsigned groups) {
    std::vector<Effect> cells;
    for (int from = 0; from < 24 && (groups & hours) != 0; from += 3)
        cells.push_back({.driver = Driver::hour,
                         .shape = {Form::within, double(from), double(from + 3)},
                         .gate = Gate::weekday});
    if ((groups & days) != 0)
        for (const Driver day : {Driver::weekend, Driver::saturday, Driver::sunday})
            cells.push_back({.driver = day});
    if ((groups & seasons_) != 0)
        for (const auto& [from, until] :
             {Hours{0, 59}, {59, 120}, {120, 181}, {181, 243}, {243, 304}, {304, 366}})
            cells.push_back(
                {.driver = Driver::day_of_year, .shape = {Form::within, from, until}});
    if ((groups & trend) != 0) cells.push_back({.driver = Driver::elapsed});
    for (int month = 1; month < 24 && (groups & steps) != 0; ++month)
        cells.push_back({.driver = Driver::elapsed, .shape = {Form::over, month / 12.0}});
    return cells;
}

std::vector<Effect> of_weather(unsigned groups) {
    std::vector<Effect> cells;
    if ((groups & temperature) != 0) {
        for (const double at : {5.0, 10.0, 15.0})
            cells.push_back({.driver = Driver::theta_e, .shape = {Form::below, at}});
        for (const double at : {15.0, 20.0, 25.0})
            cells.push_back({.driver = Driver::theta_e, .shape = {Form::above, at}});
    }
    if ((groups & wind) != 0) cells.push_back({.driver = Driver::wind});
    if ((groups & sun) != 0) cells.push_back({.driver = Driver::sun_horizontal});
    if ((groups & moisture) != 0)
        cells.push_back({.driver = Driver::moisture, .shape = {Form::above, 10}});
    return cells;
}

std::vector<Effect> cells_of(const Cell& row, const Surroundings& around) {
    std::vector<Effect> cells = of_calendar(row.groups);
    const std::vector<Effect> weather = of_weather(row.groups);
    cells.insert(cells.end(), weather.begin(), weather.end());
    if ((row.groups & occupation) != 0) cells.push_back({.gate = Gate::unoccupied});
    if ((row.groups & columns) != 0)
        for (const auto& [name, values] : around.columns)
            cells.push_back({.driver = Driver::column, .column = name});
    for (Effect& cell : cells) cell.hook = row.hook;
    return cells;
}

/// Coefficients in the unit of the driver, by the largest value of its profile.
void scale(const Cell& row, const Surroundings& around, Effect& effect) {
    double largest = 0;
    for (const double value : profile_of(effect, around))
        largest = std::max(largest, std::abs(value));
    const double unit = largest > 0 && row.hook != Hook::neighbour ? largest : 1;
    effect.most = row.most / unit;
    effect.least = -effect.most;
    effect.typical = row.typical / unit;
}

bool can_enter(const Effect& effect, const Surroundings& around) {
    return !objection(effect, around).has_value();
}

/// The catalogue's, whether they can enter or not.
std::vector<Effect> expanded(const Surroundings& around, std::span<const int> meters) {
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
                                     std::span<const int> meters) {
    std::vector<Effect> candidates = expanded(around, meters);
    std::erase_if(candidates,
                  [&](const Effect& effect) { return !can_enter(effect, around); });
    return candidates;
}

std::vector<Effect> generic_candidates(const Surroundings& around,
                                       std::span<const int> meters) {
    const std::vector<Effect> named = expanded(around, meters);
    const auto is_named = [&](const Effect& effect) {
        return std::any_of(named.begin(), named.end(),
                           [&](const Effect& one) { return are_equal(one, effect); });
    };
    std::vector<Effect> candidates;
    for (const Cell& row : grammar)
        for (const Effect& cell : cells_of(row, around))
            for (Effect& one : variants(cell, row.each, around, meters)) {
                if (is_named(one) || !can_enter(one, around)) continue;
                scale(row, around, one);
                one.name = fmt::format("{}: {}", name_of(one.hook), sentence_of(one));
                candidates.push_back(std::move(one));
            }
    return candidates;
}

}  // namespace bemcal::effects
