/// Compares every country's and state's public holidays with the days that look like
/// Sundays: a day's share of a Sunday is normal about 1 if the building was closed, and
/// about the ordinary days' middle if it was open.
/// Source: Bayes' rule, each calendar being as likely as any other beforehand.
/// Leaves out half days, and days off that follow no calendar.
#include "loop/calendar_days.hpp"

#include "holidays/countries.hpp"
#include "holidays/holidays.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace bemcal::loop {
namespace {

/// How far a closed day's share lies from a Sunday's: closed days keep some use.
constexpr double closed_spread = 0.25;
/// What one day may say for or against a calendar [log of odds]: a day of illness or of
/// failing plant decides nothing alone.
constexpr double most_of_a_day = 10;

/// Of a holiday's own day against the one before or after it [log of odds]: a house that
/// moves a holiday moves it by a day, in one year of twenty.
constexpr double odds_of_own_day = 3.0;

/// Of a state's calendar against its country's [log of odds]: a house may add a day
/// of its own, so only a second one speaks for the state.
constexpr double odds_of_state = -most_of_a_day;

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
    const double of_closed =
        log_normal(found->second, 1, std::hypot(closed_spread, days.spread));
    const double of_open = log_normal(found->second, days.middle, days.spread);
    return std::clamp(of_closed - of_open, -most_of_a_day, most_of_a_day);
}

/// The day on which a holiday was kept: its own, or the one before or after where that
/// one looks closed and its own does not.
int kept_on(const DayShares& days, int day) {
    int kept = day;
    double best = std::max(log_odds(days, day) + odds_of_own_day, 0.0);
    for (const int other : {day - 1, day + 1})
        if (const double odds = log_odds(days, other); odds > best)
            kept = other, best = odds;
    return kept;
}

struct KeptHoliday {
    int day;  ///< on which it was kept
    /// Days off for those that fall on a weekend are kept, or not, by themselves.
    std::pair<std::string, bool> name_and_whether_substitute;
};

struct Candidate {
    Region region;
    std::vector<KeptHoliday> holidays;
    double odds = 0;  ///< of all, against days that are all open
};

int number_of(std::chrono::sys_days day) {
    return static_cast<int>(day.time_since_epoch().count());
}

/// None where the calendar's tables do not reach these years.
std::optional<Candidate> candidate_of(const Region& region, const DayShares& days,
                                      int first_year, int last_year) {
    Candidate candidate{region, {}, region.state.empty() ? 0 : odds_of_state};
    std::map<int, double> odds;  // two holidays may share a day
    try {
        for (int year = first_year; year <= last_year; ++year)
            for (const auto& holiday :
                 holidays::holidays_of(region.country, region.state, year)) {
                const int own = number_of(holiday.date), day = kept_on(days, own);
                candidate.holidays.push_back(
                    {day, {holiday.name, holiday.is_substitute}});
                odds[day] = log_odds(days, day) - (day == own ? 0 : odds_of_own_day);
            }
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
    for (const auto& [day, of_day] : odds) candidate.odds += of_day;
    return candidate;
}

/// Without holidays on which the building was rather open.
std::vector<effects::Days> kept_days(const Candidate& candidate, const DayShares& days) {
    std::map<std::pair<std::string, bool>, double> odds;
    for (const auto& [day, name] : candidate.holidays) odds[name] += log_odds(days, day);
    std::vector<effects::Days> kept;
    for (const auto& [day, name] : candidate.holidays)
        if (odds[name] >= 0 && (kept.empty() || kept.back().first != day))
            kept.push_back({day, day, false, true});
    return kept;
}

}  // namespace

bool KeptCalendar::holds(int day) const {
    return std::ranges::any_of(days, [&](const auto& kept) { return kept.first == day; });
}

std::optional<KeptCalendar> kept_calendar(const DayShares& days, int first_year,
                                          int last_year) {
    std::optional<Candidate> best;
    const std::vector<Region> regions = all_regions();
    for (const Region& region : regions) {
        auto candidate = candidate_of(region, days, first_year, last_year);
        if (candidate && (!best || candidate->odds > best->odds))
            best = std::move(candidate);
    }
    if (!best || best->odds <= std::log(static_cast<double>(regions.size())))
        return std::nullopt;
    return KeptCalendar{best->region.name(), kept_days(*best, days)};
}

}  // namespace bemcal::loop
