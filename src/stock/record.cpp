/// Converts what is known of a building four ways by one list of fields: to an item's
/// numbers and back, to datasets and back. A new field is one line here.
/// Follows from `StockRecord`; a number holds eight bytes.
/// Packed records have no version. A dataset that is missing leaves its field at the
/// default.
#include "stock/record.hpp"

#include "base/error.hpp"
#include "study/columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

namespace bemcal::stock {

namespace {

/// Calls `see` with every field of a row, under the dataset's name.
template <class Row, class See>
void visit_building(Row& row, See&& see) {
    see("stock_building", row.name);
    see("stock_status", row.status);
    see("stock_cause", row.cause);
    see("stock_reason", row.reason);
    see("stock_drift", row.drift);
    see("stock_told", row.told);
    see("stock_undecided", row.undecided);
    see("stock_undecided_probability", row.undecided_probability);
    see("stock_adopted", row.adopted);
    see("stock_adopted_hash", row.adopted_hash);
    see("stock_known_from", row.known_from);
    see("stock_known_to", row.known_to);
    see("stock_tested_to", row.tested_to);
    see("stock_searches", row.searches);
    see("stock_line_hash", row.line_hash);
    see("stock_job_hash", row.job_hash);
    see("stock_data_hash", row.data_hash);
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
void visit_effect(Row& row, See&& see) {
    see("stock_effect", row.name);
    see("stock_effect_unit", row.unit);
    see("stock_effect_state", row.state);
    see("stock_effect_section", row.section);
    see("stock_effect_coefficient", row.coefficient);
    see("stock_effect_low", row.low);
    see("stock_effect_high", row.high);
    see("stock_effect_since", row.since);
    see("stock_effect_by_stock", row.by_stock);
    see("stock_effect_by_stock_probability", row.by_stock_probability);
    see("stock_effect_by_stock_coefficient", row.by_stock_coefficient);
}
template <class Row, class See>
void visit_name(Row& row, See&& see) {
    see("stock_name_effect", row.effect);
    see("stock_name", row.name);
    see("stock_name_probability", row.probability);
}
template <class Row, class See>
void visit_place(Row& row, See&& see) {
    see("stock_place", row.name);
    see("stock_place_unit", row.unit);
    see("stock_place_typical", row.typical);
    see("stock_place_coefficient", row.coefficient);
    see("stock_place_sd", row.sd);
}
template <class Row, class See>
void visit_change(Row& row, See&& see) {
    see("stock_change", row.of);
    see("stock_change_day", row.day);
    see("stock_change_size", row.size);
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
    table("stock_effects", record.effects,
          [](auto& row, auto&& see) { visit_effect(row, see); });
    table("stock_names", record.names,
          [](auto& row, auto&& see) { visit_name(row, see); });
    table("stock_places", record.of_the_place,
          [](auto& row, auto&& see) { visit_place(row, see); });
    table("stock_changes", record.changes,
          [](auto& row, auto&& see) { visit_change(row, see); });
    table("stock_findings", record.findings,
          [](auto& row, auto&& see) { visit_finding(row, see); });
}

class Packer {
  public:
    void operator()(const char*, double value) { put(&value, sizeof value); }
    void operator()(const char*, const std::string& text) {
        count(text.size());
        put(text.data(), text.size());
    }
    void operator()(const std::vector<float>& values) {
        count(values.size());
        put(values.data(), values.size() * sizeof(float));
    }
    void count(std::size_t n) {
        const auto value = static_cast<std::uint32_t>(n);
        put(&value, sizeof value);
    }
    std::vector<double> packed() const {
        std::vector<double> numbers(1 + in_numbers(bytes_.size()));
        numbers[0] = static_cast<double>(bytes_.size());
        if (!bytes_.empty()) std::memcpy(&numbers[1], bytes_.data(), bytes_.size());
        return numbers;
    }
    static std::size_t in_numbers(std::size_t n_bytes) {
        return (n_bytes + sizeof(double) - 1) / sizeof(double);
    }

  private:
    void put(const void* data, std::size_t n) {
        bytes_.append(static_cast<const char*>(data), n);
    }
    std::string bytes_;
};

class Unpacker {
  public:
    explicit Unpacker(std::span<const double> packed) {
        require(!packed.empty(), "a packed record is cut short");
        left_ = static_cast<std::size_t>(packed[0]);
        used_ = 1 + Packer::in_numbers(left_);
        require(used_ <= packed.size(), "a packed record is cut short");
        at_ = reinterpret_cast<const char*>(packed.data() + 1);
    }
    void operator()(const char*, double& value) { take(&value, sizeof value); }
    void operator()(const char*, std::string& text) {
        text.resize(count(1));
        take(text.data(), text.size());
    }
    void operator()(std::vector<float>& values) {
        values.resize(count(sizeof(float)));
        take(values.data(), values.size() * sizeof(float));
    }
    /// Of things of at least that size, checked against what is left.
    std::size_t count(std::size_t size) {
        std::uint32_t n = 0;
        take(&n, sizeof n);
        require(n <= left_ / size, "a packed record is cut short");
        return n;
    }
    std::size_t used() const { return used_; }

  private:
    void take(void* to, std::size_t n) {
        require(n <= left_, "a packed record is cut short");
        if (n > 0) std::memcpy(to, at_, n);
        at_ += n;
        left_ -= n;
    }

    const char* at_ = nullptr;
    std::size_t left_ = 0, used_ = 0;
};

const std::string group = "stock";
constexpr const char* of_building = "_of";  ///< leaf: the building's index of each row

/// Two datasets: how long each building's series is, and all of them one after the other.
class DailyColumns {
  public:
    void add(const std::vector<float>& daily, std::size_t n_buildings) {
        // All are about as long as the first.
        if (counts_.empty()) counts_.reserve(n_buildings);
        if (all_.empty()) all_.reserve(daily.size() * n_buildings);
        counts_.push_back(static_cast<double>(daily.size()));
        all_.insert(all_.end(), daily.begin(), daily.end());
    }
    void take(std::vector<study::Dataset>& datasets) {
        const std::size_t n = counts_.size(), n_days = all_.size();
        datasets.push_back(
            {group + "/stock_daily_n", {"stock_building"}, {n}, std::move(counts_), {}});
        if (n_days > 0)
            datasets.push_back(
                {group + "/stock_daily", {"stock_days"}, {n_days}, std::move(all_), {}});
    }

  private:
    std::vector<double> counts_, all_;
};

/// A day that a calendar of some thousand years has.
bool is_day(double day) {
    return std::abs(day) < 1e6;
}

void read_daily(const std::vector<study::Dataset>& datasets,
                std::vector<StockRecord>& records) {
    const auto* counts = study::find_dataset(datasets, group + "/stock_daily_n");
    const auto* all = study::find_dataset(datasets, group + "/stock_daily");
    if (counts == nullptr || all == nullptr) return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < records.size(); ++k) {
        if (k >= counts->values.size()) return;
        const std::size_t n =
            study::place_in(counts->values[k], all->values.size() - at + 1);
        if (n > all->values.size() - at) return;
        const auto first = all->values.begin() + static_cast<std::ptrdiff_t>(at);
        records[k].daily.assign(first, first + static_cast<std::ptrdiff_t>(n));
        at += n;
    }
}

/// One list's rows, each to the building that it is of.
template <class Row, class Visit>
void read_list(const std::vector<study::Dataset>& datasets, const char* dim,
               const Visit& visit, std::vector<StockRecord>& records) {
    const auto* owners = study::find_dataset(datasets, group + "/" + dim + of_building);
    if (owners == nullptr) return;
    const auto reader = study::ColumnReader::of<Row>(datasets, group, visit);
    for (std::size_t k = 0; k < owners->values.size(); ++k) {
        const auto owner = study::place_in(owners->values[k], records.size());
        if (owner >= records.size()) continue;
        visit_lists(records[owner], [&](const char* other, auto& rows, auto&&) {
            if constexpr (std::is_same_v<std::ranges::range_value_t<decltype(rows)>, Row>)
                if (std::string_view(other) == dim)
                    reader.read(k, rows.emplace_back(), visit);
        });
    }
}

}  // namespace

StockRecord carried_over(const StockRecord& before) {
    StockRecord record = before;
    record.age += 1;
    record.searches = 0;
    record.told = "";
    for (StockRecord::Effect& effect : record.effects)
        if (effect.state == "new") effect.state = "holds";
    for (StockRecord::Value& value : record.values) value.moved = 0;
    return record;
}

std::vector<double> pack(const StockRecord& record) {
    Packer packer;
    visit_building(record, packer);
    visit_lists(record, [&](const char*, const auto& rows, auto&& visit) {
        packer.count(rows.size());
        for (const auto& row : rows) visit(row, packer);
    });
    packer(record.daily);
    return packer.packed();
}

StockRecord unpack_record(std::span<const double> packed, std::size_t& used) {
    StockRecord record;
    Unpacker unpacker(packed);
    visit_building(record, unpacker);
    visit_lists(record, [&](const char*, auto& rows, auto&& visit) {
        rows.resize(unpacker.count(1));
        for (auto& row : rows) visit(row, unpacker);
    });
    unpacker(record.daily);
    used = unpacker.used();
    return record;
}

std::vector<study::Dataset> datasets_of(
    std::size_t n_records, const std::function<StockRecord(std::size_t)>& record_of) {
    const auto visit_record = [](auto& row, auto&& see) { visit_building(row, see); };
    study::ColumnWriter buildings(group, "stock_building");
    std::map<std::string, study::ColumnWriter> lists;
    DailyColumns daily;
    for (std::size_t k = 0; k < n_records; ++k) {
        const StockRecord record = record_of(k);
        buildings.add(record, visit_record);
        visit_lists(record, [&](const char* dim, const auto& rows, const auto& visit) {
            study::ColumnWriter& columns =
                lists.try_emplace(dim, group, dim).first->second;
            const std::string of = dim + std::string(of_building);
            for (const auto& row : rows)
                columns.add(row, [&](auto& one, auto&& see) {
                    see(of.c_str(), static_cast<double>(k));
                    visit(one, see);
                });
        });
        daily.add(record.daily, n_records);
    }
    std::vector<study::Dataset> datasets;
    buildings.take(datasets);
    for (auto& [dim, columns] : lists) columns.take(datasets);
    daily.take(datasets);
    return datasets;
}

std::vector<StockRecord> records_in(const std::vector<study::Dataset>& datasets) {
    auto records = study::rows_in<StockRecord>(
        datasets, group, [](auto& row, auto&& see) { visit_building(row, see); });
    StockRecord none;
    visit_lists(none, [&](const char* dim, auto& rows, const auto& visit) {
        using Row = std::ranges::range_value_t<decltype(rows)>;
        read_list<Row>(datasets, dim, visit, records);
    });
    for (StockRecord& record : records)
        if (!is_day(record.daily_start)) record.daily_start = 0;
    read_daily(datasets, records);
    return records;
}

}  // namespace bemcal::stock
