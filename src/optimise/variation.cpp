/// The random operators of NSGA-II on bounded variables: simulated binary crossover and
/// polynomial mutation; of tables, a swap and any value.
/// Source: Deb and Agrawal 1995, as in Deb's code nsga2-gnuplot 1.1.6. The paper's binary
/// coding is left out.
#include "optimise/variation.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::optimise {
namespace {

constexpr double least_distance = 1e-14;  ///< parents so close are not crossed

/// How far the children lie from the middle, in half distances of the parents, where
/// `room` (of the same unit, >= 1) is left up to the nearer bound.
double spread(double u, double room, double index) {
    const double alpha = 2 - std::pow(room, -(index + 1));
    const double exponent = 1 / (index + 1);
    return u <= 1 / alpha ? std::pow(u * alpha, exponent)
                          : std::pow(1 / (2 - u * alpha), exponent);
}

/// Both children in [0, 1], the smaller first.
std::pair<double, double> cross_numbers(double low, double high, double index,
                                        Stream& random) {
    const double u = random.uniform(), between = high - low, middle = (low + high) / 2;
    const double down = spread(u, 1 + 2 * low / between, index);
    const double up = spread(u, 1 + 2 * (1 - high) / between, index);
    return {std::clamp(middle - down * between / 2, 0.0, 1.0),
            std::clamp(middle + up * between / 2, 0.0, 1.0)};
}

double mutated_number(double x, double index, Stream& random) {
    const double u = random.uniform(), exponent = 1 / (index + 1);
    const double far = std::pow(u < 0.5 ? 1 - x : x, index + 1);
    const double step = u < 0.5
                            ? std::pow(2 * u + (1 - 2 * u) * far, exponent) - 1
                            : 1 - std::pow(2 * (1 - u) + 2 * (u - 0.5) * far, exponent);
    return std::clamp(x + step, 0.0, 1.0);
}

}  // namespace

std::pair<Position, Position> cross(const Space& space, const Nsga2Options& options,
                                    const Position& mother, const Position& father,
                                    Stream& random) {
    std::pair<Position, Position> children{mother, father};
    if (random.uniform() > options.crossover_chance) return children;
    for (std::size_t k = 0; k < space.size(); ++k) {
        if (random.uniform() > 0.5) continue;
        double &a = children.first[k], &b = children.second[k];
        if (!space.is_discrete(k) && std::abs(a - b) > least_distance) {
            const auto [low, high] = cross_numbers(std::min(a, b), std::max(a, b),
                                                   options.crossover_index, random);
            a = low;
            b = high;
        }
        if (random.uniform() <= 0.5) std::swap(a, b);
    }
    return children;
}

Position mutated(const Space& space, const Nsga2Options& options, Position position,
                 Stream& random) {
    const double chance = options.mutation_chance > 0
                              ? options.mutation_chance
                              : 1 / static_cast<double>(space.size());
    for (std::size_t k = 0; k < space.size(); ++k) {
        if (random.uniform() > chance) continue;
        double& x = position[k];
        x = space.is_discrete(k)
                ? random.below(static_cast<std::uint32_t>(space.highest(k)) + 1)
                : mutated_number(x, options.mutation_index, random);
    }
    return position;
}

}  // namespace bemcal::optimise
