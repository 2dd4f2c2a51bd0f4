/// The posterior of a Kennedy-O'Hagan calibration as samplers see it: eq. 13 on the real
/// line.
#pragma once

#include "emulator/coordinates.hpp"
#include "emulator/likelihood.hpp"
#include "sampling/density.hpp"

#include <memory>

namespace bemcal::emulator {

class KohDensity : public sampling::Density {
  public:
    /// Throws std::invalid_argument for data or priors that do not fit.
    KohDensity(const Standardised& data, const ModelOptions& options);

    std::size_t dimension() const override { return coordinates_.size(); }
    void evaluate(const Matrix& points, bool gradients,
                  sampling::Evaluations& out) override;
    std::vector<double> draw_start(Stream& random) const override;

    /// [dimension()] the calibrated inputs by their names, rho_eta_<input>, ...,
    /// rho_delta_<input>, ..., lambda_eta, lambda_delta, lambda_e, rho, beta_eta_...,
    /// beta_delta_..., without those that are fixed or integrated out.
    std::vector<std::string> names() const;
    /// [dimension()] calibrated inputs in physical units, the others as their priors are.
    std::vector<double> values(std::span<const double> point) const;

    const Standardised& data() const { return data_; }
    const Layout& layout() const { return likelihood_->layout(); }
    const Coordinates& coordinates() const { return coordinates_; }
    Likelihood& likelihood() { return *likelihood_; }
    bool is_kronecker() const { return likelihood_->is_kronecker(); }
    /// How often the covariance was not positive definite as it stood.
    const JitterReport& jitter() const { return likelihood_->jitter(); }

  private:
    Standardised data_;
    Coordinates coordinates_;
    std::unique_ptr<Likelihood> likelihood_;
    std::vector<double> arguments_, slopes_, prior_gradient_, gradient_;
};

}  // namespace bemcal::emulator
