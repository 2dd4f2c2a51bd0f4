/// The words that tables of fits share.
/// Plain formatting; a month is any interval of two to forty days.
#include "report/fit_words.hpp"

#include "physics/calendar.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {

const char* interval_name(const std::vector<double>& begins) {
    constexpr double day = physics::day_s;
    const double seconds = begins.size() < 2 ? 0 : begins[1] - begins[0];
    return seconds <= 0         ? "once"
           : seconds < 3600     ? "steps"
           : seconds < 7200     ? "hourly"
           : seconds < 2 * day  ? "daily"
           : seconds < 40 * day ? "monthly"
                                : "annual";
}

std::string change(double before, double after) {
    const auto number = [](double share) {
        return std::isfinite(share) ? fmt::format("{:.1f}", 100 * share)
                                    : std::string("-");
    };
    return fmt::format("{:>6} -> {:>5}", number(before), number(after));
}

std::string verdict(bool before, bool after) {
    const auto word = [](bool is_met) { return is_met ? "yes" : "no"; };
    return fmt::format("{:>3} -> {}", word(before), word(after));
}

}  // namespace bemcal::report
