/// Turns what is stored of a simulator into datasets and back, by one list of names.
/// Follows from `StoredSimulator`: a struct is a row, its fields are columns.
/// Units and meanings are the store's layout's.
#include "loop/stored_simulator.hpp"

#include "study/columns.hpp"

#include <algorithm>
#include <iterator>

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
    });
    table("simulator_left_out", simulator.left_out,
          [](auto& row, auto&& see) { see("simulator_left_out", row.why); });
    table("simulator_run", simulator.runs, [](auto& row, auto&& see) {
        see("simulator_run", row.of);
        see("simulator_run_failure", row.failure);
        see("simulator_run_distance", row.distance);
    });
    table("simulator_channel", simulator.channels, [](auto& row, auto&& see) {
        see("simulator_channel", row.name);
        see("simulator_emulator_error", row.emulator_error);
    });
}

}  // namespace

std::vector<study::Dataset> datasets_of(const std::string& group,
                                        const StoredSimulator& simulator) {
    std::vector<study::Dataset> datasets;
    visit_lists(simulator, [&](const char* dim, const auto& rows, const auto& visit) {
        using Row = std::ranges::range_value_t<decltype(rows)>;
        study::ColumnWriter columns(group, dim);
        columns.template declare<Row>(visit);
        for (const Row& row : rows) columns.add(row, visit);
        columns.take(datasets);
    });
    study::DatasetBuilder arrays(group);
    arrays.array("simulator_series_value", simulator.series_value);
    std::ranges::move(arrays.take(), std::back_inserter(datasets));
    return datasets;
}

std::vector<std::string> stored_simulator_names() {
    std::vector<std::string> names;
    for (const study::Dataset& dataset : datasets_of("", {})) {
        names.push_back(dataset.path.substr(1));
        names.insert(names.end(), dataset.dims.begin(), dataset.dims.end());
    }
    return names;
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
