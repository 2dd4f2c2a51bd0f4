/// Generalised least squares of the means' coefficients with a flat prior: their mean,
/// inverse precision, and what integrating them out adds to the log likelihood.
/// Source: Rasmussen and Williams 2006, eq. 2.42-2.45. Given coefficients count as
/// certain; normal priors are left out.
#include "emulator/mean_coefficients.hpp"

#include <algorithm>
#include <limits>

namespace bemcal::emulator {

namespace {

double largest_diagonal(const Matrix& m) {
    double most = 0;
    for (std::size_t a = 0; a < m.rows; ++a) most = std::max(most, m(a, a));
    return most;
}

}  // namespace

bool MeanCoefficients::solve(const double* given_beta) {
    const std::size_t k = size();
    if (k == 0) return true;
    inverse = Matrix(k, k);
    if (given_) {
        std::copy_n(given_beta, k, beta.begin());
        return true;
    }
    work_.clear();
    for (std::size_t a = 0; a < k; ++a) {
        std::copy_n(precision.row(a).data(), a + 1, work_.row(a));
        work_.border(0)[a] = right_side[a];
    }
    const double least = std::numeric_limits<double>::epsilon() * static_cast<double>(k) *
                         largest_diagonal(precision);
    const Eliminated done = work_.eliminate(Eliminate::fully, least);
    if (!done.is_definite) return false;
    log_determinant_ = done.log_determinant;
    for (std::size_t a = 0; a < k; ++a) {
        beta[a] = -work_.minus_solution(0)[a];
        for (std::size_t b = 0; b <= a; ++b)
            inverse(a, b) = inverse(b, a) = -work_.minus_inverse(a)[b];
    }
    return true;
}

double MeanCoefficients::log_likelihood() const {
    double linear = 0, square = 0;
    for (std::size_t a = 0; a < size(); ++a) {
        linear += beta[a] * right_side[a];
        for (std::size_t b = 0; b < size(); ++b)
            square += beta[a] * precision(a, b) * beta[b];
    }
    return linear - square / 2 - (given_ ? 0 : log_determinant_ / 2);
}

void MeanCoefficients::times_inverse(const Matrix& rows, Matrix& out) const {
    std::ranges::fill(out.values, 0.0);
    for (std::size_t a = 0; a < size(); ++a)
        for (std::size_t b = 0; b < size(); ++b)
            for (std::size_t i = 0; i < rows.cols; ++i)
                out(a, i) += inverse(a, b) * rows(b, i);
}

}  // namespace bemcal::emulator
