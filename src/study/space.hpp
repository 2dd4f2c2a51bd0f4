/// The unknowns of a posterior: each with its prior, on the whole real line for the
/// sampler, in its own unit for everybody else. Fixed ones have a value and no
/// coordinate; discrete ones have a whole number.
#pragma once

#include "base/random.hpp"
#include "stats/prior.hpp"
#include "study/step_share.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

struct Coordinate {
    std::string name, unit;
    stats::Prior prior;
    std::vector<double> values{};  ///< discrete: one of these, all alike; else empty
    /// The prior, without ends, is of the quotient by this one, which stands before: a
    /// standard deviation that is unknown, too.
    std::optional<std::size_t> in = std::nullopt;
    /// On the line this quotient times that power of the size: 1 is its own unit, which
    /// suits what readings tell well, 0 the quotient, which suits what they do not tell.
    double centring = 1;
    std::optional<StepShare> step = std::nullopt;  ///< its value; the prior is fixed
};

class Space {
  public:
    explicit Space(std::vector<Coordinate> coordinates);

    const std::vector<Coordinate>& coordinates() const { return coordinates_; }
    std::size_t size() const { return coordinates_.size(); }
    std::size_t n_free() const { return free_.size(); }
    /// Of the coordinate that is free number f.
    std::size_t index_of(std::size_t f) const { return free_[f]; }
    std::vector<int> levels() const;  ///< [n_free] see sampling::Density
    std::vector<char> sizes() const;  ///< [n_free] whether priors of others are in it

    /// \param position  [n_free]   \param values  [size] in their units
    void read(std::span<const double> position, std::span<double> values) const;
    /// From d objective / d value to d objective / d position; 0 for discrete ones.
    /// \param by_value  [size]   \param by_position  [n_free], written
    void pull_back(std::span<const double> position, std::span<const double> by_value,
                   std::span<double> by_position) const;
    /// Log prior density of the position (Jacobian included); adds its gradient.
    double log_prior(std::span<const double> position, std::span<double> gradient) const;
    /// A position for values. [size] -> [n_free]
    std::vector<double> position_of(std::span<const double> values) const;
    std::vector<double> draw_position(Stream& random) const;

  private:
    stats::Mapped mapped(std::span<const double> position, std::size_t f) const;
    double log_prior_in(std::size_t size, std::span<const double> position, std::size_t f,
                        std::span<double> gradient) const;

    std::vector<Coordinate> coordinates_;
    std::vector<stats::PriorDensity> densities_;  ///< [size]; of discrete ones unused
    std::vector<std::size_t> free_;
    std::vector<std::size_t> place_;  ///< [size] of the free ones in a position
};

}  // namespace bemcal::study
