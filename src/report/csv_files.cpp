/// Writes a result as CSV: a sheet for each leading dimension of each group.
/// Source: RFC 4180 for cells; times as ISO 8601, since spreadsheets read no seconds
/// since 1970. A number has as many digits as bring it back; one that is missing is
/// empty. Attributes of the file and what the datasets mean are left out (`describe
/// results`).
#include "report/csv_files.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "physics/calendar.hpp"
#include "report/stock_tables.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"
#include "store/layout_check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

namespace fs = std::filesystem;
using study::Dataset;

/// More columns of one dataset are rows instead: spreadsheets end at 16,384.
constexpr std::size_t most_columns_of_one = 256;

std::size_t product(std::span<const std::size_t> sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1},
                           std::multiplies<>());
}

std::string unit_of_any(const Dataset& dataset) {
    const store::LayoutRow* row = store::known_layout(dataset);
    return dataset.unit.empty() && row != nullptr ? row->unit : dataset.unit;
}

std::string time_cell(double number, const std::string& unit) {
    const bool is_day = unit.starts_with("days");
    const std::string time = physics::format_time(physics::Seconds(
        std::chrono::seconds(std::llround(number * (is_day ? physics::day_s : 1)))));
    return is_day ? time.substr(0, time.find(' ')) : time;
}

bool is_time(const std::string& unit) {
    return unit.starts_with("seconds since 1970") || unit.starts_with("days since 1970");
}

/// Values whose length is that of their shape, one after another.
class Cells {
  public:
    explicit Cells(const Dataset& dataset)
        : dataset_(dataset), unit_(unit_of_any(dataset)) {
        const std::size_t n =
            dataset.texts.empty() ? dataset.values.size() : dataset.texts.size();
        if (dataset.dims.size() != dataset.shape.size() || n != product(dataset.shape))
            store::refuse_dataset(&dataset, dataset.path, "has values of another number");
    }
    std::string operator[](std::size_t k) const {
        if (!dataset_.texts.empty()) return csv_cell(dataset_.texts[k]);
        const double number = dataset_.values[k];
        if (std::isnan(number)) return "";
        // Beyond these years a time is a damaged number.
        constexpr double latest = 4e9;
        if (is_time(unit_) && std::abs(number) < latest) return time_cell(number, unit_);
        return fmt::format("{}", number);
    }
    /// " [kWh]"; nothing of texts, times and plain numbers.
    std::string unit() const {
        const bool is_plain = unit_.empty() || unit_ == "1" || unit_ == "-" ||
                              unit_.starts_with("of the") || is_time(unit_);
        return is_plain ? "" : fmt::format(" [{}]", unit_);
    }

  private:
    const Dataset& dataset_;
    std::string unit_;
};

/// Whether it names the places of its dimension.
bool is_coordinate(const Dataset& dataset) {
    return dataset.dims.size() == 1 && store::leaf_of(dataset.path) == dataset.dims[0];
}

std::string joined(const std::string& group, const std::string& name) {
    return group.empty() ? name : fmt::format("{}/{}", group, name);
}

/// Names of the places on dimensions, by the coordinate nearest above a group.
class Coordinates {
  public:
    explicit Coordinates(const store::ResultFile& result) {
        for (const Dataset& dataset : result.datasets)
            if (is_coordinate(dataset)) by_path_[dataset.path] = &dataset;
    }
    /// The coordinate's cell, or the number of the place from 1.
    std::string place(std::string group, const std::string& dimension,
                      std::size_t k) const {
        for (;; group = store::group_of(group)) {
            const auto found = by_path_.find(joined(group, dimension));
            if (found != by_path_.end() && k < product(found->second->shape))
                return Cells(*found->second)[k];
            if (group.empty()) return std::to_string(k + 1);
        }
    }

  private:
    std::map<std::string, const Dataset*> by_path_;
};

/// A file: datasets with the same leading dimensions.
struct Sheet {
    std::string group;
    std::vector<std::string> dims;  ///< of its rows; none: single values
    std::vector<std::size_t> shape;
    std::vector<const Dataset*> datasets;
};

/// How many of the dimensions are those of rows.
std::size_t n_of_rows(const Dataset& dataset) {
    if (dataset.dims.empty()) return 0;
    const std::span<const std::size_t> shape(dataset.shape);
    return product(shape.subspan(1)) <= most_columns_of_one ? 1 : dataset.dims.size();
}

