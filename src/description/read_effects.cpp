/// Reads [[effect]]: what a building does beyond its description, by a row of the
/// catalogue or by hook, driver, shape and gate, with its coefficient. Follows from
/// `effects`: its tables say which words there are, and whether an effect can enter. A
/// coefficient is fixed unless a [[parameter]] has the target "effect.NAME". Left out:
/// other hours than declared (a [[schedule]] says them) and what corrects readings
/// ([[meter]] does).
#include "base/units.hpp"
#include "description/building_readers.hpp"
#include "description/read_holidays.hpp"
#include "effects/catalogue.hpp"
#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "effects/job_section.hpp"
#include "effects/loads.hpp"
#include "effects/placement.hpp"
#include "effects/refinements.hpp"
#include "effects/steps.hpp"
#include "effects/variants.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using effects::DeclaredEffects;
using effects::Each;
using effects::Effect;
using effects::Entry;
using schema::Section;

/// The enumerator of a word, among the first `n`.
template <class Enum>
Enum enum_at(const Section& section, const char* key, std::size_t n) {
    std::vector<std::string> names;
    names.reserve(n);
    for (std::size_t k = 0; k < n; ++k)
        names.emplace_back(effects::name_of(static_cast<Enum>(k)));
    const std::string word = section.text(key);
    check_word(section, key, word, names, key);
    return static_cast<Enum>(std::ranges::find(names, word) - names.begin());
}

constexpr auto n_forms = static_cast<std::size_t>(effects::Form::lagged) + 1;
constexpr auto n_gates = static_cast<std::size_t>(effects::Gate::us_summer_time) + 1;

/// What kind of numbers a function's points need: knots, if any, and how many values.
functions::Points points_of(const Section& section, const std::string& driver,
                            std::size_t n_values) {
    functions::Points points{effects::points_of_driver(driver)};
    points.n_fortnights = n_values;
    const bool has_day = points.kind == functions::Points::Kind::hours_from;
    const bool has_knots = has_day || points.kind == functions::Points::Kind::knots ||
                           points.kind == functions::Points::Kind::hours_at_knots;
    if (!has_knots) {
        if (section.has("at"))
            section.fail("at",
                         fmt::format("has no place in a function of \"{}\"; expected "
                                     "values alone",
                                     driver));
        return points;
    }
    points.knots = section.numbers("at");
    if (has_day) {
        if (points.knots.size() != 1)
            section.fail("at",
                         fmt::format("expected one number: the years from the first day "
                                     "of training to the first day of \"{}\"",
                                     driver));
        return points;
    }
    if (points.knots.size() < 2 ||
        std::ranges::adjacent_find(points.knots, std::greater_equal<>()) !=
            points.knots.end())
        section.fail("at", "expected two numbers or more that rise, each once");
    return points;
}

effects::DriverFunction read_function(const Section& section) {
    effects::DriverFunction function;
    function.driver = section.text("driver");
    check_word(section, "driver", function.driver, effects::function_driver_names(),
               "driver of a function");
    function.values = section.numbers("values");
    if (function.values.empty()) section.fail("values", "is empty; expected numbers");
    function.points = points_of(section, function.driver, function.values.size());
    if (function.values.size() != function.points.size())
        section.fail(
            "values",
            fmt::format("has {} numbers; expected {}, one for each point of \"{}\"",
                        function.values.size(), function.points.size(), function.driver));
    section.number_if("spread", function.spread);
    if (function.is_sampled() && function.points.kind == functions::Points::Kind::one)
        section.fail(
            "spread",
            "has no place in a function of \"one\", which has no shape; expected "
            "a [[parameter]] with the effect as its target");
    return function;
}

/// An effect that follows the sum of functions, in the unit of its hook.
Effect of_functions(const Section& section, const Effect& given) {
    if (section.has("driver"))
        section.fail("driver",
                     "has no place beside [[effect.function]], which has its own; "
                     "expected one of the two");
    Effect effect = given;
    effect.driver = effects::Driver::column;
    effect.column = "functions of " + effect.name;  // no [[series]]
    effect.is_smooth = true;
    return effect;
}

/// What follows a load must not change it.
void check_leaves_loads(const Section& section, const Effect& effect) {
    if (effects::leaves_loads(effect.hook)) return;
    std::vector<std::string> hooks;
    for (const effects::HookRow& row : effects::hook_rows())
        if (row.leaves_loads) hooks.emplace_back(row.name);
    section.fail_value(
        "driver", fmt::format("cannot be followed at \"{}\", which changes the load "
                              "itself; expected a hook behind it, one of {}, or another "
                              "driver",
                              effects::name_of(effect.hook), fmt::join(hooks, ", ")));
}

