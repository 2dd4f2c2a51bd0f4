/// Rows of a struct as datasets of one dimension, and back, by one list of its fields: a
/// function `visit(row, see)` that calls `see(name, field)` for each, always the same in
/// the same order. A field is a number or a text.
#pragma once

#include "study/datasets.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::study {

/// A stored number as a place below `end`; `end` where it is none.
inline std::size_t place_in(double value, std::size_t end) {
    return value >= 0 && value < static_cast<double>(end)
               ? static_cast<std::size_t>(value)
               : end;
}

class ColumnWriter {
  public:
    /// \param group  of the datasets
    ColumnWriter(std::string group, std::string dim)
        : group_(std::move(group)), dim_(std::move(dim)) {}

    /// There are columns, though no row may follow.
    template <class Row, class Visit>
    void declare(Visit&& visit) {
        const Row none{};
        visit(none, [&](const char* leaf, const auto&) { column(leaf); });
        at_ = 0;
    }
    template <class Row, class Visit>
    void add(const Row& row, Visit&& visit) {
        visit(row, *this);
        at_ = 0;
        ++n_rows_;
    }
    void operator()(const char* leaf, double value) {
        column(leaf).values.push_back(value);
    }
    void operator()(const char* leaf, const std::string& text) {
        column(leaf).texts.push_back(text);
    }

    void take(std::vector<Dataset>& datasets) {
        for (Dataset& column : columns_) {
            column.shape = {n_rows_};
            datasets.push_back(std::move(column));
        }
    }

  private:
    Dataset& column(const char* leaf) {
        if (at_ == columns_.size())
            columns_.push_back({group_ + "/" + leaf, {dim_}, {}, {}, {}});
        return columns_[at_++];
    }

    std::string group_, dim_;
    std::vector<Dataset> columns_;
    std::size_t at_ = 0, n_rows_ = 0;
};

/// All rows, and the columns where there are none.
template <class Row, class Visit>
void add_rows(const std::string& group, const std::string& dim,
              const std::vector<Row>& rows, const Visit& visit,
              std::vector<Dataset>& datasets) {
    ColumnWriter columns(group, dim);
    columns.template declare<Row>(visit);
    for (const Row& row : rows) columns.add(row, visit);
    columns.take(datasets);
}

/// What is not stored stays as it is.
class ColumnReader {
  public:
    template <class Row, class Visit>
    static ColumnReader of(const std::vector<Dataset>& datasets, const std::string& group,
                           Visit&& visit) {
        ColumnReader reader;
        const Row none{};
        visit(none, [&](const char* leaf, const auto&) {
            reader.columns_.push_back(find_dataset(datasets, group + "/" + leaf));
        });
        return reader;
    }
    /// By the first column.
    std::size_t n_rows() const {
        const Dataset* first = columns_.empty() ? nullptr : columns_[0];
        return first == nullptr ? 0 : std::max(first->values.size(), first->texts.size());
    }
    template <class Row, class Visit>
    void read(std::size_t k, Row& row, Visit&& visit) const {
        std::size_t at = 0;
        visit(row, [&](const char*, auto& field) { take(columns_[at++], k, field); });
    }

  private:
    static void take(const Dataset* column, std::size_t k, double& value) {
        if (column != nullptr && k < column->values.size()) value = column->values[k];
    }
    static void take(const Dataset* column, std::size_t k, std::string& text) {
        if (column != nullptr && k < column->texts.size()) text = column->texts[k];
    }

    std::vector<const Dataset*> columns_;
};

/// All rows.
template <class Row, class Visit>
std::vector<Row> rows_in(const std::vector<Dataset>& datasets, const std::string& group,
                         Visit&& visit) {
    const ColumnReader reader = ColumnReader::of<Row>(datasets, group, visit);
    std::vector<Row> rows(reader.n_rows());
    for (std::size_t k = 0; k < rows.size(); ++k) reader.read(k, rows[k], visit);
    return rows;
}

}  // namespace bemcal::study
