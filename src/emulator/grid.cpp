/// Whether runs are a full grid: every design at the same points, in any order, and all
/// measurements among these.
/// Plain search without a source. Inputs within 1e-8 of their range are the same. A grid
/// with a hole is none; then the dense form is used.
#include "emulator/grid.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::emulator {

namespace {

bool is_same(std::span<const double> a, std::span<const double> b, double tolerance) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (!(std::abs(a[k] - b[k]) <= tolerance)) return false;
    return true;
}

Matrix chosen(const Matrix& rows, const std::vector<std::size_t>& which) {
    Matrix made(which.size(), rows.cols);
    for (std::size_t i = 0; i < which.size(); ++i)
        std::ranges::copy(rows.row(which[i]), made.row(i).begin());
    return made;
}

/// The first of the rows that is the same as a point, looked for from a guess on; their
/// number = none.
std::size_t find_row(const Matrix& rows, std::span<const double> point, double tolerance,
                     std::size_t guess) {
    for (std::size_t step = 0; step < rows.rows; ++step) {
        const std::size_t i = (guess + step) % rows.rows;
        if (is_same(rows.row(i), point, tolerance)) return i;
    }
    return rows.rows;
}

/// Rows that no earlier row is the same as.
Matrix distinct(const Matrix& rows, double tolerance) {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < rows.rows; ++i)
        if (std::ranges::none_of(first, [&](std::size_t j) {
                return is_same(rows.row(i), rows.row(j), tolerance);
            }))
            first.push_back(i);
    return chosen(rows, first);
}

}  // namespace

std::optional<Grid> find_grid(const Observations& o, double tolerance) {
    Grid grid{distinct(o.simulated_t, tolerance), {}, {}, {}};
    const std::size_t m = o.simulated.size(), designs = grid.t.rows;
    if (m % designs != 0) return {};
    grid.x = distinct(o.simulated_x, tolerance);
    if (grid.x.rows != m / designs) return {};
    grid.output = Matrix(designs, grid.x.rows, std::nan(""));
    for (std::size_t i = 0, a = 0, j = 0; i < m; ++i, ++j) {
        a = find_row(grid.t, o.simulated_t.row(i), tolerance, a);
        j = find_row(grid.x, o.simulated_x.row(i), tolerance, j);
        grid.output(a, j) = o.simulated[i];
    }
    for (const double y : grid.output.values)
        if (std::isnan(y)) return {};
    for (std::size_t i = 0, j = 0; i < o.measured.size(); ++i, ++j) {
        j = find_row(grid.x, o.measured_x.row(i), tolerance, j);
        if (j == grid.x.rows) return {};
        grid.of_measured.push_back(j);
    }
    return grid;
}

}  // namespace bemcal::emulator
