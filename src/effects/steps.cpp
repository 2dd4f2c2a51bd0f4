/// Series over the steps of a drive, by calendar, clock and declared loads.
/// Plain bookkeeping, our own. People are known by the load's name.
/// What follows the weather is left to drivers.
#include "effects/steps.hpp"

#include "base/lower_case.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace bemcal::effects {
namespace {

using Series = std::vector<double>;

Series over_largest(const Series& series) {
    if (series.empty()) return {};
    return over(series, *std::max_element(series.begin(), series.end()));
}

bool is_people(const physics::Load& load) {
    const std::string name = lower_case(load.name);
    return name.find("people") != std::string::npos ||
           name.find("occup") != std::string::npos;
}

template <class Counts>
Series density_of(const Surroundings& around, Counts counts) {
    Series density(static_cast<std::size_t>(around.drive->n_steps()));
    for (const physics::Zone& zone : around.building->zones)
        for (const physics::Load& load : zone.loads) {
            if (!counts(load)) continue;
            for (std::size_t k = 0; k < density.size(); ++k)
                density[k] +=
                    zone.floor_area * around.drive->at(load.density, static_cast<int>(k));
        }
    return density;
}

/// Share of [begin, end) that lies in [from, until).
double overlap(double begin, double end, const Hours& hours) {
    if (hours.from > hours.until)
        return 1 - overlap(begin, end, {hours.until, hours.from});
    const double common = std::min(end, hours.until) - std::max(begin, hours.from);
    return std::max(common, 0.0) / (end - begin);
}

}  // namespace

double clock_of(const Surroundings& around, std::size_t step) {
    const auto begin = around.drive->axis.begin_of(static_cast<int>(step));
    const auto day = std::chrono::floor<std::chrono::days>(begin);
    return static_cast<double>((begin - day).count()) / 3600;
}

Series weekdays(const Surroundings& around, int first, int last) {
    return each_step(around, [&](std::size_t k) {
        const int weekday = around.calendar[k].weekday;
        return first <= weekday && weekday <= last ? 1.0 : 0.0;
    });
}

Series shares_of(const Hours& hours, const Surroundings& around) {
    const int step_s = around.drive->axis.step_s;
    const auto per_day = static_cast<std::size_t>(physics::day_s / step_s);
    Series shares(static_cast<std::size_t>(around.drive->n_steps()));
    for (std::size_t k = 0; k < shares.size(); ++k) {
        const double begin = k < per_day ? clock_of(around, k) : 0;
        shares[k] = k < per_day ? overlap(begin, begin + step_s / 3600.0, hours)
                                : shares[k - per_day];
    }
    return shares;
}

double mean_of_known(const Series& values) {
    double sum = 0, n = 0;
    for (const double value : values)
        if (!std::isnan(value)) sum += value, ++n;
    return n > 0 ? sum / n : 0;
}

Series over(const Series& series, double largest) {
    if (!(largest > 0)) return {};
    Series share = series;
    for (double& value : share) value /= largest;
    return share;
}

std::vector<double> occupation_of(const Surroundings& around) {
    Series people = over_largest(density_of(around, is_people));
    if (!people.empty()) return people;
    return over_largest(density_of(
        around, [](const physics::Load& load) { return load.density.profile >= 0; }));
}

}  // namespace bemcal::effects
