/// The true process rho eta + delta before any data, and what an elimination says of it.
#pragma once

#include "emulator/bordered_matrix.hpp"
#include "emulator/likelihood.hpp"

namespace bemcal::emulator {

class Process {
  public:
    /// \param arguments  of a likelihood, with beta
    Process(const Layout& layout, const double* arguments);

    double mean_of_eta(std::span<const double> x) const;
    double mean_of_delta(std::span<const double> x) const;
    double mean(std::span<const double> x) const {
        return regression * mean_of_eta(x) + mean_of_delta(x);
    }
    /// exp(-sum ...) of eta's covariance at the same t, and of delta's.
    double correlation_eta(std::span<const double> a, std::span<const double> b) const;
    double correlation_delta(std::span<const double> a, std::span<const double> b) const;

    double regression, variance_eta, variance_delta, variance_e;

  private:
    const Layout& layout_;
    const double* arguments_;
};

/// \param matrix  eliminated; its border has a row for each point, then the data's
/// residuals   \param means  of the points, before the data; becomes the answer's
Conditional conditional_of(const BorderedMatrix& matrix, std::vector<double> means);

}  // namespace bemcal::emulator
