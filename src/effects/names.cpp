/// Hooks, drivers, forms and gates in words and units, one table each in the order of the
/// enums; and whether two effects are the same.
/// Plain tables without a source: a new enumerator needs its row at the same place.
/// Sentences are left to sentence.cpp.
#include "effects/effect.hpp"

#include <algorithm>
#include <tuple>

namespace bemcal::effects {
namespace {

struct HookName {
    const char* name;
    const char* unit;
};

constexpr HookName hooks[] = {{"outdoor air", "K"},
                              {"supply air", "K"},
                              {"opaque boundary", "K"},
                              {"window boundary", "K"},
                              {"infiltration", "1/h"},
                              {"leakage", "-"},
                              {"ventilation", "-"},
                              {"venting", "1/h"},
                              {"opaque conductance", "-"},
                              {"window conductance", "-"},
                              {"neighbour", "W/(m2 K)"},
                              {"second mass", "W/(m2 K)"},
                              {"aperture", "-"},
                              {"heat recovery", "-"},
                              {"gains", "W/m2"},
                              {"loads", "-"},
                              {"lights and equipment", "W/m2"},
                              {"heating set-point", "K"},
                              {"cooling set-point", "K"},
                              {"heating available", "-"},
                              {"cooling available", "-"},
                              {"operation", "-"},
                              {"occupation", "-"},
                              {"plant operation", "-"},
                              {"heating efficiency", "-"},
                              {"cooling COP", "-"},
                              {"meter addition", "W/m2"},
                              {"meter factor", "-"}};

struct DriverName {
    const char* name;
    const char* unit;
};

constexpr DriverName drivers[] = {{"constant", ""},
                                  {"outdoor temperature", "K"},
                                  {"temperature difference", "K"},
                                  {"root of the temperature difference", "K^0.5"},
                                  {"sky temperature difference", "K"},
                                  {"wind", "m/s"},
                                  {"wind about its mean", ""},
                                  {"wind x temperature difference", "K m/s"},
                                  {"global sun", "W/m2"},
                                  {"sun on the facade", "W/m2"},
                                  {"outdoor moisture", "g/kg"},
                                  {"ground temperature", "K"},
                                  {"occupation", ""},
                                  {"hour of the day", "h"},
                                  {"weekend", ""},
                                  {"Saturday", ""},
                                  {"Sunday", ""},
                                  {"day of the year", "d"},
                                  {"time elapsed", "a"},
                                  {"brightness of the facade", "W/m2"},
                                  {"heating load", ""},
                                  {"cooling load", ""},
                                  {"another day's schedule", ""},
                                  {"shifted schedule", ""},
                                  {"constant temperature", ""},
                                  {"column", ""}};

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
                          e.gate, e.weekday, e.hours.from, e.hours.until, e.place,
                          e.column);
    };
    return key(a) == key(b) && std::equal(a.days.begin(), a.days.end(), b.days.begin(),
                                          b.days.end(), [](const Days& x, const Days& y) {
                                              return x.first == y.first &&
                                                     x.last == y.last &&
                                                     x.yearly == y.yearly;
                                          });
}

bool is_at_a_meter(Hook hook) {
    return hook == Hook::meter_factor || hook == Hook::meter_addition;
}

const char* name_of(Hook hook) {
    return hooks[static_cast<std::size_t>(hook)].name;
}

const char* name_of(Driver driver) {
    return drivers[static_cast<std::size_t>(driver)].name;
}

const char* name_of(Form form) {
    return forms[static_cast<std::size_t>(form)];
}

const char* name_of(Gate gate) {
    return gates[static_cast<std::size_t>(gate)];
}

const char* unit_of(Hook hook) {
    return hooks[static_cast<std::size_t>(hook)].unit;
}

const char* unit_of(Driver driver) {
    return drivers[static_cast<std::size_t>(driver)].unit;
}

}  // namespace bemcal::effects
