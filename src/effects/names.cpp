/// Hooks, drivers, forms and gates in words and units, and what else is looked up in the
/// rows of an effect's hook and driver; whether two effects are the same.
/// Plain look-up without a source: a new form or gate needs its word at the same place.
/// Sentences are left to sentence.cpp.
#include "effects/drivers.hpp"
#include "effects/effect.hpp"
#include "effects/hooks.hpp"

#include <algorithm>
#include <tuple>

namespace bemcal::effects {
namespace {

constexpr const char* forms[] = {"linear", "above",  "below", "over",
                                 "under",  "within", "lagged"};

constexpr const char* gates[] = {"always",  "occupied",       "unoccupied",
                                 "day",     "night",          "weekend",
                                 "weekday", "heating season", "cooling season",
                                 "on days", "EU summer time", "US summer time"};

}  // namespace

bool are_equal(const Effect& a, const Effect& b) {
    const auto key = [](const Effect& e) {
        return std::tuple(e.hook, e.driver, e.shape.form, e.shape.at, e.shape.until,
                          e.gate, e.weekday, e.hours.from, e.hours.until, e.facade,
                          e.meter, e.column);
    };
    const auto hours = [](const Effect& e) {
        const OtherHours none;
        const OtherHours& own = e.other_hours ? *e.other_hours : none;
        return std::pair(own.profile, own.hours);
    };
    return key(a) == key(b) && hours(a) == hours(b) &&
           std::equal(a.days.begin(), a.days.end(), b.days.begin(), b.days.end(),
                      [](const Days& x, const Days& y) {
                          return x.first == y.first && x.last == y.last &&
                                 x.yearly == y.yearly;
                      });
}

bool changed_alike(const Effect& a, const Effect& b) {
    if (!a.other_hours || !b.other_hours) return false;
    for (std::size_t kind = 0; kind < a.other_hours->hours.size(); ++kind) {
        const auto &of_a = a.other_hours->hours[kind], &of_b = b.other_hours->hours[kind];
        const bool is_other = of_a != a.other_hours->declared[kind];
        if (is_other != (of_b != b.other_hours->declared[kind])) return false;
        if (is_other && of_a != of_b) return false;
    }
    return true;
}

bool adds_up(Hook hook) {
    return row_of(hook).adds_up;
}

bool leaves_loads(Hook hook) {
    return row_of(hook).leaves_loads;
}

bool is_use(Hook hook) {
    return row_of(hook).is_use;
}

bool follows_loads(Driver driver) {
    return driver == Driver::heating_load || driver == Driver::cooling_load;
}

bool is_at_a_meter(Hook hook) {
    return row_of(hook).is_at_a_meter;
}

const char* name_of(Hook hook) {
    return row_of(hook).name;
}

const char* name_of(Driver driver) {
    return row_of(driver).name;
}

const char* name_of(Form form) {
    return forms[static_cast<std::size_t>(form)];
}

const char* name_of(Gate gate) {
    return gates[static_cast<std::size_t>(gate)];
}

const char* unit_of(Hook hook) {
    return row_of(hook).unit;
}

const char* unit_of(Driver driver) {
    return row_of(driver).unit;
}

bool has_facades(const Effect& effect) {
    return effect.hook == Hook::aperture || follows_sun_on_facade(effect.driver);
}

bool has_threshold(const Effect& effect) {
    return effect.shape.form != Form::linear || row_of(effect.driver).has_number ||
           row_of(effect.hook).first_move > 0;
}

double first_move(const Effect& effect) {
    if (!has_threshold(effect)) return 0;
    const double of_hook = row_of(effect.hook).first_move;
    return of_hook > 0 ? of_hook : row_of(effect.driver).first_move;
}

}  // namespace bemcal::effects
