/// Makes a grid's targets: what a building's meters show of each output, or the numbers
/// that the job gives; of another program the job's only. Words the grid for `check`.
/// Follows from paper 3's bills: electricity and gas of the period by default, errors in
/// per cent, so no target may be 0.
/// Keys are read by `read_grid`; the grid is run by `grid`.
#include "job/grid_spec.hpp"

#include "input/suggest.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {
namespace {

using calibration::Statistic;
using physics::Quantity;

/// Annual electricity and gas, where the job does not say.
std::vector<GridTargetSpec> targets_of(const GridSpec& spec) {
    if (!spec.targets.empty()) return spec.targets;
    std::vector<GridTargetSpec> targets(2);
    targets[0].output = {Quantity::electricity, Statistic::period};
    targets[1].output = {Quantity::gas, Statistic::period};
    return targets;
}

std::size_t meter_of(const GridTargetSpec& target, const study::Case& building) {
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        const study::Meter& meter = building.meters[m];
        if (target.meter.empty() ? meter.quantity == target.output.quantity &&
                                       study::has_reading(meter.values)
                                 : meter.name == target.meter)
            return m;
    }
    const char* quantity = physics::name_of(target.output.quantity);
    if (!target.meter.empty())
        throw std::invalid_argument(
            fmt::format("\"{}\" is no meter of {}", target.meter, building.name));
    throw std::invalid_argument(
        fmt::format("the target {0} is missing: {1} has no meter of {0} with readings; "
                    "expected one, or a [[study.target]] with measured",
                    quantity, building.name));
}

std::vector<double> measured_of(const GridTargetSpec& target, const study::Case& building,
                                const study::Period& period) {
    if (target.measured.empty())
        return calibration::measured_outputs(target.output, building, period,
                                             meter_of(target, building));
    const std::size_t n = calibration::outputs_of(target.output, building, period).size();
    if (target.measured.size() != n)
        throw std::invalid_argument(
            fmt::format("{} numbers are measured, and {} has {} months; expected one for "
                        "each",
                        target.measured.size(), period.name, n));
    return target.measured;
}

void add(calibration::GridOptions& options, const std::string& output, double measured,
         double scale) {
    if (measured == 0)
        throw std::invalid_argument(
            fmt::format("the target {} is 0, and errors are in per cent of it; expected "
                        "another number, or leave it out",
                        output));
    options.targets.push_back({output, measured, scale});
}

std::string sentence_of(const calibration::NamedGrid& grid) {
    std::vector<std::string> axes;
    std::size_t n = 1;
    for (const auto& [name, values] : grid) {
        axes.push_back(fmt::format("{} {}", name, values.size()));
        n *= values.size();
    }
    return fmt::format("{} = {} points", fmt::join(axes, " x "), n);
}

}  // namespace

std::vector<calibration::OutputSpec> outputs_of(const GridSpec& spec) {
    std::vector<calibration::OutputSpec> outputs;
    for (const GridTargetSpec& target : targets_of(spec))
        outputs.push_back(target.output);
    return outputs;
}

calibration::GridOptions options_for(const GridSpec& spec, const study::Case& building,
                                     const study::Period& period) {
    calibration::GridOptions options = spec.options;
    for (std::size_t p = 0; p < building.priors.size(); ++p)
        if (!building.priors[p].values.empty())
            options.discrete.push_back(building.parameters[p].name);
    for (const GridTargetSpec& target : targets_of(spec)) {
        const auto outputs = calibration::outputs_of(target.output, building, period);
        const auto measured = measured_of(target, building, period);
        for (std::size_t k = 0; k < outputs.size(); ++k)
            add(options, outputs[k].name, measured[k], target.scale);
    }
    return options;
}

calibration::GridOptions options_for(const GridSpec& spec,
                                     const study::Simulator& simulator) {
    calibration::GridOptions options = spec.options;
    if (simulator.is_slow()) options.points_per_item = 1;
    std::vector<std::string> names;
    for (const study::Output& output : simulator.outputs()) names.push_back(output.name);
    if (spec.targets.empty())
        throw std::invalid_argument(
            "the targets of a [simulator] are missing; expected a [[study.target]] with "
            "output and measured");
    for (const GridTargetSpec& target : spec.targets) {
        if (std::ranges::count(names, target.simulator_output) == 0)
            throw std::invalid_argument(fmt::format(
                "\"{}\" is no output of the simulator{}", target.simulator_output,
                input::suggestion(target.simulator_output, names)));
        if (target.measured.size() != 1)
            throw std::invalid_argument(
                fmt::format("the target {} is missing; expected it as measured",
                            target.simulator_output));
        add(options, target.simulator_output, target.measured[0], target.scale);
    }
    return options;
}

std::string sentence_of(const calibration::GridOptions& options) {
    std::vector<std::string> grids;
    grids.reserve(options.grids.size());
    for (const calibration::NamedGrid& grid : options.grids)
        grids.push_back(sentence_of(grid));
    const bool is_refined = options.most_stages > static_cast<int>(options.grids.size());
    return fmt::format("{}{}", fmt::join(grids, ", then "),
                       is_refined ? fmt::format(", then refined by itself: at most {} "
                                                "points in {} stages",
                                                options.budget, options.most_stages)
                                  : std::string());
}

}  // namespace bemcal::job