/// By the name of the file, without ending.
std::map<std::string, Sheet> sheets_of(const store::ResultFile& result) {
    std::map<std::string, Sheet> sheets;
    for (const Dataset& dataset : result.datasets) {
        const auto n = static_cast<std::ptrdiff_t>(n_of_rows(dataset));
        Sheet made{store::group_of(dataset.path),
                   {dataset.dims.begin(), dataset.dims.begin() + n},
                   {dataset.shape.begin(), dataset.shape.begin() + n},
                   {}};
        const std::string name =
            made.dims.empty() ? "values" : fmt::format("{}", fmt::join(made.dims, "-"));
        Sheet& sheet = sheets.try_emplace(joined(made.group, name), made).first->second;
        if (sheet.shape != made.shape)
            store::refuse_dataset(&dataset, dataset.path,
                                  "others of its group have another number of places");
        sheet.datasets.push_back(&dataset);
    }
    return sheets;
}

/// A place along each of the dimensions, row-major.
std::vector<std::size_t> places_at(std::size_t k, std::span<const std::size_t> shape) {
    std::vector<std::size_t> places(shape.size());
    for (std::size_t d = shape.size(); d-- > 0; k /= shape[d]) places[d] = k % shape[d];
    return places;
}

std::string values_text(const Sheet& sheet) {
    std::string text = "name,value,unit\n";
    for (const Dataset* dataset : sheet.datasets)
        text += fmt::format("{},{},{}\n", csv_cell(store::leaf_of(dataset->path)),
                            Cells(*dataset)[0], csv_cell(unit_of_any(*dataset)));
    return text;
}

std::string heads_of(const Sheet& sheet, const Dataset& dataset,
                     const Coordinates& coordinates) {
    const std::size_t n_rows = sheet.dims.size();
    const auto trailing = std::span<const std::size_t>(dataset.shape).subspan(n_rows);
    std::string heads;
    for (std::size_t k = 0; k < product(trailing); ++k) {
        std::string head = store::leaf_of(dataset.path);
        const std::vector<std::size_t> places = places_at(k, trailing);
        for (std::size_t d = 0; d < places.size(); ++d)
            head +=
                " " + coordinates.place(sheet.group, dataset.dims[n_rows + d], places[d]);
        heads += "," + csv_cell(head + Cells(dataset).unit());
    }
    return heads;
}

std::string sheet_text(const Sheet& sheet, const Coordinates& coordinates) {
    if (sheet.dims.empty()) return values_text(sheet);
    std::string text = fmt::format("{}", fmt::join(sheet.dims, ","));
    std::vector<Cells> columns;
    std::vector<std::size_t> widths;
    const std::size_t n_rows = product(sheet.shape);
    for (const Dataset* dataset : sheet.datasets) {
        if (is_coordinate(*dataset)) continue;  // the first column already
        text += heads_of(sheet, *dataset, coordinates);
        columns.emplace_back(*dataset);
        widths.push_back(product(
            std::span<const std::size_t>(dataset->shape).subspan(sheet.dims.size())));
    }
    text += "\n";
    for (std::size_t row = 0; row < n_rows; ++row) {
        const std::vector<std::size_t> places = places_at(row, sheet.shape);
        for (std::size_t d = 0; d < places.size(); ++d)
            text += (d > 0 ? "," : "") +
                    coordinates.place(sheet.group, sheet.dims[d], places[d]);
        for (std::size_t c = 0; c < columns.size(); ++c)
            for (std::size_t k = 0; k < widths[c]; ++k)
                text += "," + columns[c][row * widths[c] + k];
        text += "\n";
    }
    return text;
}

/// A result may be of anyone, and its groups become folders.
void check_path(const std::string& name) {
    const fs::path path(name);
    const bool leaves =
        path.is_absolute() ||
        std::ranges::any_of(path, [](const auto& p) { return p == ".." || p == "."; });
    if (leaves)
        throw UserError(ExitCode::data,
                        fmt::format("damaged: {} is no name of a group", name));
}

void make_empty_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw UserError(ExitCode::cannot_create,
                        fmt::format("{}: cannot be made ({})", folder.string(),
                                    error ? error.message() : "it is a file"));
    if (!fs::is_empty(folder))
        throw UserError(ExitCode::cannot_create,
                        fmt::format("{}: has something in it; expected a new or empty "
                                    "folder",
                                    folder.string()));
}

}  // namespace

int write_csv_files(const store::ResultFile& result, const fs::path& folder) {
    const std::map<std::string, Sheet> sheets = sheets_of(result);
    const Coordinates coordinates(result);
    for (const auto& [name, sheet] : sheets) check_path(name);
    make_empty_folder(folder);
    for (const auto& [name, sheet] : sheets) {
        const fs::path file = folder / fs::path(name + ".csv");
        fs::create_directories(file.parent_path());
        replace_file(file, sheet_text(sheet, coordinates));
    }
    return static_cast<int>(sheets.size());
}

}  // namespace bemcal::report
