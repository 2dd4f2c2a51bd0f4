/// Prints the holidays of a place, and the countries that are known.
/// Follows from `holidays_of` and the tables alone.
/// Left out: where a day comes from; the tables say it.
#include "holidays/countries.hpp"
#include "holidays/dates.hpp"
#include "holidays/holidays.hpp"
#include "physics/calendar.hpp"

#include <charconv>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::holidays {
namespace {

int parsed_year(std::string_view text, const std::string& whole) {
    int year = 0;
    const auto [at, error] =
        std::from_chars(text.data(), text.data() + text.size(), year);
    if (error != std::errc() || at != text.data() + text.size() || text.size() != 4)
        throw std::invalid_argument(
            fmt::format("years '{}': expected them as 2021 or 2020-2022", whole));
    return year;
}

std::pair<int, int> parsed_years(const std::string& text) {
    const std::string_view view = text;
    const std::size_t dash = view.find('-');
    const int first = parsed_year(view.substr(0, dash), text);
    if (dash == std::string_view::npos) return {first, first};
    return {first, parsed_year(view.substr(dash + 1), text)};
}

std::string line_of(const Holiday& holiday) {
    constexpr const char* names[] = {"Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"};
    return fmt::format("{} {}  {}{}\n", physics::format_date(holiday.date),
                       names[weekday_of(holiday.date)], holiday.name,
                       holiday.is_substitute ? " (day off for it)" : "");
}

}  // namespace

std::string describe(const std::string& place, const std::string& years) {
    const std::size_t dash = place.find('-');
    const std::string state =
        dash == std::string::npos ? std::string() : place.substr(dash + 1);
    const auto [first, last] = parsed_years(years);
    std::string text;
    for (int year = first; year <= last; ++year)
        for (const Holiday& holiday : holidays_of(place.substr(0, dash), state, year))
            text += line_of(holiday);
    return text;
}

std::string describe_countries() {
    std::string text =
        "Countries with a calendar of public holidays; `describe holidays DE-BY 2021` "
        "prints one.\n\n";
    for (const Country& country : countries()) {
        text += fmt::format("  {}  {}", country.code, country.name);
        if (*country.states != '\0') text += fmt::format(": {}", country.states);
        if (*country.usual_state != '\0')
            text += fmt::format("; without one: {}", country.usual_state);
        text += "\n";
    }
    return text;
}

}  // namespace bemcal::holidays
