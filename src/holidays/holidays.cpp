/// Turns the rows of a country into days: each by its rule, then the days off for those
/// on a weekend, in the order of the rows.
/// Source: the countries' laws, as far as the tables say.
/// A year's days are found from its rows and those of its neighbours, for a day off may
/// lie over New Year. Left out: half days, days of towns, working Saturdays made up for a
/// bridge.
#include "holidays/holidays.hpp"

#include "holidays/countries.hpp"
#include "holidays/dates.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::holidays {
namespace {

using std::chrono::days;

bool is_of_state(const Row& row, std::string_view state) {
    std::string_view list = row.states;
    if (list.empty()) return true;
    const bool all_but = list.front() == '!';
    if (all_but) list.remove_prefix(1);
    const auto words = words_of(list);
    return (std::ranges::find(words, state) != words.end()) != all_but;
}

/// The days of a year before anything is moved.
struct Natural {
    const Row* row;
    sys_days day;
};

void add_between(const Row& row, std::vector<Natural>& naturals) {
    std::set<sys_days> known;
    for (const Natural& natural : naturals) known.insert(natural.day);
    for (const sys_days before : known) {
        const sys_days day = before + days(1);
        if (!known.contains(day) && known.contains(day + days(1)) &&
            weekday_of(day) != sunday)
            naturals.push_back({&row, day});
    }
}

std::vector<Natural> naturals_of(const Country& country, std::string_view state,
                                 int year) {
    std::vector<Natural> naturals;
    for (const Row& row : country.rows) {
        if (!row.years.contains(year) || !is_of_state(row, state)) continue;
        if (row.rule.kind == RuleKind::between_holidays)
            add_between(row, naturals);
        else
            for (const sys_days day : days_of(row.rule, year))
                naturals.push_back({&row, day});
    }
    return naturals;
}

/// Gives each natural day its place, and its day off.
class Placing {
  public:
    explicit Placing(const std::vector<Natural>& naturals) {
        for (const Natural& natural : naturals) holidays_.insert(natural.day);
        for (const Natural& natural : naturals) place(natural);
    }
    std::vector<Holiday> placed;

  private:
    void place(const Natural& natural) {
        const Substitute& rule = natural.row->substitute;
        const bool is_taken = rule.when_taken && held_.contains(natural.day);
        int shift = shift_of(rule, natural.day);
        if (shift == 0 && is_taken) shift = 1;
        if (shift == 0 || !rule.moves) add(natural.day, natural.row->name, false);
        if (shift == 0) return;
        sys_days day = natural.day + days(shift);
        if (rule.to_free)
            while (!is_free(rule, day)) day += days(1);
        if (!held_.contains(day)) add(day, natural.row->name, true);
    }

    static int shift_of(const Substitute& rule, sys_days day) {
        return rule.shift[static_cast<std::size_t>(weekday_of(day))];
    }
    bool is_free(const Substitute& rule, sys_days day) const {
        return shift_of(rule, day) == 0 && !holidays_.contains(day);
    }
    void add(sys_days day, const char* name, bool is_substitute) {
        placed.push_back({day, name, is_substitute});
        held_.insert(day);
        holidays_.insert(day);
    }

    std::set<sys_days> holidays_;  ///< natural ones, and those that were placed
    std::set<sys_days> held_;      ///< those that were placed
};

const Country& known_country(const std::string& code) {
    const Country* country = find_country(code);
    if (country == nullptr)
        throw std::invalid_argument(fmt::format("'{}': expected a country, one of {}",
                                                code, fmt::join(country_codes, ", ")));
    return *country;
}

std::string known_state(const Country& country, const std::string& state) {
    if (state.empty()) return country.usual_state;
    const auto states = words_of(country.states);
    if (states.empty())
        throw std::invalid_argument(fmt::format(
            "'{}': {} is known as a whole only; leave it out", state, country.code));
    if (std::ranges::find(states, state) == states.end())
        throw std::invalid_argument(
            fmt::format("'{}': expected one of {}", state, fmt::join(states, ", ")));
    return state;
}

void check_year(const Country& country, int year) {
    if (year < country.first_year || year > country.last_year)
        throw std::invalid_argument(
            fmt::format("the days of {} are known from {} to {}, not of {}", country.code,
                        country.first_year, country.last_year, year));
}

}  // namespace

std::vector<Holiday> holidays_of(const std::string& country, const std::string& state,
                                 int year) {
    const Country& found = known_country(country);
    const std::string place = known_state(found, state);
    check_year(found, year);
    std::vector<Holiday> holidays;
    for (int y = year - 1; y <= year + 1; ++y)
        for (Holiday& holiday : Placing(naturals_of(found, place, y)).placed)
            if (year_of(holiday.date) == year) holidays.push_back(std::move(holiday));
    std::ranges::stable_sort(holidays, {}, &Holiday::date);
    return holidays;
}

}  // namespace bemcal::holidays
