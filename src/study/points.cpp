/// Maps samples of the unit cube linearly onto the parameters' ranges; gives nominal
/// points and parts of a matrix.
/// Follows from uniform sampling: priors and discrete values are left out.
/// The samples come from `sobol_sequence` and `saltelli`.
#include "study/points.hpp"

#include <algorithm>

namespace bemcal::study {

Matrix in_ranges(Matrix unit, std::span<const physics::Parameter> parameters) {
    for (std::size_t r = 0; r < unit.rows; ++r)
        for (std::size_t k = 0; k < unit.cols; ++k)
            unit(r, k) = parameters[k].least +
                         (parameters[k].most - parameters[k].least) * unit(r, k);
    return unit;
}

double on_scale(double value, const physics::Parameter& parameter) {
    return (value - parameter.least) / (parameter.most - parameter.least);
}

std::vector<double> nominal_point(std::span<const physics::Parameter> parameters) {
    std::vector<double> point;
    for (const auto& parameter : parameters) point.push_back(parameter.nominal);
    return point;
}

Matrix nominal_points(std::span<const physics::Parameter> parameters, std::size_t n) {
    Matrix points(n, parameters.size());
    const std::vector<double> nominal = nominal_point(parameters);
    for (std::size_t r = 0; r < n; ++r) std::ranges::copy(nominal, points.row(r).begin());
    return points;
}

Matrix nominal_row(std::span<const physics::Parameter> parameters) {
    return nominal_points(parameters, 1);
}

Matrix part_of(const Matrix& matrix, std::size_t first, std::size_t n) {
    Matrix part(n, matrix.cols);
    std::copy_n(matrix.values.begin() + static_cast<std::ptrdiff_t>(first * matrix.cols),
                n * matrix.cols, part.values.begin());
    return part;
}

double end_of_range(double value, double least, double most) {
    const double near = 1e-3 * (most - least);
    if (value <= least + near) return -1;
    return value >= most - near ? 1 : 0;
}

}  // namespace bemcal::study