/// Hook and driver of an effect that the catalogue does not have.
Effect of_grammar(const Section& section) {
    constexpr double any = 1e9;  ///< the hook's own limits hold
    Effect effect;
    effect.name = section.text("name");
    if (!section.has("hook"))
        section.fail_value(
            "name",
            "is no row of the catalogue (`bemcal-batch describe effects` prints "
            "it), and there is no hook; expected a row's name, or hook and driver");
    effect.hook = enum_at<effects::Hook>(section, "hook", effects::hook_rows().size());
    effect.least = -any;
    effect.most = any;
    if (section.has("function")) return of_functions(section, effect);
    effect.driver =
        enum_at<effects::Driver>(section, "driver", effects::driver_rows().size());
    if (effects::follows_loads(effect.driver)) check_leaves_loads(section, effect);
    return effect;
}

Effect of_catalogue(const Section& section, const Entry& row) {
    for (const char* key : {"hook", "driver", "function"})
        if (section.has(key))
            section.fail(key,
                         fmt::format("is that of the catalogue's row \"{}\" already; "
                                     "leave it out, or choose another name",
                                     row.effect.name));
    if (row.each == Each::data)
        section.fail_value("name",
                           "corrects readings and is no effect in the building; "
                           "expected a correction at the [[meter]] or [weather]");
    if (row.each == Each::found_hours)
        section.fail_value("name",
                           "is said by the hours of the [[schedule]] itself; "
                           "expected those to be changed");
    Effect effect = row.effect;
    if (row.each == Each::cooling_meter) effect.meter = physics::Quantity::cooling;
    return effect;
}

effects::Days days_of(const physics::DateRange& range) {
    const auto day = [](int year, int month, int of_month) {
        constexpr int leap_year = 2020;  ///< has each day of a year
        const std::chrono::sys_days date =
            std::chrono::year(year == 0 ? leap_year : year) /
            std::chrono::month(static_cast<unsigned>(month)) /
            std::chrono::day(static_cast<unsigned>(of_month));
        return static_cast<int>(date.time_since_epoch().count());
    };
    return {day(range.first_year, range.first_month, range.first_day),
            day(range.last_year, range.last_month, range.last_day),
            range.first_year == 0};
}

/// Numbers of a shape that would change nothing.
void check_shape(const Section& section, const Effect& effect) {
    const bool is_periodic = effect.driver == effects::Driver::hour ||
                             effect.driver == effects::Driver::day_of_year;
    const effects::Shape& shape = effect.shape;
    if (effect.driver == effects::Driver::one && shape.form != effects::Form::linear)
        section.fail("form", "has nothing to follow; expected a driver beside it");
    if (section.has("at") && !effects::has_threshold(effect))
        section.fail("at",
                     "is the threshold of a form, and there is none; expected form = "
                     "\"above\" or another, or no at");
    if (section.has("until") && shape.form != effects::Form::within)
        section.fail("until", "is of form = \"within\"; expected that form, or no until");
    if (shape.form == effects::Form::within && shape.at > shape.until && !is_periodic)
        section.fail("until",
                     fmt::format("is below at = {:g}; expected the smaller number first",
                                 shape.at));
}

void read_shape(const Section& section, physics::Seconds from, Effect& effect) {
    if (section.has("form"))
        effect.shape.form = enum_at<effects::Form>(section, "form", n_forms);
    section.number_if("at", effect.shape.at);
    section.number_if("until", effect.shape.until);
    if (!section.has("since")) return;
    if (effect.driver != effects::Driver::elapsed)
        section.fail(
            "since",
            fmt::format("is the day of a step, but \"{}\" follows {}; expected driver "
                        "= \"time elapsed\", or no since",
                        effect.name, name_of(effect.driver)));
    const physics::Seconds since = at_key(
        section, "since", [&] { return physics::parse_time(section.text("since")); });
    effect.shape.form = effects::Form::over;
    // A step begins with the hour of that time.
    effect.shape.at =
        (static_cast<double>((since - from).count()) - 1) / effects::elapsed_year_s;
}

