/// What a calibration learns from, checked and without units: outputs by the runs' mean
/// and standard deviation, inputs from 0 to 1.
/// Source: paper 1, eq. 1-2; the scaling is usual practice. Missing values and repeated
/// runs are refused; nothing is mended or thinned here.
#include "emulator/runs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::emulator {

namespace {

void refuse(bool condition, const std::string& message) {
    if (condition) throw std::invalid_argument(message);
}

void check_shapes(const Observations& o) {
    refuse(o.measured.empty(), "no measurements");
    refuse(o.simulated.size() < 2,
           fmt::format("{} simulator runs: expected at least 2", o.simulated.size()));
    refuse(o.measured_x.rows != o.measured.size(),
           fmt::format("{} measurements, but {} rows of their inputs", o.measured.size(),
                       o.measured_x.rows));
    refuse(o.simulated_x.rows != o.simulated.size() ||
               o.simulated_t.rows != o.simulated.size(),
           fmt::format("{} simulated outputs, but {} and {} rows of their inputs x and t",
                       o.simulated.size(), o.simulated_x.rows, o.simulated_t.rows));
    refuse(o.measured_x.cols != o.simulated_x.cols,
           fmt::format("measurements have {} known inputs, simulator runs {}",
                       o.measured_x.cols, o.simulated_x.cols));
    refuse(o.measured_x.cols == 0, "no known inputs x: expected at least 1");
    refuse(o.simulated_t.cols == 0, "no calibrated inputs t: expected at least 1");
}

void check_finite(const std::vector<double>& values, std::size_t cols, const char* what) {
    for (std::size_t i = 0; i < values.size(); ++i)
        refuse(!std::isfinite(values[i]),
               fmt::format("{}: row {}, column {} is {}: expected a finite number", what,
                           i / cols + 1, i % cols + 1, values[i]));
}

void name_missing(std::vector<std::string>& names, std::size_t n, const char* prefix) {
    if (names.empty())
        for (std::size_t k = 0; k < n; ++k)
            names.push_back(fmt::format("{}{}", prefix, k + 1));
    refuse(names.size() != n,
           fmt::format("{} names for {} inputs {}", names.size(), n, prefix));
}

Scale mean_and_sd(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    refuse(!(squares > 0), "all simulated outputs are the same: nothing to calibrate by");
    return {mean, std::sqrt(squares / (n - 1))};
}

/// \param more  rows that count as well, or nullptr
std::vector<Scale> ranges(const Matrix& rows, const Matrix* more,
                          const std::vector<std::string>& names) {
    std::vector<Scale> scales;
    scales.reserve(rows.cols);
    for (std::size_t k = 0; k < rows.cols; ++k) {
        double least = rows(0, k), most = least;
        for (const Matrix* matrix : {&rows, more})
            for (std::size_t i = 0; matrix != nullptr && i < matrix->rows; ++i) {
                least = std::min(least, (*matrix)(i, k));
                most = std::max(most, (*matrix)(i, k));
            }
        refuse(!(most > least),
               fmt::format("input {} is {} everywhere: leave it out", names[k], least));
        scales.push_back({least, most - least});
    }
    return scales;
}

int compare(std::span<const double> a, std::span<const double> b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

void check_repetition(const Observations& o) {
    const auto order = [&](std::size_t i, std::size_t j) {
        const int by_t = compare(o.simulated_t.row(i), o.simulated_t.row(j));
        return by_t != 0 ? by_t : compare(o.simulated_x.row(i), o.simulated_x.row(j));
    };
    std::vector<std::size_t> rows(o.simulated.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t i, std::size_t j) { return order(i, j) < 0; });
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const std::size_t i = rows[k - 1], j = rows[k];
        if (order(i, j) != 0) continue;
        const bool differ = o.simulated[i] != o.simulated[j];
        throw std::invalid_argument(fmt::format(
            "simulator runs {} and {} are at the same point, with {}: leave one out",
            i + 1, j + 1,
            differ ? fmt::format("different answers ({} and {})", o.simulated[i],
                                 o.simulated[j])
                   : "the same answer"));
    }
}

}  // namespace

Matrix scaled_rows(const Matrix& x, const std::vector<Scale>& scales) {
    Matrix scaled = x;
    for (std::size_t i = 0; i < x.rows; ++i)
        for (std::size_t k = 0; k < x.cols; ++k) scaled(i, k) = scales[k].scaled(x(i, k));
    return scaled;
}

Standardised standardise(const Observations& observations) {
    check_shapes(observations);
    Standardised made{observations, {}, {}, {}};
    Observations& o = made.data;
    check_finite(o.measured, 1, "measurements");
    check_finite(o.measured_x.values, o.measured_x.cols, "inputs of the measurements");
    check_finite(o.simulated, 1, "simulated outputs");
    check_finite(o.simulated_x.values, o.simulated_x.cols, "known inputs of the runs");
    check_finite(o.simulated_t.values, o.simulated_t.cols,
                 "calibrated inputs of the runs");
    name_missing(o.x_names, o.measured_x.cols, "x");
    name_missing(o.t_names, o.simulated_t.cols, "t");
    check_repetition(o);
    made.output = mean_and_sd(o.simulated);
    made.x = ranges(o.measured_x, &o.simulated_x, o.x_names);
    made.t = ranges(o.simulated_t, nullptr, o.t_names);
    for (double& y : o.measured) y = made.output.scaled(y);
    for (double& y : o.simulated) y = made.output.scaled(y);
    o.measured_x = scaled_rows(o.measured_x, made.x);
    o.simulated_x = scaled_rows(o.simulated_x, made.x);
    o.simulated_t = scaled_rows(o.simulated_t, made.t);
    return made;
}

}  // namespace bemcal::emulator
