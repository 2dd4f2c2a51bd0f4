/// A matrix as its rows, its columns and its values.
/// Plain bookkeeping without a source. What is not whole is not looked for: rounds are
/// packed and taken by the same stage.
#include "study/packed_matrix.hpp"

#include <algorithm>

namespace bemcal::study {

void pack(const Matrix& matrix, std::vector<double>& packed) {
    packed.push_back(static_cast<double>(matrix.rows));
    packed.push_back(static_cast<double>(matrix.cols));
    packed.insert(packed.end(), matrix.values.begin(), matrix.values.end());
}

Matrix take_matrix(std::span<const double>& packed) {
    Matrix matrix(static_cast<std::size_t>(packed[0]),
                  static_cast<std::size_t>(packed[1]));
    packed = packed.subspan(2);
    std::ranges::copy(packed.first(matrix.values.size()), matrix.values.begin());
    packed = packed.subspan(matrix.values.size());
    return matrix;
}

}  // namespace bemcal::study
