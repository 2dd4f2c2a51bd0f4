/// Points by columns, as the correlations read them: some fixed, some that move.
#pragma once

#include "base/lane_array.hpp"
#include "base/matrix.hpp"
#include "emulator/correlation.hpp"

namespace bemcal::emulator {

class Points {
  public:
    Points() = default;
    Points(std::size_t n, std::size_t dimension)
        : n_(n),
          dimension_(dimension),
          stride_((n + 3) / 4 * 4),
          values_(stride_ * dimension, 1) {}
    explicit Points(const Matrix& rows) : Points(rows.rows, rows.cols) {
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t k = 0; k < dimension_; ++k) at(i, k) = rows(i, k);
    }

    std::size_t size() const { return n_; }
    double& at(std::size_t i, std::size_t k) { return values_.data()[k * stride_ + i]; }
    double at(std::size_t i, std::size_t k) const {
        return values_.data()[k * stride_ + i];
    }
    PointTable table() const { return {values_.data(), stride_, dimension_}; }

    /// Correlations of a point with these. \param out  [size(), up to a multiple of 4]
    void correlate(std::span<const double> point, const double* rates,
                   double* out) const {
        emulator::correlate(point.data(), 1, table(), n_, rates, out);
    }
    void add_squares(std::span<const double> point, const double* weights,
                     double* sums) const {
        add_weighted_squares(point.data(), 1, table(), n_, weights, sums);
    }
    /// Correlations of point i with the first n of these.
    void correlate_own(std::size_t i, std::size_t n, const double* rates,
                       double* out) const {
        emulator::correlate(values_.data() + i, stride_, table(), n, rates, out);
    }
    void add_own_squares(std::size_t i, std::size_t n, const double* weights,
                         double* sums) const {
        add_weighted_squares(values_.data() + i, stride_, table(), n, weights, sums);
    }

  private:
    std::size_t n_ = 0, dimension_ = 0, stride_ = 0;
    LaneArray values_;
};

}  // namespace bemcal::emulator
