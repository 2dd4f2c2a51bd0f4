/// From the real line, where chains move, to a likelihood's arguments; with the priors.
#pragma once

#include "base/random.hpp"
#include "emulator/model.hpp"

namespace bemcal::emulator {

/// A parameter that is not fixed.
enum class Role { t, correlation, precision, plain };
struct Coordinate {
    Role role;
    std::size_t argument;  ///< its place in the likelihood's arguments
    stats::Prior prior;
    stats::PriorDensity density;
    bool is_flat = false;  ///< the mean's coefficients: no prior
};

class Coordinates {
  public:
    /// Throws std::invalid_argument where a prior is not possible for its parameter.
    Coordinates(const Layout& layout, const Priors& priors);

    std::size_t size() const { return free_.size(); }
    const std::vector<Coordinate>& free() const { return free_; }

    /// The log prior with the logarithm of the Jacobian.
    /// \param u  [size()]   \param arguments  [layout.size()]
    /// \param slopes  [size()] d argument / d u   \param gradient  [size()] of the answer
    double place(const double* u, double* arguments, double* slopes,
                 double* gradient) const;
    /// On the parameter's own scale: t from 0 to 1, rho, lambda, beta.
    double value(std::size_t k, double u) const;
    std::vector<double> draw(Stream& random) const;

  private:
    void add(Role role, std::size_t argument, const stats::Prior& prior,
             const char* what);
    Layout layout_;
    std::vector<double> fixed_;  ///< arguments, where no coordinate sets them
    std::vector<Coordinate> free_;
};

}  // namespace bemcal::emulator
