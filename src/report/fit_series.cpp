#include "report/fit_series.hpp"

#include "physics/calendar.hpp"

#include <chrono>
#include <cmath>
#include <map>

namespace bemcal::report {
namespace {

/// The same number for all intervals of a day, or of a month.
long long number_of(Calendar span, double seconds_since_1970) {
    const auto seconds = static_cast<long long>(seconds_since_1970);
    if (span == Calendar::day) return seconds / 86400;
    const auto step =
        physics::calendar_step(physics::Seconds(std::chrono::seconds(seconds)));
    return 12LL * step.year + step.month;
}

}  // namespace

double shortest_interval(const FitSeries& series) {
    return series.begins.size() < 2 ? 0 : series.begins[1] - series.begins[0];
}

const char* interval_name(const FitSeries& series) {
    const double seconds = shortest_interval(series);
    return seconds <= 0           ? "once"
           : seconds < 3600       ? "steps"
           : seconds < 7200       ? "hourly"
           : seconds < 2 * 86400  ? "daily"
           : seconds < 40 * 86400 ? "monthly"
                                  : "annual";
}

stats::Resolution resolution_of(const FitSeries& series) {
    const double seconds = shortest_interval(series);
    return seconds > 0 && seconds < 27 * 86400 ? stats::Resolution::hourly
                                               : stats::Resolution::monthly;
}

stats::FitMetrics metrics_by(Calendar span, const FitSeries& series) {
    struct Sums {
        double simulated = 0, measured = 0, n = 0;
    };
    std::map<long long, Sums> spans;
    for (std::size_t k = 0; k < series.begins.size(); ++k) {
        if (std::isnan(series.measured[k])) continue;
        Sums& sums = spans[number_of(span, series.begins[k])];
        sums.simulated += series.simulated[k];
        sums.measured += series.measured[k];
        sums.n += 1;
    }
    std::vector<double> simulated, measured;
    for (const auto& [number, sums] : spans) {
        simulated.push_back(sums.simulated / (series.is_mean ? sums.n : 1));
        measured.push_back(sums.measured / (series.is_mean ? sums.n : 1));
    }
    return stats::metrics_of(simulated, measured);
}

}  // namespace bemcal::report
