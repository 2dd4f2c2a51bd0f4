/// Eq. 11-12 with every pair of rows, runs first, then measurements.
#pragma once

#include "emulator/likelihood.hpp"
#include "emulator/mean_coefficients.hpp"
#include "emulator/points.hpp"

namespace bemcal::emulator {

class Dense : public Likelihood {
  public:
    Dense(const Observations& standardised, const Layout& layout);
    bool is_kronecker() const override { return false; }

  protected:
    bool attempt(const double* arguments, double jitter, double* gradient,
                 double& value) override;
    bool attempt_condition(const double* arguments, double jitter, const Matrix& x,
                           Conditional& out) override;

  private:
    /// The arguments on the scale the covariance needs.
    struct Scales {
        double variance_eta, variance_delta, variance_e, regression;
        const double *rates_eta, *rates_delta;
    };
    Scales scales_of(const double* arguments) const;
    /// rho for a measurement's row, 1 for a run's.
    double factor(std::size_t row, const Scales& s) const {
        return row < m_ ? 1 : s.regression;
    }
    double least_pivot(const Scales& s) const;
    void place_measurements(const double* t);
    void fill_covariance(const Scales& s, double jitter, BorderedMatrix& matrix);
    void fill_border(const Scales& s);
    bool solve_coefficients(const double* arguments);
    double value_of(const Eliminated& done) const;
    void fill_alpha();
    void fill_gradient(const Scales& s, double* gradient);
    void fill_weights(std::size_t row);
    void add_process_row(std::size_t row, const Scales& s, double* gradient);
    void add_noise_row(std::size_t row, const Scales& s, double* gradient);
    void add_mean_gradient(double* gradient);
    void fill_residuals(const double* arguments, double* out) const;
    void fill_covariance_with(std::span<const double> point, const Scales& s,
                              double* out);

    std::size_t m_, n_;               ///< runs, measurements
    std::vector<double> outputs_;     ///< [m + n]
    Points points_;                   ///< [m + n] of x, then t
    Points measured_;                 ///< [n] of x
    Matrix basis_eta_, basis_delta_;  ///< [coefficients x m + n], [.. x n]
    BorderedMatrix matrix_;
    Matrix correlations_, slow_;  ///< of eta [m + n x .], of delta [n x .]
    MeanCoefficients mean_;
    std::vector<double> alpha_;    ///< K^-1 (z - H beta)
    Matrix solutions_, weighted_;  ///< H'K^-1, Q^-1 H'K^-1 [coefficients x m + n]
    std::vector<double> weights_, products_;  ///< of one row
};

}  // namespace bemcal::emulator
