/// The true process at other points: first given the runs at theta, then given the
/// measurements; a conditional normal with the mean's coefficients at their values.
/// Source: textbook conditioning, with the Kronecker form of paper 1, eq. 11-12. Points
/// may lie off the grid; the joint covariance of many is slow.
#include "emulator/kronecker.hpp"
#include "emulator/process.hpp"

#include <utility>

namespace bemcal::emulator {

/// Y'w without the means: what the designs say of eta at theta and the grid's points.
void Kronecker::fill_eta_without_mean(const Process& process, double* out) const {
    for (std::size_t i = 0; i < grid_; ++i)
        out[i] = eta_[i] - sum_w_ * process.mean_of_eta(grid_x_.row(i));
}

/// eta at the points, given the runs. The answer's border: a row for each point, then
/// Y'w.
bool Kronecker::eliminate_between(const Process& process, double jitter, const Matrix& x,
                                  BorderedMatrix& matrix) {
    matrix.clear();
    for (std::size_t i = 0; i < grid_; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            matrix.row(i)[j] = process.correlation_eta(grid_x_.row(i), grid_x_.row(j));
        matrix.row(i)[i] += jitter;
    }
    for (std::size_t r = 0; r < x.rows; ++r) {
        for (std::size_t i = 0; i < grid_; ++i)
            matrix.border(r)[i] = process.correlation_eta(x.row(r), grid_x_.row(i));
        for (std::size_t c = 0; c <= r; ++c)
            matrix.corner(r, c) = process.correlation_eta(x.row(r), x.row(c));
    }
    fill_eta_without_mean(process, matrix.border(x.rows));
    return matrix.eliminate(Eliminate::forward, 1e-16).is_definite;
}

bool Kronecker::attempt_condition(const double* arguments, double jitter, const Matrix& x,
                                  Conditional& out) {
    const Process process(layout_, arguments);
    const Scales s = scales_of(arguments);
    BorderedMatrix between(grid_, x.rows + 1), matrix(n_, x.rows + 1);
    if (!eliminate_designs(s, jitter, Eliminate::forward) ||
        !eliminate_between(process, jitter, x, between))
        return false;
    fill_x_correlations(s, jitter);
    matrix.clear();
    fill_conditional(s, matrix);
    for (std::size_t i = 0; i < n_; ++i) {
        const auto at = grid_x_.row(point_[i]);
        matrix.border(x.rows)[i] =
            measured_[i] -
            s.regression * (eta_[point_[i]] + (1 - sum_w_) * process.mean_of_eta(at)) -
            process.mean_of_delta(x_of_measured_.row(i));
    }
    const double variance = s.regression * s.regression / s.lambda_eta;
    std::vector<double> means(x.rows);
    for (std::size_t r = 0; r < x.rows; ++r) {
        means[r] = process.mean(x.row(r)) - s.regression * between.schur(x.rows, r);
        for (std::size_t i = 0; i < n_; ++i)
            matrix.border(r)[i] =
                variance * s_ *
                    process.correlation_eta(x.row(r), grid_x_.row(point_[i])) +
                s.variance_delta *
                    process.correlation_delta(x.row(r), x_of_measured_.row(i));
        for (std::size_t c = 0; c <= r; ++c)
            matrix.corner(r, c) =
                variance * (s_ * process.correlation_eta(x.row(r), x.row(c)) +
                            (1 - s_) * between.schur(r, c)) +
                s.variance_delta * process.correlation_delta(x.row(r), x.row(c));
    }
    if (!matrix.eliminate(Eliminate::forward, least_pivot_of_measurements(s)).is_definite)
        return false;
    out = conditional_of(matrix, std::move(means));
    return true;
}

}  // namespace bemcal::emulator
