/// Writes periods as days.
/// Follows from `[periods]`, whose rows these are.
/// Periods that begin within a day are left out: hours would then be missing.
#include "external/periods_file.hpp"

#include "physics/calendar.hpp"

#include <fmt/format.h>

namespace bemcal::external {

std::string text_of_periods(std::span<const study::Period> periods) {
    std::string text = "period,first,last\n";
    for (const study::Period& period : periods)
        text += fmt::format("{},{},{}\n", period.name, physics::format_date(period.from),
                            physics::format_date(period.to - std::chrono::seconds(1)));
    return text;
}

}  // namespace bemcal::external
