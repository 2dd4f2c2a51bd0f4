/// Points of a driver, or of two, at which a function has its values, and how it goes on
/// between them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::functions {

struct Points {
    enum class Kind {
        one,             ///< the constant, which follows nothing
        hours,           ///< 24 of working days, of Saturdays, of Sundays
        hours_from,      ///< the same from the one knot on; 0 before it
        knots,           ///< straight between knots, level beyond the ends
        hours_at_knots,  ///< 24 of working days, 24 of other days, at each of the knots
        fortnights       ///< of years from 0 on: level in each, then as `wandering` says
    };
    Kind kind = Kind::one;
    std::vector<double> knots{};   ///< [>= 2] rising; of Kind::hours_from one
    std::size_t n_fortnights = 0;  ///< of Kind::fortnights

    std::size_t size() const;

    /// Weights of points at a step: at most two points, weights sum to 1, or to 0 where
    /// the function is 0.
    struct Weights {
        std::array<std::size_t, 2> point{};
        std::array<double, 2> weight{1, 0};
    };
    /// \param drivers  of a step: hours 0 to 71, or 0 to 47; years
    Weights weights(std::span<const double> drivers) const;

    /// Where the drivers are at each point. [drivers][size()]; empty of the constant, of
    /// Kind::hours_from the hours alone
    std::vector<std::vector<double>> drivers_at() const;
};

inline constexpr std::size_t hours_of_day = 24;
inline constexpr double fortnights_of_year = 365.25 / 14;

/// A function with these values at the points. [steps]
/// \param values   [points.size()]
/// \param drivers  [n_drivers][steps]
std::vector<double> function_over(const Points& points, std::span<const double> values,
                                  const std::vector<std::vector<double>>& drivers);

}  // namespace bemcal::functions