/// The load that counts as 1.
void read_full_load(const Section& section, Effect& effect) {
    const bool follows = effects::follows_loads(effect.driver);
    if (follows && !section.has("full_load"))
        section.fail("full_load",
                     fmt::format("is missing; \"{}\" follows the {} as a share of this: "
                                 "expected the plant's full load in kW",
                                 effect.name, name_of(effect.driver)));
    if (!follows && section.has("full_load") && section.has("function"))
        section.fail("full_load",
                     "has no place beside [[effect.function]], whose `at` is in kW; "
                     "leave it out");
    if (!follows && section.has("full_load"))
        section.fail("full_load",
                     fmt::format("is of the heating load or the cooling load, but \"{}\" "
                                 "follows {}; leave it out",
                                 effect.name, name_of(effect.driver)));
    if (follows) effect.full_load = section.number("full_load") * W_per_kW;
}

void read_gate(const Section& section, Effect& effect) {
    constexpr const auto& weekdays = effects::weekday_keys;
    if (section.has("gate"))
        effect.gate = enum_at<effects::Gate>(section, "gate", n_gates);
    if (section.has("days")) {
        effect.gate = effects::Gate::on_days;
        effect.days.clear();
        for (const physics::DateRange& range : read_dates(section, "days"))
            effect.days.push_back(days_of(range));
    }
    if (effect.gate == effects::Gate::on_days && effect.days.empty())
        section.fail("days",
                     "is missing; expected the days on which the effect acts, "
                     "[\"2021-05-03\", \"12-24/01-02\"]");
    if (section.has("weekday")) {
        const std::string day = section.text("weekday");
        check_word(section, "weekday", day, {std::begin(weekdays), std::end(weekdays)},
                   "day of the week");
        effect.weekday =
            static_cast<int>(std::ranges::find(weekdays, day) - std::begin(weekdays));
    }
    if (section.has("hours")) {
        const std::vector<double> hours = section.numbers("hours");
        if (hours.size() != 2)
            section.fail("hours", "expected two numbers, from and until: [22, 6]");
        effect.hours = {hours[0], hours[1]};
    }
}

void read_place(const Section& section, const effects::Surroundings& around,
                Effect& effect) {
    if (section.has("meter") && !is_at_a_meter(effect.hook))
        section.fail("meter",
                     fmt::format("has no place at the hook \"{}\", which is of the "
                                 "whole building; leave it out",
                                 effects::name_of(effect.hook)));
    if (section.has("facade") && !effects::has_facades(effect))
        section.fail(
            "facade",
            "is of what acts on windows or follows the sun on them; leave it out");
    if (section.has("meter")) {
        const auto meter = section.choice_as<physics::Quantity>("meter");
        effect = effects::variants(effect, Each::meter, around, {&meter, 1}).at(0);
    }
    if (is_at_a_meter(effect.hook) && !effect.meter)
        section.fail("meter",
                     "is missing; expected the meter at which the effect enters");
    if (!section.has("facade")) return;
    const std::string facade = section.text("facade");
    std::vector<std::string> names;
    for (const Effect& one : effects::variants(effect, Each::facade, around, {})) {
        if (!one.facade) continue;
        names.push_back(effects::facade_key(one));
        if (names.back() != facade) continue;
        effect.facade = one.facade;
        effect.place_name = one.place_name;
    }
    if (names.empty())
        section.fail("facade",
                     "the building has windows on one facade only; leave it out");
    check_word(section, "facade", facade, names, "facade with windows");
}

void read_column(const Section& section, const study::Case& building, Effect& effect) {
    if (effect.driver != effects::Driver::column || section.has("function")) return;
    effect.column = section.text("series");
    check_word(section, "series", effect.column, names_of(building.columns),
               "[[series]]");
}

/// Of a function's spread, or of a step's day.
void check_sampled(const Section& section, const char* key, const Effect& effect) {
    if (!effects::adds_up(effect.hook))
        section.fail(key,
                     fmt::format("has no place at the hook \"{}\", where effects do not "
                                 "add up; leave it out",
                                 effects::name_of(effect.hook)));
}

/// Nothing of an effect without functions.
std::optional<DeclaredEffects::Functions> read_functions(const Section& section,
                                                         const Effect& effect) {
    if (!section.has("function")) return std::nullopt;
    DeclaredEffects::Functions all{effect.hook, effect.column, {}};
    for (const Section& each : section.tables("function", "effect.function")) {
        effects::DriverFunction function = read_function(each);
        if (effects::follows_loads(function.driver)) check_leaves_loads(each, effect);
        if (std::ranges::find(all.functions, function.driver,
                              &effects::DriverFunction::driver) != all.functions.end())
            each.fail_value("driver",
                            "another function of this effect follows it; expected their "
                            "sum as one");
        if (function.is_sampled()) check_sampled(each, "spread", effect);
        if (function.is_sampled() && section.number("coefficient") != 1)
            section.fail_value("coefficient",
                               "expected 1 beside a function with spread, whose values "
                               "have the hook's unit");
        all.functions.push_back(std::move(function));
    }
    return all;
}

