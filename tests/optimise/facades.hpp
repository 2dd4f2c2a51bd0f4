/// A building of three facades held against readings of each: glazing and insulation of
/// every facade and one boiler from tables (3.4 million combinations), air change and
/// shading of every facade in ranges.
///
/// Given the boiler the facades do not know of each other, and air change and shading
/// enter one reading each; so the least of all is found by enumeration of 5 x 3 x 88
/// cases, though the whole cannot be enumerated. The readings are drawn by seed.
#pragma once

#include "optimise/functions.hpp"

namespace bemcal::test {

class Facades {
  public:
    static constexpr std::size_t n_facades = 3;
    static constexpr std::size_t n_glazings = Facade::u_value.size(),
                                 n_walls = Facade::thickness.size(),
                                 n_boilers = Facade::boiler.size();

    explicit Facades(std::uint64_t seed) {
        Stream random(seed, 0x66616361, 0);
        for (Readings& readings : measured_)
            readings = {15 + 8 * random.uniform(), 6 + 5 * random.uniform(),
                        7 + 5 * random.uniform()};
    }

    /// The glazing and the wall of each facade, the boiler, then air and shading of each.
    static std::vector<optimise::Variable> variables() {
        std::vector<optimise::Variable> variables;
        for (std::size_t f = 0; f < n_facades; ++f) {
            variables.push_back(one_of(n_glazings));
            variables.push_back(one_of(n_walls));
        }
        variables.push_back(one_of(n_boilers));
        for (std::size_t f = 0; f < n_facades; ++f) {
            variables.push_back({Facade::least_air, Facade::most_air});
            variables.push_back({0, 1});
        }
        return variables;
    }
    double value(std::span<const double> x) const {
        double sum = 0;
        const std::size_t boiler = 2 * n_facades;
        for (std::size_t f = 0; f < n_facades; ++f) {
            const std::size_t air = boiler + 1 + 2 * f;
            sum += value_of(f, {level(x[2 * f]), level(x[2 * f + 1]), level(x[boiler])},
                            x[air], x[air + 1]);
        }
        return sum;
    }
    double least() const {
        double least = infinity;
        for (std::size_t boiler = 0; boiler < n_boilers; ++boiler) {
            double sum = 0;
            for (std::size_t f = 0; f < n_facades; ++f) sum += least_of(f, boiler);
            least = std::min(least, sum);
        }
        return least;
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Readings {
        double loss = 0, gain = 0, fuel = 0;
    };
    struct Choice {
        std::size_t glazing, wall, boiler;
    };
    static std::size_t level(double x) { return static_cast<std::size_t>(x); }
    static double loss(const Choice& c, double air) {
        return 4 * Facade::u_value[c.glazing] + 0.4 / Facade::thickness[c.wall] + 6 * air;
    }
    static double gain(const Choice& c, double shading) {
        return 20 * Facade::g_value[c.glazing] * (1 - 0.3 * shading);
    }
    static double fuel(const Choice& c) {
        return (5 + Facade::u_value[c.glazing] + 0.1 / Facade::thickness[c.wall]) /
               Facade::boiler[c.boiler];
    }
    double value_of(std::size_t facade, const Choice& c, double air,
                    double shading) const {
        const Readings& readings = measured_[facade];
        return std::pow(loss(c, air) - readings.loss, 2) +
               std::pow(gain(c, shading) - readings.gain, 2) +
               4 * std::pow(fuel(c) - readings.fuel, 2);
    }
    double least_of(std::size_t facade, std::size_t boiler) const {
        double least = infinity;
        for (std::size_t glazing = 0; glazing < n_glazings; ++glazing)
            for (std::size_t wall = 0; wall < n_walls; ++wall) {
                const Choice c{glazing, wall, boiler};
                const double air = (measured_[facade].loss - loss(c, 0)) / 6;
                const double shading = (1 - measured_[facade].gain / gain(c, 0)) / 0.3;
                least = std::min(
                    least, value_of(facade, c,
                                    std::clamp(air, Facade::least_air, Facade::most_air),
                                    std::clamp(shading, 0.0, 1.0)));
            }
        return least;
    }

    std::array<Readings, n_facades> measured_;
};

inline Problem facades(std::uint64_t seed) {
    const Facades made(seed);
    return {"facades", Facades::variables(),
            [made](std::span<const double> x) { return made.value(x); }, made.least()};
}

}  // namespace bemcal::test
