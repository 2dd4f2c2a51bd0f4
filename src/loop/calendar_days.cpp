/// Compares every country's and state's public holidays with the days that look like
/// Sundays: a day's share of a Sunday is normal about 1 if the building was closed, and
/// about the ordinary days' middle if it was open.
/// Source: Bayes' rule. A closed day of a calendar need not be picked among all days of a
/// year; which share of its holidays a house keeps is unknown (uniform beforehand).
/// Holidays on the same date in every year speak for a calendar, but only those that move
/// make one: the others are foretold as well one by one.
/// Leaves out half days, and days off that follow no calendar.
#include "loop/calendar_days.hpp"

#include "holidays/countries.hpp"
#include "holidays/holidays.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace bemcal::loop {
namespace {

/// What a holiday explains that else were one day of a year [log of odds].
const double odds_of_a_day = std::log(decisions::days_to_pick_from);
/// Of a state's calendar against its country's: a house may add a day of its own, so only
/// a second one speaks for a state.
const double odds_of_state = -decisions::picks_of_state * odds_of_a_day;

const double least_odds = std::log(decisions::least_odds_of_calendar);

struct Region {
    std::string country, state;
    std::string name() const { return state.empty() ? country : country + "-" + state; }
};

std::vector<Region> all_regions() {
    std::vector<Region> regions;
    for (const holidays::Country& country : holidays::countries()) {
        regions.push_back({country.code, ""});
        for (const auto state : holidays::words_of(country.states))
            regions.push_back({country.code, std::string(state)});
    }
    return regions;
}

double log_normal(double x, double mean, double sd) {
    const double z = (x - mean) / sd;
    return -z * z / 2 - std::log(sd);
}

/// Log of the odds that the day was closed against open; 0 where it would not show.
double log_odds(const DayShares& days, int day) {
    const auto found = days.shares.find(day);
    if (found == days.shares.end()) return 0;
    return log_normal(found->second, 1,
                      std::hypot(decisions::closed_spread, days.spread)) -
           log_normal(found->second, days.middle, days.spread);
}

/// Not by the odds: what a closed day leaves in the next is far from an open one, too.
bool is_closed(const DayShares& days, int day) {
    const auto found = days.shares.find(day);
    return found != days.shares.end() && found->second >= decisions::least_closed_share;
}

/// The day on which a holiday was kept: its own; or, where that one was open, the one
/// before or after if it alone was closed and is no holiday itself.
int kept_on(const DayShares& days, int day, const std::set<int>& holidays) {
    if (!days.shares.contains(day) || is_closed(days, day)) return day;
    for (const int by : {-1, 1})
        if (is_closed(days, day + by) && !is_closed(days, day + 2 * by) &&
            !holidays.contains(day + by))
            return day + by;
    return day;
}

/// Of holidays whose days would show: how many there are, and were kept.
struct Count {
    double shown = 0, kept = 0, moved = 0;

    /// Log of the odds that they are a calendar's against days picked one by one.
    double odds() const {
        return kept * odds_of_a_day - moved * decisions::odds_of_own_day +
               std::lgamma(kept + 1) + std::lgamma(shown - kept + 1) -
               std::lgamma(shown + 2);
    }
    /// Whether a holiday is rather kept of which nothing is known (Laplace's rule).
    bool is_usual() const { return kept + 1 > (shown + 2) / 2; }
};

struct Holiday {
    std::vector<std::pair<int, int>> days;  ///< own and kept, of all years
    bool moves = false;                     ///< between the dates of two years
    double odds = 0;                        ///< of all its days, closed against open
    bool shows = false;
};

/// By name. Days off for those that fall on a weekend are kept, or not, by themselves.
using Holidays = std::map<std::pair<std::string, bool>, Holiday>;

int number_of(std::chrono::sys_days day) {
    return static_cast<int>(day.time_since_epoch().count());
}

auto month_and_day(int day) {
    const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(day))};
    return std::pair(date.month(), date.day());
}

void add_day(const DayShares& days, int own, int kept, Holiday& holiday) {
    if (!holiday.days.empty() &&
        month_and_day(own) != month_and_day(holiday.days.front().first))
        holiday.moves = true;
    holiday.days.emplace_back(own, kept);
    holiday.odds += log_odds(days, kept);
    holiday.shows = holiday.shows || days.shares.contains(kept);
}

/// The calendar's days of the years, of two at least to see which of them move. Empty
/// where its tables do not reach them.
std::vector<holidays::Holiday> days_of(const Region& region, int first_year,
                                       int last_year) {
    std::vector<holidays::Holiday> all;
    try {
        for (int year = first_year; year <= std::max(last_year, first_year + 1); ++year)
            std::ranges::copy(holidays::holidays_of(region.country, region.state, year),
                              std::back_inserter(all));
    } catch (const std::invalid_argument&) {
        return {};
    }
    return all;
}

Holidays by_name(const std::vector<holidays::Holiday>& all, const DayShares& days) {
    std::set<int> numbers;
    for (const auto& day : all) numbers.insert(number_of(day.date));
    Holidays by_name;
    for (const auto& day : all) {
        const int own = number_of(day.date);
        add_day(days, own, kept_on(days, own, numbers),
                by_name[{day.name, day.is_substitute}]);
    }
    return by_name;
}

Count count_of(const Holidays& holidays, bool only_those_that_move) {
    Count count;
    for (const auto& [name, holiday] : holidays) {
        const bool moves = holiday.moves && !name.second;
        if (!holiday.shows || (only_those_that_move && !moves)) continue;
        const bool is_kept = holiday.odds > 0;
        count.shown += 1;
        count.kept += is_kept;
        count.moved += is_kept && std::ranges::any_of(holiday.days, [](const auto& day) {
                           return day.first != day.second;
                       });
    }
    return count;
}

/// Without holidays on which the building was rather open.
std::vector<effects::Days> kept_days(const Holidays& holidays) {
    const bool is_usual = count_of(holidays, false).is_usual();
    std::vector<effects::Days> kept;
    for (const auto& [name, holiday] : holidays)
        if (holiday.shows ? holiday.odds > 0 : is_usual)
            for (const auto& [own, day] : holiday.days)
                kept.push_back({day, day, false, true});
    std::ranges::sort(kept, {}, &effects::Days::first);
    const auto twice = std::ranges::unique(kept, {}, &effects::Days::first);
    kept.erase(twice.begin(), twice.end());
    return kept;
}

}  // namespace

bool KeptCalendar::holds(int day) const {
    return std::ranges::any_of(days, [&](const auto& kept) { return kept.first == day; });
}

std::optional<KeptCalendar> kept_calendar(const DayShares& days, int first_year,
                                          int last_year) {
    const std::vector<Region> regions = all_regions();
    const double odds_of_one = -std::log(static_cast<double>(regions.size()));
    std::optional<KeptCalendar> best;
    double most = 0;
    for (const Region& region : regions) {
        const Holidays holidays = by_name(days_of(region, first_year, last_year), days);
        const double prior = odds_of_one + (region.state.empty() ? 0 : odds_of_state);
        const double odds = prior + count_of(holidays, false).odds();
        if (odds <= most || odds_of_one + count_of(holidays, true).odds() <= least_odds)
            continue;
        best = KeptCalendar{region.name(), kept_days(holidays)};
        most = odds;
    }
    return best;
}

}  // namespace bemcal::loop
