/// One list of fields serves all four ways.
#include "job/stock_record.hpp"

#include "base/error.hpp"

#include <cstring>
#include <map>

namespace bemcal::job {

namespace {

/// Calls `see` with every field of a row, under the dataset's name.
template <class Row, class See>
void visit_building(Row& row, See&& see) {
    see("stock_building", row.name);
    see("stock_status", row.status);
    see("stock_cause", row.cause);
    see("stock_reason", row.reason);
    see("stock_drift", row.drift);
    see("stock_line_hash", row.line_hash);
    see("stock_job_hash", row.job_hash);
    see("stock_age", row.age);
    see("stock_simulations", row.simulations);
    see("stock_daily_start", row.daily_start);
}
template <class Row, class See>
void visit_file(Row& row, See&& see) {
    see("stock_file", row.path);
    see("stock_file_hash", row.hash);
}
template <class Row, class See>
void visit_fit(Row& row, See&& see) {
    see("stock_fit_meter", row.meter);
    see("stock_fit_unit", row.unit);
    see("stock_fit_period", row.period);
    see("stock_fit_measured", row.measured);
    see("stock_fit_n", row.n);
    see("stock_fit_before", row.before);
    see("stock_fit_cv_rmse", row.cv_rmse);
    see("stock_fit_nmbe", row.nmbe);
}
template <class Row, class See>
void visit_value(Row& row, See&& see) {
    see("stock_value_parameter", row.name);
    see("stock_value_unit", row.unit);
    see("stock_value_least", row.least);
    see("stock_value_most", row.most);
    see("stock_value", row.value);
    see("stock_value_low", row.low);
    see("stock_value_high", row.high);
    see("stock_value_moved", row.moved);
}
template <class Row, class See>
void visit_finding(Row& row, See&& see) {
    see("stock_finding_series", row.series);
    see("stock_finding", row.finding);
    see("stock_finding_action", row.action);
}

/// Calls `table` with the dimension, rows and fields of each list of a record.
template <class Record, class Table>
void visit_lists(Record& record, Table&& table) {
    table("stock_files", record.files,
          [](auto& row, auto&& see) { visit_file(row, see); });
    table("stock_fits", record.fits, [](auto& row, auto&& see) { visit_fit(row, see); });
    table("stock_values", record.values,
          [](auto& row, auto&& see) { visit_value(row, see); });
    table("stock_findings", record.findings,
          [](auto& row, auto&& see) { visit_finding(row, see); });
}

class Packer {
  public:
    void operator()(const char*, double value) { packed.push_back(value); }
    void operator()(const char*, const std::string& text) {
        packed.push_back(static_cast<double>(text.size()));
        const std::size_t first = packed.size();
        packed.resize(first + (text.size() + 7) / 8);
        if (!text.empty()) std::memcpy(&packed[first], text.data(), text.size());
    }
    std::vector<double> packed;
};

class Unpacker {
  public:
    explicit Unpacker(std::span<const double> packed) : rest_(packed) {}
    void operator()(const char*, double& value) {
        require(!rest_.empty(), "a packed record is cut short");
        value = rest_.front();
        rest_ = rest_.subspan(1);
    }
    std::size_t count() {
        double n = 0;
        (*this)("", n);
        return static_cast<std::size_t>(n);
    }
    void operator()(const char*, std::string& text) {
        text.resize(count());
        const std::size_t n = (text.size() + 7) / 8;
        require(n <= rest_.size(), "a packed record is cut short");
        if (!text.empty()) std::memcpy(text.data(), rest_.data(), text.size());
        rest_ = rest_.subspan(n);
    }
    std::size_t left() const { return rest_.size(); }

  private:
    std::span<const double> rest_;
};

/// Columns of one dimension, row by row.
class Columns {
  public:
    explicit Columns(std::string dim) : dim_(std::move(dim)) {}
    void operator()(const char* leaf, double value) { of(leaf).values.push_back(value); }
    void operator()(const char* leaf, const std::string& text) {
        of(leaf).texts.push_back(text);
    }
    void take(std::vector<study::Dataset>& datasets) {
        for (study::Dataset& column : columns_) {
            column.shape = {std::max(column.values.size(), column.texts.size())};
            datasets.push_back(std::move(column));
        }
    }

  private:
    study::Dataset& of(const char* leaf) {
        const std::string path = std::string("stock/") + leaf;
        for (study::Dataset& column : columns_)
            if (column.path == path) return column;
        columns_.push_back({path, {dim_}, {}, {}, {}});
        return columns_.back();
    }
    std::string dim_;
    std::vector<study::Dataset> columns_;
};

/// Fields of one row of stored columns; what is not there stays as it is.
class Row {
  public:
    using Index = std::map<std::string, const study::Dataset*>;
    Row(const Index& index, std::size_t row) : index_(index), row_(row) {}
    void operator()(const char* leaf, double& value) const {
        const study::Dataset* column = find(leaf);
        if (column != nullptr && row_ < column->values.size())
            value = column->values[row_];
    }
    void operator()(const char* leaf, std::string& text) const {
        const study::Dataset* column = find(leaf);
        if (column != nullptr && row_ < column->texts.size()) text = column->texts[row_];
    }

