/// A point of the sample space with what the density says of it.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

namespace bemcal::sampling {

struct Point {
    std::vector<double> x;
    double prior = 0, likelihood = 0;  ///< logs
    std::vector<double> prior_gradient, likelihood_gradient;

    Point() = default;
    explicit Point(std::size_t dimension)
        : x(dimension), prior_gradient(dimension), likelihood_gradient(dimension) {}

    /// -inf where prior or likelihood is not finite.
    double log_density(double inverse_temperature) const {
        if (!std::isfinite(prior) || !std::isfinite(likelihood))
            return -std::numeric_limits<double>::infinity();
        return prior + inverse_temperature * likelihood;
    }
};

}  // namespace bemcal::sampling
