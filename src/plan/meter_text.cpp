/// Adds readings up as they enter a study: in kWh or degC, by local standard time, after
/// masks.
/// Plain sums without a source. Readings of a period that is cut are left out, as studies
/// leave them out.
#include "plan/meter_text.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::plan {
namespace {

constexpr double hours_of_year = 8760;

/// Readings of a meter in a period that are not missing.
struct Read {
    std::vector<double> values;
    std::vector<physics::Seconds> begins;
    double hours = 0;         ///< that they are of
    std::size_t n_slots = 0;  ///< as many could be

    double sum() const { return std::reduce(values.begin(), values.end()); }
    std::size_t most() const {
        return static_cast<std::size_t>(std::ranges::max_element(values) -
                                        values.begin());
    }
};

Read read_in(const kernel::Readings& readings, const physics::TimeAxis& axis) {
    const std::vector<int> bounds = physics::interval_bounds(axis, readings.interval);
    Read read;
    read.n_slots = readings.values.size();
    for (std::size_t k = 0; k < readings.values.size(); ++k) {
        if (std::isnan(readings.values[k])) continue;
        read.values.push_back(readings.values[k]);
        read.begins.push_back(axis.begin_of(bounds[k]));
        read.hours += (bounds[k + 1] - bounds[k]) * axis.step_s / 3600.0;
    }
    return read;
}

std::string line_of(const Read& read, const study::Period& period, bool is_mean,
                    double area) {
    const std::size_t most = read.most();
    const std::string how_many = fmt::format("    {}: {} of {} readings, ", period.name,
                                             read.values.size(), read.n_slots);
    const std::string largest = fmt::format("largest {:.5g} from {}\n", read.values[most],
                                            physics::format_time(read.begins[most]));
    if (is_mean)
        return how_many +
               fmt::format("mean {:.4g} degC, ",
                           read.sum() / static_cast<double>(read.values.size())) +
               largest;
    return how_many +
           fmt::format("{:.6g} kWh, {:.4g} kWh/(m2 a), ", read.sum(),
                       read.sum() / read.hours * hours_of_year / area) +
           largest;
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
            if (const Read read = read_in(readings[m], axis); !read.values.empty())
                lines[m] += line_of(read, period,
                                    physics::is_temperature(readings[m].quantity), area);
    }
    return fmt::format("{}", fmt::join(lines, ""));
}

}  // namespace bemcal::plan
