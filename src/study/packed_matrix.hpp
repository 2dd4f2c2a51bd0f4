/// Matrices among the numbers that a round needs.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::study {

void pack(const Matrix& matrix, std::vector<double>& packed);

/// Takes the first off what is left.
Matrix take_matrix(std::span<const double>& packed);

}  // namespace bemcal::study
