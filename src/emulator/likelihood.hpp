/// The logarithm of eq. 12 with its gradient, and what measurements at other points would
/// be; beta integrated out or given (model.hpp). Constants of 2 pi are left out.
#pragma once

#include "base/matrix.hpp"
#include "emulator/grid.hpp"
#include "emulator/model.hpp"

#include <array>
#include <memory>

namespace bemcal::emulator {

/// What is added to the diagonal of a correlation matrix that is not positive definite in
/// doubles; tried in this order.
constexpr std::array<double, 4> jitter_steps{0, 1e-12, 1e-10, 1e-8};

/// How often each of them was needed.
struct JitterReport {
    std::array<std::size_t, jitter_steps.size()> n_with{};
    std::size_t n_failed = 0;  ///< not even with the last: the density is 0 there
};

/// The true process at some points: normal, given data and hyperparameters.
struct Conditional {
    std::vector<double> mean;
    Matrix covariance;
};

/// Given the hyperparameters; empty where there are no coefficients.
struct CoefficientPosterior {
    std::vector<double> mean;
    Matrix covariance;
};

class Likelihood {
  public:
    explicit Likelihood(const Layout& layout) : layout_(layout) {}
    virtual ~Likelihood() = default;
    const Layout& layout() const { return layout_; }
    virtual bool is_kronecker() const = 0;

    /// \param arguments  [layout().size()]; beta is read where it is sampled
    /// \param gradient  [layout().size()] or nullptr
    /// \returns -inf where the covariance is not positive definite
    double evaluate(const double* arguments, double* gradient);
    const JitterReport& jitter() const { return jitter_; }

    /// Of beta, integrated out, at the arguments.
    CoefficientPosterior coefficients(const double* arguments);
    /// \param x  [k x p] scaled   \param arguments  with beta
    /// Throws std::domain_error where the covariance is not positive definite.
    Conditional condition(const double* arguments, const Matrix& x);

  protected:
    /// One try; false where the covariance with this jitter is not positive definite.
    virtual bool attempt(const double* arguments, double jitter, double* gradient,
                         double& value) = 0;
    virtual bool attempt_condition(const double* arguments, double jitter,
                                   const Matrix& x, Conditional& out) = 0;

    Layout layout_;
    CoefficientPosterior coefficients_;  ///< of the last attempt

  private:
    JitterReport jitter_;
};

/// Every pair of rows: O((n + m)^3).
std::unique_ptr<Likelihood> make_dense(const Observations& standardised,
                                       const Layout& layout);
/// Runs on a grid: O(designs^3 + points^3 + n^3).
std::unique_ptr<Likelihood> make_kronecker(const Grid& grid,
                                           const Observations& standardised,
                                           const Layout& layout);

}  // namespace bemcal::emulator
