/// A made-up simulator of two meters over 500 hours: sums of exponentials in four
/// parameters, bent in each of them.
#pragma once

#include "base/matrix.hpp"
#include "base/random.hpp"
#include "stats/sobol_sequence.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace bemcal::emulator::test {

constexpr std::size_t n_hours = 500;
constexpr std::size_t n_shown = 2 * n_hours;

/// [n_shown] \param x  [4] from 0 to 1
inline std::vector<double> exponentials(std::span<const double> x) {
    std::vector<double> made(n_shown);
    for (std::size_t h = 0; h < n_hours; ++h) {
        const double t = static_cast<double>(h) / n_hours;
        const double day = 1 + 0.5 * std::sin(0.2618 * static_cast<double>(h));
        const double decays = std::exp(-(1 + 4 * x[0]) * t) * (1 + x[1]) +
                              std::exp(-(0.2 + x[2]) * 3 * t) * day;
        made[h] = 10 * decays * std::exp(0.5 * x[3]);
        made[n_hours + h] = 3 + std::exp(x[1] * x[2]) * day + 2 * x[3] * x[3] * t;
    }
    return made;
}

inline Matrix simulated(const Matrix& points) {
    Matrix series(points.rows, n_shown);
    for (std::size_t i = 0; i < points.rows; ++i) {
        const std::vector<double> made = exponentials(points.row(i));
        std::copy(made.begin(), made.end(), series.row(i).begin());
    }
    return series;
}

inline Matrix design(std::size_t runs, std::size_t parameters = 4,
                     std::uint64_t seed = 1) {
    return stats::scrambled_sobol_points(0, runs, static_cast<int>(parameters), seed);
}

/// A reading's standard deviation is 0.1 of the first meter, 0.05 of the second.
inline std::vector<double> reading_weights() {
    std::vector<double> weights(n_shown, 10);
    std::fill(weights.begin() + n_hours, weights.end(), 20.0);
    return weights;
}

}  // namespace bemcal::emulator::test
