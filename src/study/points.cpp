#include "study/points.hpp"

namespace bemcal::study {

Matrix in_ranges(Matrix unit, std::span<const physics::Parameter> parameters) {
    for (std::size_t r = 0; r < unit.rows; ++r)
        for (std::size_t k = 0; k < unit.cols; ++k)
            unit(r, k) = parameters[k].least +
                         (parameters[k].most - parameters[k].least) * unit(r, k);
    return unit;
}

std::vector<double> nominal_point(std::span<const physics::Parameter> parameters) {
    std::vector<double> point;
    for (const auto& parameter : parameters) point.push_back(parameter.nominal);
    return point;
}

Matrix nominal_row(std::span<const physics::Parameter> parameters) {
    Matrix row(1, parameters.size());
    row.values = nominal_point(parameters);
    return row;
}

}  // namespace bemcal::study
