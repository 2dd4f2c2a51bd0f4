/// A row-major matrix of doubles and read-only views of it: what samples, drives and
/// outputs are passed around in. No algebra: that is Eigen's, inside stats.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal {

struct Matrix {
    std::size_t rows = 0, cols = 0;
    std::vector<double> values;  ///< [rows x cols], row-major

    Matrix() = default;
    Matrix(std::size_t n_rows, std::size_t n_cols, double fill = 0.0)
        : rows(n_rows), cols(n_cols), values(n_rows * n_cols, fill) {}

    double& operator()(std::size_t row, std::size_t col) {
        return values[row * cols + col];
    }
    double operator()(std::size_t row, std::size_t col) const {
        return values[row * cols + col];
    }
    std::span<double> row(std::size_t r) { return {values.data() + r * cols, cols}; }
    std::span<const double> row(std::size_t r) const {
        return {values.data() + r * cols, cols};
    }
    std::vector<double> column(std::size_t c) const {
        std::vector<double> taken(rows);
        for (std::size_t r = 0; r < rows; ++r) taken[r] = (*this)(r, c);
        return taken;
    }
    /// As long as the rows before it.
    void add_row(std::span<const double> row) {
        cols = row.size();
        values.insert(values.end(), row.begin(), row.end());
        ++rows;
    }
};

}  // namespace bemcal
