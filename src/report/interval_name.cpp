/// Tells from the begins of readings what they stand for: the middle distance, as a
/// period may cut the first interval and the last.
/// Follows from the calendar: months have 28 to 31 days.
/// Bills that are as long as months are called monthly.
#include "report/interval_name.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::report {
namespace {

constexpr double day_s = 86400;

struct Name {
    double below_s;
    const char* name;
};
constexpr Name names[] = {{1, "once"},
                          {3600, "steps"},
                          {7200, "hourly"},
                          {2 * day_s, "daily"},
                          {27.5 * day_s, "billed"},
                          {31.5 * day_s, "monthly"},
                          {300 * day_s, "billed"}};

}  // namespace

double usual_interval(const std::vector<double>& begins) {
    std::vector<double> distances;
    distances.reserve(begins.size());
    for (std::size_t k = 1; k < begins.size(); ++k)
        if (const double distance = begins[k] - begins[k - 1]; std::isfinite(distance))
            distances.push_back(distance);
    if (distances.empty()) return 0;
    const auto middle =
        distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

const char* interval_name(const std::vector<double>& begins) {
    const double seconds = usual_interval(begins);
    for (const Name& name : names)
        if (seconds < name.below_s) return name.name;
    return "annual";
}

bool is_by_month(const std::vector<double>& begins) {
    return begins.size() < 2 || usual_interval(begins) >= 2 * day_s;
}

}  // namespace bemcal::report
