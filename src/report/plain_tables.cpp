/// Tables of a study whose kind has none of its own: its single values, then a table for
/// each dimension, all of it as it is stored.
/// Follows from the dimensions of the datasets.
/// Twelve rows and six columns are shown at most; datasets of more than two dimensions,
/// and groups within the study's, only by name.
#include "report/sections.hpp"
#include "report/text_table.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

using study::Dataset;

constexpr std::size_t most_rows = 12, most_columns = 6;

std::string cell(const Dataset& dataset, std::size_t k) {
    if (k < dataset.texts.size()) return dataset.texts[k];
    return k < dataset.values.size() ? in_short(dataset.values[k]) : "-";
}

std::string leaf_of(const Dataset& dataset) {
    return store::leaf_of(dataset.path);
}

/// The name of a place on a dimension: by the dataset called as it, else its number.
std::string place_on(const Group& study, const std::string& dimension, std::size_t k) {
    const Texts names = study.texts(dimension);
    return k < names.size() ? names[k] : std::to_string(k + 1);
}

/// As stored, else the layout's; empty where it says nothing.
std::string unit_of(const Dataset& dataset) {
    const store::LayoutRow* row = store::known_layout(dataset);
    const std::string unit =
        dataset.unit.empty() && row != nullptr ? row->unit : dataset.unit;
    return unit == "1" || unit.starts_with("of the") ? "" : unit;
}

/// "total [kWh]"
std::string title_of(const Dataset& dataset) {
    const std::string unit = unit_of(dataset);
    return unit.empty() ? leaf_of(dataset)
                        : fmt::format("{} [{}]", leaf_of(dataset), unit);
}

std::string scalar_line(const Dataset& dataset) {
    return fmt::format("  {}: {}\n", title_of(dataset), cell(dataset, 0));
}

std::string more_lines(std::size_t n) {
    return n > most_rows ? fmt::format("  and {} more\n", n - most_rows) : std::string();
}

/// All datasets of one dimension, side by side.
std::string table_on(const Group& study, const std::string& dimension,
                     const std::vector<const Dataset*>& datasets) {
    std::vector<std::string> header{dimension};
    for (const Dataset* dataset : datasets) header.push_back(title_of(*dataset));
    TextTable table(header);
    const std::size_t n = datasets[0]->shape[0];
    for (std::size_t k = 0; k < std::min(n, most_rows); ++k) {
        std::vector<std::string> row{place_on(study, dimension, k)};
        for (const Dataset* dataset : datasets) row.push_back(cell(*dataset, k));
        table.add(std::move(row));
    }
    return table.text(24) + more_lines(n);
}

/// A dataset of two dimensions.
std::string matrix_table(const Group& study, const Dataset& dataset) {
    const std::size_t n_columns = std::min(dataset.shape[1], most_columns);
    std::vector<std::string> header{title_of(dataset)};
    for (std::size_t c = 0; c < n_columns; ++c)
        header.push_back(place_on(study, dataset.dims[1], c));
    TextTable table(header);
    for (std::size_t r = 0; r < std::min(dataset.shape[0], most_rows); ++r) {
        std::vector<std::string> row{place_on(study, dataset.dims[0], r)};
        for (std::size_t c = 0; c < n_columns; ++c)
            row.push_back(cell(dataset, r * dataset.shape[1] + c));
        table.add(std::move(row));
    }
    return table.text(24) + more_lines(dataset.shape[0]);
}

bool is_name(const Dataset& dataset) {
    return dataset.dims.size() == 1 && dataset.dims[0] == leaf_of(dataset);
}

/// A table for each dimension that datasets have alone.
std::string tables_by_dimension(const Group& study,
                                const std::vector<const Dataset*>& all) {
    std::vector<std::string> dimensions;
    for (const Dataset* dataset : all)
        if (dataset->dims.size() == 1 && !is_name(*dataset) &&
            std::ranges::find(dimensions, dataset->dims[0]) == dimensions.end())
            dimensions.push_back(dataset->dims[0]);
    std::string text;
    for (const std::string& dimension : dimensions) {
        std::vector<const Dataset*> on;
        for (const Dataset* dataset : all)
            if (dataset->dims == std::vector<std::string>{dimension} &&
                !is_name(*dataset) && on.size() < most_columns)
                on.push_back(dataset);
        text += table_on(study, dimension, on);
    }
    return text;
}

}  // namespace

std::string plain_section(const Group& study) {
    std::vector<const Dataset*> all = study.datasets();
    std::erase_if(all, [](const Dataset* dataset) {
        return leaf_of(*dataset) == "kind" || leaf_of(*dataset) == "n_failed" ||
               leaf_of(*dataset).starts_with("failed_");
    });
    std::string text = fmt::format("\n{}: {}\n", study.path(), study.texts("kind")[0]);
    for (const Dataset* dataset : all)
        if (dataset->dims.empty()) text += scalar_line(*dataset);
    text += tables_by_dimension(study, all);
    for (const Dataset* dataset : all)
        if (dataset->dims.size() == 2) text += matrix_table(study, *dataset);
    for (const Dataset* dataset : all)
        if (dataset->dims.size() > 2)
            text += fmt::format("  {} [{}]: in the file\n", leaf_of(*dataset),
                                fmt::join(dataset->dims, " x "));
    return text + failure_lines(study);
}

}  // namespace bemcal::report
