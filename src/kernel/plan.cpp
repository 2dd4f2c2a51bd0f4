/// Sizes and offsets of a zone's tables; months of the period, and chunks of steps whose
/// rows fit the first-level cache.
/// Follows from the columns in kernel.hpp. Which inputs make regimes and rows is left to
/// zone_plan and meter_plan.
#include "kernel/plan.hpp"

#include "physics/season.hpp"

#include <algorithm>

namespace bemcal::kernel {

namespace {

constexpr int chunk_steps = 48;  ///< rows of 16 lanes of three quantities fill 18 KiB
constexpr double season_margin = 0.1;  ///< beyond the ends of parameters' ranges [K]

}  // namespace

void SeasonLimits::add(const physics::Structure& structure) {
    const auto extend = [](Ends& ends, double limit) {
        ends.least = std::min(ends.least, limit);
        ends.most = std::max(ends.most, limit);
    };
    extend(heating_, structure.heating_limit);
    extend(cooling_, structure.cooling_limit);
}

Partition SeasonLimits::classes(std::span<const double> theta_rm) const {
    Partition classes = one_class(static_cast<int>(theta_rm.size()));
    const double reach = 0.5 * physics::season_ramp + season_margin;
    for (const Ends& ends : {heating_, cooling_}) {
        std::vector<double> within;
        within.reserve(theta_rm.size());
        for (const double theta : theta_rm)
            within.push_back(std::clamp(theta, ends.least - reach, ends.most + reach));
        classes = both(classes, classes_of(within));
    }
    return classes;
}

bool SeasonLimits::has(const physics::Structure& structure) const {
    const auto holds = [](const Ends& ends, double limit) {
        return limit >= ends.least - season_margin && limit <= ends.most + season_margin;
    };
    return holds(heating_, structure.heating_limit) &&
           holds(cooling_, structure.cooling_limit);
}

int ZonePlan::vented_state() const {
    if (!vented) return -1;
    return static_cast<int>(
        std::find(states.begin(), states.end(), physics::Term::theta_air) -
        states.begin());
}

int ZonePlan::n_drivers() const {
    return 1 + static_cast<int>(temperature_drivers.size() + load_drivers.size()) +
           (imposed_driver ? 1 : 0);
}

int ZonePlan::regime_columns() const {
    const int n = static_cast<int>(states.size()),
              n_planes = static_cast<int>(planes.size());
    if (is_standard()) return StandardColumn::drivers + 2 * n_drivers() + n_planes;
    return GeneralColumn::forms + (3 + n + n_drivers()) * (1 + n) + n_planes +
           (vented ? VentingColumn::forms + 1 + n : 0);
}

int ZonePlan::of_regime_columns() const {
    return regime_columns() + (is_standard() ? static_cast<int>(planes.size()) : 0);
}

int ZonePlan::row_columns() const {
    if (is_standard()) return standard_row_columns;
    return general_row_columns(static_cast<int>(states.size())) + (vented ? 1 : 0);
}

ZoneTime ZonePlan::time(int lanes) const {
    return {static_cast<int>(states.size()),
            imposed_driver ? 1 : 0,
            vented_state(),
            n_drivers(),
            static_cast<int>(planes.size()),
            regime_columns() * lanes,
            of_regime_columns() * lanes,
            drivers.data(),
            row_offset.data(),
            segments.data()};
}

std::vector<int> offsets_of(const Partition& rows, int doubles_per_row) {
    std::vector<int> offsets(rows.class_of.size());
    for (std::size_t step = 0; step < offsets.size(); ++step)
        offsets[step] = rows.class_of[step] * doubles_per_row;
    return offsets;
}

std::vector<Span> plan_months(const physics::Drive& drive) {
    const std::vector<int> bounds =
        physics::interval_bounds(drive.period(), physics::Interval::monthly);
    std::vector<Span> months;
    months.reserve(bounds.size());
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        months.push_back({drive.n_warm_up + bounds[k], drive.n_warm_up + bounds[k + 1],
                          static_cast<int>(k)});
    return months;
}

std::vector<Span> cut_chunks(const std::vector<Span>& months) {
    std::vector<Span> chunks;
    for (const Span& month : months)
        for (int begin = month.begin; begin < month.end; begin += chunk_steps)
            chunks.push_back(
                {begin, std::min(begin + chunk_steps, month.end), month.month});
    return chunks;
}

}  // namespace bemcal::kernel