Effect read_effect(const Section& section, const study::Case& building,
                   const effects::Surroundings& around) {
    const std::string name = section.text("name");
    if (name.find('.') != std::string::npos)
        section.fail_value("name",
                           "has a dot, which parts the words of a parameter's "
                           "target; expected a name without");
    const Entry* row = effects::entry_named(name);
    Effect effect = row != nullptr ? of_catalogue(section, *row) : of_grammar(section);
    read_shape(section, around.from, effect);
    if (row == nullptr) check_shape(section, effect);
    read_full_load(section, effect);
    read_gate(section, effect);
    read_place(section, around, effect);
    read_column(section, building, effect);
    return effect;
}

void check_twice(const Section& section, const std::vector<Effect>& before,
                 const Effect& effect) {
    for (const Effect& other : before) {
        if (other.name == effect.name)
            section.fail_value("name", "another effect has this name");
        if (are_equal(other, effect) && other.full_load == effect.full_load)
            section.fail("name",
                         fmt::format("enters as \"{}\" does: the same hook, "
                                     "driver, shape and gate; expected one of them",
                                     other.name));
    }
}

/// It can enter in every period, and has a say in one.
/// \param may_be_idle  of what is sampled, and of what follows loads, not known yet
void check_entering(const Section& section, const Effect& effect,
                    const std::vector<effects::Surroundings>& periods, bool may_be_idle) {
    const std::string no_say = "it has no say";
    std::string why;
    for (const effects::Surroundings& around : periods) {
        const auto objection = effects::objection(effect, around);
        if (!objection) return;
        why = *objection;
        if (may_be_idle && why.starts_with(no_say)) return;
        if (!why.starts_with(no_say)) break;
    }
    section.fail(
        "name",
        fmt::format("\"{}\" cannot enter this building: {}", effect.name,
                    why.starts_with(no_say) ? "it has no say in any period" : why));
}

DeclaredEffects nothing_declared(const study::Case& building) {
    DeclaredEffects declared;
    declared.building = building.building;
    declared.first_row = building.profiles.size();
    declared.from = building.periods.at(0).from;
    declared.clock = effects::wall_clock_of(building.profiles, building.weather.site);
    for (const study::Column& column : building.columns) {
        const auto profile =
            std::ranges::find(building.profiles, column.name, &physics::Profile::name);
        declared.columns.push_back(
            {column.name, static_cast<std::size_t>(profile - building.profiles.begin())});
    }
    return declared;
}

void check_coefficient(const Section& section, const physics::Coefficient& effect,
                       double value) {
    if (value >= effect.least && value <= effect.most) return;
    section.fail_value(
        "coefficient",
        fmt::format("expected {:g} to {:g} {}", effect.least, effect.most, effect.unit));
}

/// Into the case: its building gets them, its profiles their rows. Each period's drive
/// must take them.
void enter(const Section& section, const char* key, DeclaredEffects declared,
           std::vector<physics::Drive>& drives, study::Case& building) {
    at_key(section, key, [&] {
        building.building =
            building_with(declared, drives[0], building.weather, declared.n_rows);
        for (physics::Drive& drive : drives) {
            drive.profiles.rows += declared.n_rows;
            drive.profiles.values.resize(drive.profiles.rows * drive.profiles.cols);
            write_profiles(declared, effects::no_loads(drive), building.weather, drive);
        }
    });
    building.profiles.insert(building.profiles.end(), declared.n_rows,
                             effects::empty_row(building.weather));
    building.declared_effects =
        std::make_shared<const DeclaredEffects>(std::move(declared));
}

/// Effects of the structure that no section has, at the middle of their priors.
void declare_structure(const std::vector<Section>& sections, const study::Case& building,
                       DeclaredEffects& declared) {
    for (const std::size_t index : building.structure)
        for (const auto& always : effects::refinements()[index].effects) {
            const auto is_its = [&](const Section& section) {
                return section.text("name") == always.effect.name;
            };
            if (std::ranges::any_of(sections, is_its)) continue;
            declared.effects.push_back(always.effect);
            declared.coefficients.push_back(always.mean);
        }
}

