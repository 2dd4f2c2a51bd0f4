/// How the unknowns of several buildings hang together: where in a sampler's position a
/// building's own unknowns stand, and what their prior is.
///
/// full: all buildings have the same. partial: building b's unknown lies at u_b on the
/// real line, drawn from a population N(mu, tau^2); mu has the unknown's prior, tau a
/// lognormal one (median 0.3, sd of the logarithm 0.7: by a logit, a few per cent to half
/// of the range), which keeps it off 0. The position is mu, log tau, u_1, u_2, ...
/// Discrete unknowns are the same for all.
#pragma once

#include "posterior/posterior_options.hpp"
#include "study/space.hpp"

#include <memory>

namespace bemcal::posterior {

class Arrangement {
  public:
    virtual ~Arrangement() = default;
    virtual std::size_t dimension() const = 0;
    virtual std::vector<int> levels() const = 0;
    virtual std::vector<char> held_in_climb() const {
        return std::vector<char>(dimension(), 0);
    }
    /// Adds the gradient. \param position, gradient  [dimension]
    virtual double log_prior(std::span<const double> position,
                             std::span<double> gradient) const = 0;
    virtual std::vector<double> draw_start(Stream& random) const = 0;
    /// The position of one building's unknowns in their space. [n_free]
    virtual void take(std::span<const double> position, std::size_t building,
                      std::span<double> own) const = 0;
    /// Adds d / d own to d / d position.
    virtual void give(std::span<const double> own_gradient, std::size_t building,
                      std::span<double> gradient) const = 0;
    /// Of a building that no data are known of.
    virtual void take_unseen(std::span<const double> position, Stream& random,
                             std::span<double> own) const = 0;
    /// Names and units of what is reported, and their values.
    virtual std::vector<study::Coordinate> reported() const = 0;
    virtual void read(std::span<const double> position,
                      std::span<double> values) const = 0;
    /// Which of the reported are one building's own unknowns in their space. [n_free]
    virtual std::vector<std::size_t> reported_of(std::size_t building) const = 0;
};

/// \param buildings  names
std::unique_ptr<Arrangement> make_arrangement(Pooling pooling,
                                              std::shared_ptr<const study::Space> space,
                                              std::vector<std::string> buildings);

}  // namespace bemcal::posterior
