/// The unknowns of a posterior: each with its prior, on the whole real line for the
/// sampler, in its own unit for everybody else. Fixed ones have a value and no
/// coordinate; discrete ones have a whole number.
#pragma once

#include "base/random.hpp"
#include "stats/prior.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

struct Coordinate {
    std::string name, unit;
    stats::Prior prior;
    std::vector<double> values{};  ///< discrete: one of these, all alike; else empty
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

    /// \param position  [n_free]   \param values  [size] in their units
    void read(std::span<const double> position, std::span<double> values) const;
    /// d value / d position of the free ones; 0 for discrete ones. \param slopes [n_free]
    void slopes(std::span<const double> position, std::span<double> slopes) const;
    /// Log prior density of the position (Jacobian included); adds its gradient.
    double log_prior(std::span<const double> position, std::span<double> gradient) const;
    /// A position for values. [size] -> [n_free]
    std::vector<double> position_of(std::span<const double> values) const;
    std::vector<double> draw_position(Stream& random) const;

  private:
    std::vector<Coordinate> coordinates_;
    std::vector<stats::PriorDensity> densities_;  ///< [size]; of discrete ones unused
    std::vector<std::size_t> free_;
};

}  // namespace bemcal::study
