/// Makes a run of another program an item's answer, and back.
/// Follows from `study::pack`: a run is a conclusion's datasets.
/// Where the next run pays is the studies' own.
#include "study/simulator_run.hpp"

#include "base/nan.hpp"
#include "study/datasets.hpp"
#include "study/packed_conclusion.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

constexpr const char* run_group = "run";

const Dataset& dataset_of(const Conclusion& all, const char* leaf) {
    return *find_dataset(all.datasets, std::string(run_group) + "/" + leaf);
}

}  // namespace

std::vector<double> values_at(std::span<const double> point,
                              const std::vector<physics::Parameter>& parameters) {
    Matrix row(1, point.size());
    std::ranges::copy(point, row.row(0).begin());
    return in_ranges(std::move(row), parameters).values;
}

std::vector<double> nominal_on_scale(const std::vector<physics::Parameter>& parameters) {
    std::vector<double> nominal;
    nominal.reserve(parameters.size());
    for (const physics::Parameter& parameter : parameters)
        nominal.push_back(on_scale(parameter.nominal, parameter));
    return nominal;
}

std::size_t column_of(const HourlySimulator& simulator, const std::string& meter) {
    const auto& known = simulator.meters();
    const auto found = std::ranges::find(known, meter);
    if (found == known.end())
        throw std::invalid_argument(
            fmt::format("the meter {} has no hours of the simulator; expected a "
                        "[[simulator.hourly]] of it, or meters without it",
                        meter));
    return static_cast<std::size_t>(found - known.begin());
}

double years_of_run(const std::vector<Period>& periods, const SimulatorRun& run) {
    constexpr double hours_of_year = 8760;
    return run.asked.empty() ? 0 : hours_asked(periods, run.asked) / hours_of_year;
}

void add_made_runs(const std::vector<physics::Parameter>& parameters, MadeRuns runs,
                   DatasetBuilder& datasets) {
    const std::size_t n = runs.of.size();
    datasets.parameters(parameters, "simulator_parameter");
    datasets.texts("simulator_run", "simulator_run", std::move(runs.of));
    datasets.texts("simulator_run_failure", "simulator_run", std::move(runs.failures));
    datasets.array("simulator_run_value", {"simulator_run", "simulator_parameter"},
                   {n, parameters.size()}, std::move(runs.values));
}

SimulatedHours hours_of_run(const HourlySimulator& simulator,
                            std::span<const double> values,
                            std::vector<GivenEffect> effects,
                            const std::vector<Period>& periods,
                            const AskedPeriods& asked) {
    for (GivenEffect& effect : effects)
        for (effects::HookSeries& at : effect.at)
            at.values = cut_to_asked(periods, asked, at.values);
    SimulatedHours simulated =
        simulator.hours(values, effects, periods_asked(periods, asked));
    for (auto& meter : simulated.meters) meter = spread_asked(periods, asked, meter);
    return simulated;
}

ItemAnswer simulate(const HourlySimulator& simulator, SimulatorRun run,
                    std::span<const double> values, std::vector<GivenEffect> effects,
                    std::span<const std::size_t> columns,
                    const std::vector<Period>& periods) {
    SimulatedHours simulated =
        hours_of_run(simulator, values, std::move(effects), periods, run.asked);
    ItemAnswer answer;
    run.left_out = std::move(simulated.left_out);
    if (simulated.failure.empty())
        for (const std::size_t column : columns)
            run.hours.push_back(simulated.meters[column]);
    else
        answer.failures.push_back({0, simulated.failure});
    answer.values = pack(run);
    return answer;
}

SimulatorRun run_in(const ItemAnswer& answer, std::size_t n_parameters) {
    SimulatorRun run;
    run.point.assign(n_parameters, nan);
    if (!answer.values.empty()) run = unpack_run(answer.values);
    if (!answer.error.empty()) run.failure = answer.error;
    if (!answer.failures.empty()) run.failure = answer.failures[0].reason;
    return run;
}

std::vector<double> pack(const SimulatorRun& run) {
    DatasetBuilder datasets(run_group);
    datasets.vector("point", "parameter", run.point);
    datasets.vector("scale", "effect", run.scales);
    datasets.vector("asked", "period", {run.asked.begin(), run.asked.end()});
    datasets.texts("left_out", "left_out", run.left_out);
    std::vector<double> hours;
    for (const auto& meter : run.hours)
        hours.insert(hours.end(), meter.begin(), meter.end());
    const std::size_t n = run.hours.size();
    datasets.array("hours", {"channel", "time"}, {n, n > 0 ? run.hours[0].size() : 0},
                   std::move(hours));
    return pack({datasets.take()});
}

SimulatorRun unpack_run(std::span<const double> packed) {
    const Conclusion all = unpack_conclusion(packed);
    const auto& asked = dataset_of(all, "asked").values;
    SimulatorRun run{dataset_of(all, "point").values,   dataset_of(all, "scale").values,
                     {asked.begin(), asked.end()},      {},
                     dataset_of(all, "left_out").texts, {}};
    const Dataset& hours = dataset_of(all, "hours");
    for (std::size_t c = 0; c < hours.shape[0]; ++c) {
        const auto begin =
            hours.values.begin() + static_cast<std::ptrdiff_t>(c * hours.shape[1]);
        run.hours.emplace_back(begin,
                               begin + static_cast<std::ptrdiff_t>(hours.shape[1]));
    }
    return run;
}

}  // namespace bemcal::study
