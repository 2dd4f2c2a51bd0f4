/// Reads [periods], and ranges of dates as meters write them: first and last day, both
/// included, or times. Training comes first.
/// Source: ISO 8601 dates, by `parse_time`.
/// Whether data cover a period is left to `read_weather` and `read_meters`.
#include "description/building_readers.hpp"
#include "description/result_names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::description {

/// [from, to); a last day without an hour is included.
study::Period read_range(const schema::Section& section, std::string_view key,
                         const std::string& from, const std::string& to) {
    return at_key(section, key, [&] {
        study::Period period{"", physics::parse_time(from), physics::parse_time(to)};
        if (to.size() <= 10) period.to += std::chrono::days(1);
        if (period.from >= period.to)
            throw std::invalid_argument(fmt::format(
                "{} is not before {}; expected the earlier one first", from, to));
        return period;
    });
}

study::Period read_slashed_range(const schema::Section& section, std::string_view key,
                                 const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string from = text.substr(0, slash);
    return read_range(section, key, from,
                      slash == std::string::npos ? from : text.substr(slash + 1));
}

std::vector<study::Period> read_periods(const Sources& sources) {
    if (!sources.has("periods")) sources.own.node("periods");
    const schema::Section section = sources.with("periods").table("periods", "periods");
    section.node("training");
    std::vector<study::Period> periods;
    section.attempt_each(section.root().entries, [&](const schema::Entry& entry) {
        const std::vector<std::string> days = section.texts(entry.key);
        if (days.size() != 2)
            section.fail(entry.key,
                         fmt::format("has {} entries; expected [first day, last day]",
                                     days.size()));
        periods.push_back(read_range(section, entry.key, days[0], days[1]));
        periods.back().name = entry.key;
        check_name(section, entry.key, Named::period, entry.key);
    });
    std::stable_partition(periods.begin(), periods.end(),
                          [](const auto& period) { return period.name == "training"; });
    return periods;
}

}  // namespace bemcal::description
