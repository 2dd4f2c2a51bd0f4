/// A posterior as samplers see it: a log density on the real space, some coordinates
/// whole numbers, evaluated for many points at once.
///
/// The parts of prior and likelihood stand apart, so that a chain can be tempered: its
/// density at inverse temperature t is prior + t likelihood.
#pragma once

#include "base/matrix.hpp"
#include "base/random.hpp"

#include <vector>

namespace bemcal::sampling {

/// Of k points.
struct Evaluations {
    std::vector<double> prior, likelihood;  ///< [k] logs; likelihood -inf = impossible
    Matrix prior_gradient, likelihood_gradient;  ///< [k x dimension]; 0 by whole numbers
};

/// Not shared by threads: it holds scratch. Each item makes its own.
class Density {
  public:
    virtual ~Density() = default;
    virtual std::size_t dimension() const = 0;
    /// [dimension] how many values a whole-number coordinate has: 0 ... n - 1; 0 for a
    /// real coordinate.
    virtual std::vector<int> levels() const { return std::vector<int>(dimension(), 0); }
    /// [dimension] whether a climb to a mode leaves it where it starts: the size of other
    /// coordinates, whose mode lies where all of them vanish, far from the density's
    /// mass.
    virtual std::vector<char> held_in_climb() const {
        return std::vector<char>(dimension(), 0);
    }
    /// How many points are best evaluated together.
    virtual std::size_t width() const { return 1; }
    /// A row's answer depends on that row only, bit for bit.
    /// \param points  [k x dimension]   \param gradients  whether they are wanted
    virtual void evaluate(const Matrix& points, bool gradients, Evaluations& out) = 0;
    /// A start, dispersed as the prior is.
    virtual std::vector<double> draw_start(Stream& random) const = 0;
};

}  // namespace bemcal::sampling
