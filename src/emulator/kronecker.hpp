/// Eq. 12 where the runs are a grid: their covariance is K_t (x) K_x / lambda_eta.
///
/// The likelihood is that of the runs times that of the measurements given the runs. With
/// k the correlations of theta with the designs, w = K_t^-1 k and s = 1 - k'w, eta at the
/// grid's points and theta has the mean Y'w and the covariance s K_x / lambda_eta, given
/// the runs Y [designs x points], so that three small eliminations give everything:
///
///     designs:       K_t, with the rows k', Y' and 1'
///     grid:          K_x, with the rows (L_t^-1 Y), K_t^-1 Y (for the gradient) and H_x'
///     measurements:  rho^2 s K_x / lambda_eta + K_delta / lambda_delta + 1 / lambda_e,
///                    with the rows z - rho Y'w and (rho (1 - sum w) H_eta, H_delta)'
///
/// The mean H_x beta of eta takes part as 1 (H_x beta)' taken off Y.
#pragma once

#include "emulator/likelihood.hpp"
#include "emulator/mean_coefficients.hpp"
#include "emulator/points.hpp"

namespace bemcal::emulator {

class Process;

class Kronecker : public Likelihood {
  public:
    Kronecker(const Grid& grid, const Observations& standardised, const Layout& layout);
    bool is_kronecker() const override { return true; }

  protected:
    bool attempt(const double* arguments, double jitter, double* gradient,
                 double& value) override;
    bool attempt_condition(const double* arguments, double jitter, const Matrix& x,
                           Conditional& out) override;

  private:
    struct Scales {
        double lambda_eta, variance_delta, variance_e, regression;
        const double *t, *rates_x, *rates_t, *rates_delta;
    };
    Scales scales_of(const double* arguments) const;

    bool eliminate_designs(const Scales& s, double jitter, Eliminate what);
    bool eliminate_grid(const Scales& s, double jitter, Eliminate what);
    void fill_x_correlations(const Scales& s, double jitter);
    void fill_conditional(const Scales& s, BorderedMatrix& matrix);
    double least_pivot_of_measurements(const Scales& s) const;
    bool eliminate_measurements(const Scales& s, Eliminate what);
    bool solve_coefficients(const Scales& s, const double* arguments);
    double value_of(const Scales& s) const;

    // in kronecker_condition.cpp
    void fill_eta_without_mean(const Process& process, double* out) const;
    bool eliminate_between(const Process& process, double jitter, const Matrix& x,
                           BorderedMatrix& matrix);

    // the gradient, in kronecker_gradient.cpp
    struct Slopes;
    void fill_gradient(const Scales& s, double* gradient);
    void fill_solutions();
    void fill_measurement_weights();
    Slopes slopes_of(const Scales& s) const;
    void add_noise(const Scales& s, double* gradient);
    void add_grid(const Scales& s, double* gradient);
    void add_designs(const Scales& s, const Slopes& slopes, double* gradient);
    std::vector<double> through_designs(const std::vector<double>& x) const;
    std::vector<double> cross_products() const;
    double by_lambda_eta(const Scales& s, const Slopes& slopes) const;
    void add_coefficients(double* gradient) const;
    double output_without_mean(std::size_t design, std::size_t point) const {
        return output_(design, point) - mean_at_point_[point];
    }

    std::size_t designs_, grid_, n_;
    Matrix output_;                   ///< Y [designs x grid]
    std::vector<double> measured_;    ///< [n]
    std::vector<std::size_t> point_;  ///< [n] of the grid
    Matrix grid_x_, x_of_measured_;   ///< [grid x p], [n x p]
    Points t_, x_, measured_x_;
    Matrix basis_eta_, basis_delta_;  ///< [coefficients x grid], [.. x n]
    BorderedMatrix by_design_, by_point_, by_measurement_;
    Eliminated design_{}, point_done_{}, measurement_{};
    Matrix correlations_t_, correlations_x_, correlations_delta_;  ///< lower triangles
    std::vector<double> k_, w_, ones_;  ///< [designs] k, K_t^-1 k, K_t^-1 1
    double s_ = 0, sum_w_ = 0;          ///< 1 - k'w, 1'w
    std::vector<double> eta_;           ///< [grid] Y'w
    MeanCoefficients mean_;

    std::vector<double> mean_at_point_;  ///< [grid] H_x beta
    std::vector<double> alpha_;          ///< [n]
    Matrix weights_;                     ///< [n x n] d value / d C, both triangles
    Matrix solutions_, weighted_;        ///< H'C^-1, Q^-1 H'C^-1 [coefficients x n]
    Matrix whitened_;                    ///< L_t^-1 (Y - 1 mean') K_x^-1 [designs x grid]
    Matrix grid_weights_;                ///< [grid x grid] of K_x, lower triangle
    std::vector<double> row_;
};

}  // namespace bemcal::emulator