  private:
    const study::Dataset* find(const char* leaf) const {
        const auto found = index_.find(std::string("stock/") + leaf);
        return found == index_.end() ? nullptr : found->second;
    }
    const Index& index_;
    std::size_t row_;
};

constexpr const char* of_building = "_of";  ///< leaf: the building's index of each row

/// Two datasets: how long each building's series is, and all of them one after the other.
void add_daily(const std::vector<StockRecord>& records,
               std::vector<study::Dataset>& datasets) {
    std::vector<double> counts, all;
    for (const StockRecord& record : records) {
        counts.push_back(static_cast<double>(record.daily.size()));
        all.insert(all.end(), record.daily.begin(), record.daily.end());
    }
    datasets.push_back(
        {"stock/stock_daily_n", {"stock_building"}, {counts.size()}, counts, {}});
    if (all.empty()) return;
    datasets.push_back({"stock/stock_daily", {"stock_days"}, {all.size()}, all, {}});
}

void read_daily(const Row::Index& index, std::vector<StockRecord>& records) {
    const auto counts = index.find("stock/stock_daily_n");
    const auto all = index.find("stock/stock_daily");
    if (counts == index.end() || all == index.end()) return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < records.size(); ++k) {
        const auto n = static_cast<std::size_t>(counts->second->values[k]);
        if (at + n > all->second->values.size()) return;
        const auto first = all->second->values.begin() + static_cast<std::ptrdiff_t>(at);
        records[k].daily.assign(first, first + static_cast<std::ptrdiff_t>(n));
        at += n;
    }
}

}  // namespace

std::vector<double> pack(const StockRecord& record) {
    Packer packer;
    visit_building(record, packer);
    visit_lists(record, [&](const char*, const auto& rows, auto&& visit) {
        packer("", static_cast<double>(rows.size()));
        for (const auto& row : rows) visit(row, packer);
    });
    packer("", static_cast<double>(record.daily.size()));
    for (const double value : record.daily) packer("", value);
    return std::move(packer.packed);
}

StockRecord unpack_record(std::span<const double> packed, std::size_t& used) {
    StockRecord record;
    Unpacker unpacker(packed);
    visit_building(record, unpacker);
    visit_lists(record, [&](const char*, auto& rows, auto&& visit) {
        const std::size_t n = unpacker.count();
        require(n <= unpacker.left(), "a packed record is cut short");
        rows.resize(n);
        for (auto& row : rows) visit(row, unpacker);
    });
    const std::size_t n_days = unpacker.count();
    require(n_days <= unpacker.left(), "a packed record is cut short");
    record.daily.resize(n_days);
    for (double& value : record.daily) unpacker("", value);
    used = packed.size() - unpacker.left();
    return record;
}

std::vector<study::Dataset> datasets_of(const std::vector<StockRecord>& records) {
    std::vector<study::Dataset> datasets;
    Columns buildings("stock_building");
    for (const StockRecord& record : records) visit_building(record, buildings);
    buildings.take(datasets);
    std::map<std::string, Columns> lists;
    double number = 0;
    for (const StockRecord& record : records) {
        visit_lists(record, [&](const char* dim, const auto& rows, auto&& visit) {
            Columns& columns = lists.try_emplace(dim, dim).first->second;
            for (const auto& row : rows) {
                columns((std::string(dim) + of_building).c_str(), number);
                visit(row, columns);
            }
        });
        number += 1;
    }
    for (auto& [dim, columns] : lists) columns.take(datasets);
    add_daily(records, datasets);
    return datasets;
}

std::vector<StockRecord> records_in(const std::vector<study::Dataset>& datasets) {
    Row::Index index;
    for (const study::Dataset& dataset : datasets)
        if (dataset.path.starts_with("stock/")) index[dataset.path] = &dataset;
    const auto names = index.find("stock/stock_building");
    if (names == index.end()) return {};
    std::vector<StockRecord> records(names->second->texts.size());
    for (std::size_t k = 0; k < records.size(); ++k)
        visit_building(records[k], Row(index, k));
    StockRecord none;
    visit_lists(none, [&](const char* dim, auto& shape, auto&& visit) {
        const auto owners = index.find("stock/" + std::string(dim) + of_building);
        if (owners == index.end()) return;
        for (std::size_t k = 0; k < owners->second->values.size(); ++k) {
            const auto owner = static_cast<std::size_t>(owners->second->values[k]);
            if (owner >= records.size()) continue;
            visit_lists(records[owner], [&](const char* other, auto& rows, auto&&) {
                if constexpr (std::is_same_v<decltype(rows), decltype(shape)>)
                    if (std::string_view(other) == dim)
                        visit(rows.emplace_back(), Row(index, k));
            });
        }
    });
    read_daily(index, records);
    return records;
}

}  // namespace bemcal::job
