/// Functions whose Sobol indices are known in closed form.
#pragma once

#include "base/matrix.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace bemcal::test {

/// Ishigami and Homma 1990 with a = 7, b = 0.1, of a point in [0, 1)^3.
inline double ishigami(std::span<const double> u) {
    const auto x = [&](int i) {
        return (2 * u[static_cast<std::size_t>(i)] - 1) * std::numbers::pi;
    };
    return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) +
           0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

/// Sobol's G function: the product of (|4 u_i - 2| + a_i) / (1 + a_i).
inline double sobol_g(std::span<const double> u, const std::vector<double>& a) {
    double product = 1;
    for (std::size_t i = 0; i < a.size(); ++i)
        product *= (std::abs(4 * u[i] - 2) + a[i]) / (1 + a[i]);
    return product;
}

inline const std::vector<double> g8{0, 1, 4.5, 9, 99, 99, 99, 99};
inline const std::vector<double> g19{0,  0.5, 1,  2,  3,  4.5, 6,  9,  12, 20,
                                     30, 45,  60, 80, 99, 99,  99, 99, 99};

inline int dimension_of(const std::string& function) {
    if (function == "ishigami") return 3;
    return function == "sobolG8" ? 8 : 19;
}

inline std::vector<double> evaluate(const std::string& function, const Matrix& design) {
    std::vector<double> outputs;
    for (std::size_t r = 0; r < design.rows; ++r) {
        const auto u = design.row(r);
        outputs.push_back(function == "ishigami"
                              ? ishigami(u)
                              : sobol_g(u, function == "sobolG8" ? g8 : g19));
    }
    return outputs;
}

}  // namespace bemcal::test
