/// The memory of a bordered elimination, filled up with the identity to whole blocks.
/// Plain bookkeeping; the arithmetic is elimination's. There is no pivoting: a matrix
/// that is not positive definite is reported, and mended by the caller.
#include "emulator/bordered_matrix.hpp"

namespace bemcal::emulator {

namespace {

std::size_t whole(std::size_t n, std::size_t block) {
    return (n + block - 1) / block * block;
}

}  // namespace

BorderedMatrix::BorderedMatrix(std::size_t n, std::size_t n_border)
    : n_(n),
      n_border_(n_border),
      n_pivot_(whole(n, row_block)),
      n_rows_(n_pivot_ + whole(n_border, row_block)),
      stride_(whole(n_rows_ + row_block, column_block)),
      values_(n_rows_ * stride_, 1),
      panel_(column_block * stride_, 1),
      whitened_((n_rows_ - n_pivot_) * n_pivot_, 1) {}

void BorderedMatrix::clear() {
    values_.clear();
    for (std::size_t i = n_; i < n_pivot_; ++i) row(i)[i] = 1;
}

Eliminated BorderedMatrix::eliminate(Eliminate what, double least_pivot) {
    return emulator::eliminate(
        {values_.data(), stride_, n_pivot_, n_rows_, panel_.data(), whitened_.data()},
        what, least_pivot);
}

}  // namespace bemcal::emulator
