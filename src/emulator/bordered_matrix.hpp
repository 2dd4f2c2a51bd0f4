/// The memory of an elimination, filled up to whole blocks, and its answers by name.
#pragma once

#include "base/lane_array.hpp"
#include "emulator/elimination.hpp"

namespace bemcal::emulator {

class BorderedMatrix {
  public:
    BorderedMatrix() = default;
    /// K is [n x n], R is [n_border x n].
    BorderedMatrix(std::size_t n, std::size_t n_border);

    std::size_t size() const { return n_; }
    std::size_t n_border() const { return n_border_; }

    /// Everything 0, and the identity where K is filled up.
    void clear();
    /// Row i of K: columns up to the diagonal count.
    double* row(std::size_t i) { return values_.data() + i * stride_; }
    double* border(std::size_t r) { return row(n_pivot_ + r); }  ///< row r of R
    double& corner(std::size_t r, std::size_t s) { return border(r)[n_pivot_ + s]; }

    Eliminated eliminate(Eliminate what, double least_pivot);

    /// R L^-T, after either elimination. [size(), 0 beyond]
    const double* whitened(std::size_t r) const {
        return whitened_.data() + r * n_pivot_;
    }
    /// S - R K^-1 R', for s <= r.
    double schur(std::size_t r, std::size_t s) const {
        return values_.data()[(n_pivot_ + r) * stride_ + n_pivot_ + s];
    }
    /// Rows of -K^-1 (up to the diagonal) and of -R K^-1, after a full elimination.
    const double* minus_inverse(std::size_t i) const {
        return values_.data() + i * stride_;
    }
    const double* minus_solution(std::size_t r) const {
        return values_.data() + (n_pivot_ + r) * stride_;
    }

  private:
    std::size_t n_ = 0, n_border_ = 0, n_pivot_ = 0, n_rows_ = 0, stride_ = 0;
    LaneArray values_, panel_, whitened_;
};

}  // namespace bemcal::emulator
