/// Adds readings up as they enter a study: in kWh or degC, by local standard time, after
/// masks.
/// Plain sums without a source. Readings of a period that is cut are left out, as studies
/// leave them out.
#include "plan/meter_text.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::plan {
namespace {

constexpr double hours_of_year = 8760;

/// Readings of a meter in a period that are not missing.
struct Read {
    std::size_t n = 0;
    double sum = 0, hours = 0;  ///< hours that they are of
    double largest = -std::numeric_limits<double>::infinity();
    physics::Seconds at{};  ///< begin of the largest
};

Read read_in(const kernel::Readings& readings, const physics::TimeAxis& axis) {
    const std::vector<int> bounds = physics::interval_bounds(axis, readings.interval);
    Read read;
    for (std::size_t k = 0; k < readings.values.size(); ++k) {
        const double value = readings.values[k];
        if (std::isnan(value)) continue;
        ++read.n;
        read.sum += value;
        read.hours += (bounds[k + 1] - bounds[k]) * axis.step_s / 3600.0;
        if (value <= read.largest) continue;
        read.largest = value;
        read.at = axis.begin_of(bounds[k]);
    }
    return read;
}

std::string line_of(const study::Period& period, const kernel::Readings& readings,
                    const Read& read, double area) {
    const std::string sum =
        physics::is_temperature(readings.quantity)
            ? fmt::format("mean {:.4g} degC", read.sum / static_cast<double>(read.n))
            : fmt::format("{:.6g} kWh, {:.4g} kWh/(m2 a)", read.sum,
                          read.sum / read.hours * hours_of_year / area);
    return fmt::format("    {}: {} of {} readings, {}, largest {:.5g} from {}\n",
                       period.name, read.n, readings.values.size(), sum, read.largest,
                       physics::format_time(read.at));
}

std::string head_of(const study::Meter& meter) {
    const bool is_energy = !physics::is_temperature(meter.quantity);
    return fmt::format(
        "  meter, {}: {}, {}{}\n", meter.name, physics::name_of(meter.quantity),
        meter.interval.are_own() ? "bills"
                                 : physics::name_of(physics::Interval(meter.interval)),
        is_energy && meter.unit != "kWh" ? ", in kWh from " + meter.unit : "");
}

}  // namespace

std::string meter_lines(const study::Case& building) {
    const double area = building.building.floor_area();
    std::vector<std::string> lines;
    lines.reserve(building.meters.size());
    for (const study::Meter& meter : building.meters) lines.push_back(head_of(meter));
    for (const study::Period& period : building.periods) {
        const physics::TimeAxis axis = study::axis_of(building, period);
        const auto readings = study::readings_of(building, period);
        for (std::size_t m = 0; m < lines.size(); ++m)
            if (const Read read = read_in(readings[m], axis); read.n > 0)
                lines[m] += line_of(period, readings[m], read, area);
    }
    return fmt::format("{}", fmt::join(lines, ""));
}

}  // namespace bemcal::plan