/// What effects follow in each of the case's periods, of which the drives are the first;
/// of loads nothing, until there are parameters' values.
std::vector<effects::Surroundings> surroundings_in(
    const DeclaredEffects& declared, const study::Case& building,
    const std::vector<physics::Drive>& drives) {
    std::vector<effects::Surroundings> periods;
    periods.reserve(drives.size());
    for (const physics::Drive& drive : drives)
        periods.push_back(surroundings_of(declared, drive, building.weather));
    return periods;
}

/// Of a step's day; 0 where it is known.
int read_days_within(const Section& section, const Effect& effect) {
    if (!section.has("since_within")) return 0;
    check_sampled(section, "since_within", effect);
    if (!section.has("since"))
        section.fail("since_within",
                     "is about the day of `since`, which is missing; expected both");
    return static_cast<int>(section.integer("since_within"));
}

bool follow_loads(const Effect& effect,
                  const std::optional<DeclaredEffects::Functions>& functions) {
    return effects::follows_loads(effect.driver) ||
           (functions && functions->follow_loads());
}

void declare(const Section& section, const study::Case& building,
             std::vector<effects::Surroundings>& periods, DeclaredEffects& declared) {
    Effect effect = read_effect(section, building, periods[0]);
    check_twice(section, declared.effects, effect);
    const auto functions = read_functions(section, effect);
    if (functions) {
        at_key(section, "function", [&] {
            for (effects::Surroundings& around : periods)
                add_columns({*functions}, around);
        });
        declared.functions.push_back(*functions);
    }
    check_entering(
        section, effect, periods,
        (functions && functions->are_sampled()) || follow_loads(effect, functions));
    if (const int within = read_days_within(section, effect); within > 0)
        declared.days.push_back({declared.effects.size(), within});
    declared.effects.push_back(std::move(effect));
    declared.coefficients.push_back(section.number("coefficient"));
}

/// Sections come behind effects of the structure, which follow no load.
const Section& first_of_loads(const std::vector<Section>& sections,
                              const DeclaredEffects& declared) {
    const auto follows = [&](const Section& section) {
        const auto effect =
            std::ranges::find(declared.effects, section.text("name"), &Effect::name);
        return effects::follows_loads(effect->driver) ||
               std::ranges::any_of(declared.functions, [&](const auto& one) {
                   return one.column == effect->column && one.follow_loads();
               });
    };
    return *std::ranges::find_if(sections, follows);
}

}  // namespace

void read_effects(const Sources& sources, study::Case& building) {
    const std::vector<Section> sections =
        sources.with("effect").tables("effect", "effect");
    if (sections.empty() && building.structure.empty()) return;
    DeclaredEffects declared = nothing_declared(building);
    declare_structure(sections, building, declared);
    if (sections.empty() && declared.effects.empty()) return;
    const std::size_t n_of_structure = declared.effects.size();
    const Section& first = sections.empty() ? sources.with("structure") : sections[0];
    const char* key = sections.empty() ? "structure" : "name";
    std::vector<physics::Drive> drives;
    drives.reserve(building.periods.size());
    for (const study::Period& period : building.periods)
        drives.push_back(at_key(first, key, [&] { return drive_of(building, period); }));
    auto periods = surroundings_in(declared, building, drives);
    sources.own.attempt_each(sections, [&](const Section& section) {
        declare(section, building, periods, declared);
    });
    enter(sections.empty() ? first : sections.back(), key, std::move(declared), drives,
          building);
    for (std::size_t k = 0; k < sections.size(); ++k)
        check_coefficient(sections[k], building.building.effects[n_of_structure + k],
                          building.declared_effects->coefficients[n_of_structure + k]);
}

void check_loads(const Sources& sources, const study::Case& building) {
    if (!building.declared_effects || !building.declared_effects->follow_loads()) return;
    try {
        for (const study::Period& period : building.periods) drive_of(building, period);
    } catch (const CannotSimulate& error) {
        const auto sections = sources.with("effect").tables("effect", "effect");
        first_of_loads(sections, *building.declared_effects)
            .fail_value("name",
                        fmt::format("follows a load of the nominal building, which "
                                    "cannot be simulated: {}; expected values of its "
                                    "parameters with which it can",
                                    error.what()));
    }
}

}  // namespace bemcal::description
