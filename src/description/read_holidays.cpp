/// Reads the days off: holidays = [...], or a section [holidays] with country, state,
/// days and school holidays. Follows from the calendars in holidays/. What a day off does
/// is said by the schedules. School holidays are checked and kept; no schedule follows
/// them.
#include "description/read_holidays.hpp"

#include "description/words.hpp"
#include "holidays/countries.hpp"
#include "holidays/holidays.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::description {
namespace {

physics::DateRange single_day(std::chrono::sys_days date) {
    const physics::CalendarStep day = physics::calendar_step(date);
    return {day.year, day.month, day.day, day.year, day.month, day.day};
}

void check_state(const schema::Section& section, const holidays::Country& country) {
    if (!section.has("state")) return;
    const auto words = holidays::words_of(country.states);
    if (words.empty())
        section.fail_value("state", fmt::format("{} has one calendar for all its states; "
                                                "remove it",
                                                country.name));
    check_word(section, "state", section.text("state"), {words.begin(), words.end()},
               fmt::format("state of {} with a calendar", country.name));
}

/// The years of the periods must be known, those around them may be.
void check_years(const schema::Section& section, const holidays::Country& country,
                 const study::YearSpan& years) {
    if (years.first < country.first_year || years.last > country.last_year)
        section.fail_value(
            "country",
            fmt::format("its days are known from {} to {}, and the periods are of {} to "
                        "{}; expected the days themselves, under days",
                        country.first_year, country.last_year, years.first, years.last));
}

void add_country(const schema::Section& section,
                 const std::vector<study::Period>& periods,
                 std::vector<physics::DateRange>& days) {
    const std::string code = section.choice("country");
    const holidays::Country& country = *holidays::find_country(code);
    check_state(section, country);
    if (periods.empty()) throw schema::Follows();  // their years are not known
    const study::YearSpan years = study::years_of(periods);
    check_years(section, country, years);
    const int first = std::max(years.first - 1, country.first_year);
    const int last = std::min(years.last + 1, country.last_year);
    for (int year = first; year <= last; ++year)
        for (const holidays::Holiday& holiday :
             holidays::holidays_of(code, section.text("state"), year))
            days.push_back(single_day(holiday.date));
}

}  // namespace

std::vector<physics::DateRange> read_dates(const schema::Section& section,
                                           const char* key) {
    std::vector<physics::DateRange> ranges;
    section.attempt_each(section.texts(key), [&](const std::string& text) {
        ranges.push_back(
            at_key(section, key, [&] { return physics::parse_date_range(text); }));
    });
    return ranges;
}

DaysOff read_days_off(const Sources& sources, const std::vector<study::Period>& periods) {
    const schema::Section& root = sources.with("holidays");
    if (!root.has("holidays") || root.node("holidays").kind != schema::Node::Kind::table)
        return {read_dates(root, "holidays"), {}};
    const schema::Section section = root.table("holidays", "holidays");
    DaysOff days;
    section.attempt_all(
        [&] { days.holidays = read_dates(section, "days"); },
        [&] { days.school = read_dates(section, "school"); },
        [&] {
            if (section.has("country"))
                add_country(section, periods, days.holidays);
            else
                section.refuse({"state"}, "has no effect without country; add country");
        });
    return days;
}

}  // namespace bemcal::description
