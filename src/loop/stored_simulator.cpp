/// Turns what is stored of a simulator into datasets and back, by one list of names.
/// Follows from `StoredSimulator`: a struct is a row, its fields are columns.
/// Units and meanings are the store's layout's.
#include "loop/stored_simulator.hpp"

#include "study/columns.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::loop {
namespace {

/// Calls `table` with the dimension, rows and fields of each list.
template <class Simulator, class Table>
void visit_lists(Simulator& simulator, Table&& table) {
    table("simulator_parameter", simulator.parameters, [](auto& row, auto&& see) {
        see("simulator_parameter", row.name);
        see("simulator_parameter_unit", row.unit);
        see("simulator_parameter_least", row.least);
        see("simulator_parameter_most", row.most);
        see("simulator_parameter_plain", row.plain);
        see("simulator_parameter_before", row.before);
        see("simulator_parameter_after", row.after);
    });
    table("simulator_given", simulator.given, [](auto& row, auto&& see) {
        see("simulator_given", row.name);
        see("simulator_given_hooks", row.hooks);
        see("simulator_given_scale", row.scale);
    });
    table("simulator_series", simulator.series, [](auto& row, auto&& see) {
        see("simulator_series_of", row.of);
        see("simulator_series_hook", row.hook);
        see("simulator_series_unit", row.unit);
        see("simulator_series_enters", row.enters);
        see("simulator_series_facade", row.facade);
        see("simulator_series_meter", row.meter);
        see("simulator_series_opens_above", row.opens_above);
    });
    table("simulator_left_out", simulator.left_out,
          [](auto& row, auto&& see) { see("simulator_left_out", row.why); });
    table("simulator_run", simulator.runs, [](auto& row, auto&& see) {
        see("simulator_run", row.of);
        see("simulator_run_failure", row.failure);
        see("simulator_run_distance", row.distance);
        see("simulator_run_years", row.years);
    });
    table("simulator_channel", simulator.channels, [](auto& row, auto&& see) {
        see("simulator_channel", row.name);
        see("simulator_emulator_error", row.emulator_error);
    });
}

constexpr const char *by_adding = "add", *by_factor = "factor";

std::string hooks_of(const study::GivenEffect& effect) {
    std::vector<std::string> hooks;
    for (const effects::HookSeries& at : effect.at)
        if (std::ranges::find(hooks, at.hook) == hooks.end()) hooks.push_back(at.hook);
    return fmt::format("{}", fmt::join(hooks, ", "));
}

}  // namespace

void add_given(const std::vector<study::GivenEffect>& effects,
               std::span<const double> scales, StoredSimulator& simulator) {
    auto& values = simulator.series_value.values;
    for (std::size_t k = 0; k < effects.size(); ++k) {
        const auto index = static_cast<double>(simulator.given.size());
        simulator.given.push_back({effects[k].name, hooks_of(effects[k]), scales[k]});
        if (scales[k] == 0) continue;
        for (const effects::HookSeries& at : effects[k].at) {
            simulator.series.push_back({index, at.hook, at.unit,
                                        at.is_factor ? by_factor : by_adding, at.facade,
                                        at.meter, at.opens_above});
            for (const double value : at.values) values.push_back(scales[k] * value);
        }
    }
    const std::size_t n = simulator.series.size();
    simulator.series_value.shape = {n, n > 0 ? values.size() / n : 0};
}

std::vector<study::GivenEffect> given_in(const StoredSimulator& simulator) {
    std::vector<study::GivenEffect> effects;
    effects.reserve(simulator.given.size());
    for (const StoredSimulator::Given& given : simulator.given)
        effects.push_back({given.name, {}});
    const study::Array& all = simulator.series_value;
    const std::size_t n_hours = all.shape.size() > 1 ? all.shape[1] : 0;
    for (std::size_t s = 0; s < simulator.series.size(); ++s) {
        const StoredSimulator::Series& row = simulator.series[s];
        const auto begin = all.values.begin() + static_cast<std::ptrdiff_t>(s * n_hours);
        const std::size_t k = study::place_in(row.of, effects.size());
        if (k == effects.size()) continue;
        effects[k].at.push_back({row.hook,
                                 row.unit,
                                 row.enters == by_factor,
                                 row.facade,
                                 row.meter,
                                 {begin, begin + static_cast<std::ptrdiff_t>(n_hours)},
                                 row.opens_above});
    }
    return effects;
}

std::vector<study::Dataset> datasets_of(const std::string& group,
                                        const StoredSimulator& simulator) {
    std::vector<study::Dataset> datasets;
    visit_lists(simulator, [&](const char* dim, const auto& rows, const auto& visit) {
        study::add_rows(group, dim, rows, visit, datasets);
    });
    study::DatasetBuilder arrays(group);
    arrays.array("simulator_series_value", simulator.series_value);
    std::ranges::move(arrays.take(), std::back_inserter(datasets));
    return datasets;
}

StoredSimulator stored_simulator(const std::vector<study::Dataset>& datasets,
                                 const std::string& group) {
    StoredSimulator simulator;
    visit_lists(simulator, [&](const char*, auto& rows, const auto& visit) {
        using Row = std::ranges::range_value_t<decltype(rows)>;
        rows = study::rows_in<Row>(datasets, group, visit);
    });
    if (const auto* stored =
            study::find_dataset(datasets, group + "/simulator_series_value"))
        simulator.series_value = {stored->dims, stored->shape, stored->values};
    return simulator;
}

}  // namespace bemcal::loop
