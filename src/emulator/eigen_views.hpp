/// Eigen's views of this project's matrices and vectors, without a copy. Included by
/// sources only: who uses the emulators needs no Eigen.
#pragma once

#include "base/matrix.hpp"

#include <span>

#include <Eigen/Core>

namespace bemcal::emulator {

using EigenRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline Eigen::Index eigen_index(std::size_t k) {
    return static_cast<Eigen::Index>(k);
}

inline Eigen::Map<const EigenRows> eigen_view(const Matrix& matrix) {
    return {matrix.values.data(), eigen_index(matrix.rows), eigen_index(matrix.cols)};
}
inline Eigen::Map<EigenRows> eigen_view(Matrix& matrix) {
    return {matrix.values.data(), eigen_index(matrix.rows), eigen_index(matrix.cols)};
}
inline Eigen::Map<const Eigen::VectorXd> eigen_view(std::span<const double> values) {
    return {values.data(), eigen_index(values.size())};
}
inline Eigen::Map<Eigen::VectorXd> eigen_view(std::span<double> values) {
    return {values.data(), eigen_index(values.size())};
}

}  // namespace bemcal::emulator
