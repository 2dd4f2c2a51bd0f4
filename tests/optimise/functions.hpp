/// Functions whose minimum is known, for tests and benches of optimisers.
///
/// Optima lie off the middle of the ranges and off any mesh: Rastrigin's and Griewank's
/// functions are shifted by a draw of the seed.
#pragma once

#include "optimise/optimiser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace bemcal::test {

struct Problem {
    std::string name;
    std::vector<optimise::Variable> variables;
    std::function<double(std::span<const double>)> value;
    double least = 0;  ///< of the function
};

/// Rosenbrock 1960, the chained form; at d >= 4 it has a second minimum, near
/// (-1, 1, 1, ...). Minimum 0 at (1, 1, ...).
inline Problem rosenbrock(std::size_t d, std::uint64_t) {
    return {"rosenbrock", std::vector<optimise::Variable>(d, {-5, 10}),
            [](std::span<const double> x) {
                double sum = 0;
                for (std::size_t k = 0; k + 1 < x.size(); ++k)
                    sum +=
                        100 * std::pow(x[k + 1] - x[k] * x[k], 2) + std::pow(1 - x[k], 2);
                return sum;
            }};
}

/// In the middle two thirds of +-half_width.
inline std::vector<double> drawn_shift(std::size_t d, double half_width,
                                       std::uint64_t seed) {
    Stream random(seed, 0x73686966, 0);
    std::vector<double> shift(d);
    for (double& x : shift) x = half_width * (4 * random.uniform() - 2) / 3;
    return shift;
}

/// Rastrigin's function (Muehlenbein et al. 1991): about 11^d minima; least 0.
inline Problem rastrigin(std::size_t d, std::uint64_t seed) {
    return {"rastrigin", std::vector<optimise::Variable>(d, {-5.12, 5.12}),
            [shift = drawn_shift(d, 5.12, seed)](std::span<const double> x) {
                double sum = 0;
                for (std::size_t k = 0; k < x.size(); ++k) {
                    const double z = x[k] - shift[k];
                    sum += 10 + z * z - 10 * std::cos(2 * std::numbers::pi * z);
                }
                return sum;
            }};
}

/// Griewank 1981: thousands of shallow minima; least 0.
inline Problem griewank(std::size_t d, std::uint64_t seed) {
    return {"griewank", std::vector<optimise::Variable>(d, {-600, 600}),
            [shift = drawn_shift(d, 600, seed)](std::span<const double> x) {
                double sum = 0, product = 1;
                for (std::size_t k = 0; k < x.size(); ++k) {
                    const double z = x[k] - shift[k];
                    sum += z * z / 4000;
                    product *= std::cos(z / std::sqrt(static_cast<double>(k + 1)));
                }
                return 1 + sum - product;
            }};
}

/// A facade held against three readings: glazing, insulation and boiler from tables (440
/// combinations), air change and shading in ranges. Each of the two enters one reading
/// only, so that the best of every combination, and of all, is known by enumeration.
class Facade {
  public:
    static constexpr std::array<double, 11> u_value = {2.7, 1.1, 5.7, 1.4, 0.6, 2.9,
                                                       1.9, 0.8, 3.0, 1.3, 1.6};
    static constexpr std::array<double, 11> g_value = {0.76, 0.62, 0.87, 0.40, 0.50, 0.55,
                                                       0.70, 0.35, 0.30, 0.27, 0.64};
    static constexpr std::array<double, 8> thickness = {0.04, 0.06, 0.08, 0.10,
                                                        0.12, 0.16, 0.20, 0.30};
    static constexpr std::array<double, 5> boiler = {0.70, 0.81, 0.88, 0.94, 0.98};
    static constexpr double least_air = 0.3, most_air = 0.7;

    static double value(std::span<const double> x) {
        const Discrete d = discrete_of(x);
        const double loss = residual_of_loss(d, x[3]), gain = residual_of_gain(d, x[4]);
        return loss * loss + gain * gain + rest_of(d);
    }
    static double least() {
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < u_value.size(); ++a)
            for (std::size_t b = 0; b < thickness.size(); ++b)
                for (std::size_t c = 0; c < boiler.size(); ++c)
                    best = std::min(best, best_of({a, b, c}));
        return best;
    }

  private:
    struct Discrete {
        std::size_t glazing, wall, boiler;
    };
    static Discrete discrete_of(std::span<const double> x) {
        const auto level = [&](std::size_t k) { return static_cast<std::size_t>(x[k]); };
        return {level(0), level(1), level(2)};
    }
    static double loss_without_air(const Discrete& d) {
        return 4 * u_value[d.glazing] + 0.4 / thickness[d.wall] - 19.37;
    }
    static double residual_of_loss(const Discrete& d, double air) {
        return loss_without_air(d) + 6 * air;
    }
    static double residual_of_gain(const Discrete& d, double shading) {
        return 20 * g_value[d.glazing] * (1 - 0.3 * shading) - 8.11;
    }
    static double rest_of(const Discrete& d) {
        const double fuel =
            (5 + u_value[d.glazing] + 0.1 / thickness[d.wall]) / boiler[d.boiler] - 9.63;
        return 4 * fuel * fuel;
    }
    static double best_of(const Discrete& d) {
        const double air = std::clamp(-loss_without_air(d) / 6, least_air, most_air);
        const double full = residual_of_gain(d, 0), slope = residual_of_gain(d, 1) - full;
        const double shading = std::clamp(-full / slope, 0.0, 1.0);
        const double loss = residual_of_loss(d, air), gain = residual_of_gain(d, shading);
        return loss * loss + gain * gain + rest_of(d);
    }
};

inline optimise::Variable one_of(std::size_t n) {
    optimise::Variable variable;
    for (std::size_t k = 0; k < n; ++k) variable.values.push_back(static_cast<double>(k));
    return variable;
}

inline Problem facade(std::uint64_t) {
    return {"facade",
            {one_of(Facade::u_value.size()),
             one_of(Facade::thickness.size()),
             one_of(Facade::boiler.size()),
             {Facade::least_air, Facade::most_air},
             {0, 1}},
            &Facade::value,
            Facade::least()};
}

/// Runs to the end. \param value  of a row of variables
inline void run(optimise::Optimiser& optimiser,
                const std::function<double(std::span<const double>)>& value) {
    for (Matrix points = optimiser.next_points(); points.rows > 0;
         points = optimiser.next_points()) {
        Matrix values(points.rows, 1);
        for (std::size_t r = 0; r < points.rows; ++r) values(r, 0) = value(points.row(r));
        optimiser.tell(values);
    }
}

/// How often, and after how many evaluations, a method comes within 1e-4 of the least.
struct Trials {
    int n_successes = 0;
    std::vector<double> errors, evaluations;
};

using MakeProblem = std::function<Problem(std::uint64_t seed)>;
using MakeMethod = std::function<optimise::Method(std::uint64_t seed)>;

inline Trials trials(const MakeProblem& make_problem, const MakeMethod& make_method,
                     int n_seeds, std::size_t budget, int first_seed = 1) {
    Trials all;
    for (int seed = first_seed; seed < first_seed + n_seeds; ++seed) {
        const auto number = static_cast<std::uint64_t>(seed);
        const Problem problem = make_problem(number);
        optimise::Limits limits;
        limits.evaluations = budget;
        limits.target = problem.least + 1e-4;
        optimise::Optimiser optimiser(optimise::Space(problem.variables), 1, limits,
                                      make_method(number));
        run(optimiser, problem.value);
        const double error = optimiser.found()[0].objectives[0] - problem.least;
        all.n_successes += error <= 1e-4 ? 1 : 0;
        all.errors.push_back(error);
        all.evaluations.push_back(static_cast<double>(optimiser.n_evaluated()));
    }
    return all;
}

inline double median(std::vector<double> values) {
    std::ranges::sort(values);
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// ZDT1 (Zitzler, Deb and Thiele 2000): 30 variables; front f1 = 1 - sqrt(f0).
inline std::array<double, 2> zdt1(std::span<const double> x) {
    double sum = 0;
    for (std::size_t k = 1; k < x.size(); ++k) sum += x[k];
    const double g = 1 + 9 * sum / static_cast<double>(x.size() - 1);
    return {x[0], g * (1 - std::sqrt(x[0] / g))};
}

/// Area that points of two objectives dominate below a reference point.
/// \param objectives  [n x 2]
inline double hypervolume(const Matrix& objectives, double reference_0,
                          double reference_1) {
    std::vector<std::array<double, 2>> points;
    points.reserve(objectives.rows);
    for (std::size_t r = 0; r < objectives.rows; ++r)
        points.push_back({objectives(r, 0), objectives(r, 1)});
    std::ranges::sort(points);
    double area = 0, top = reference_1;
    for (const auto& [x, y] : points) {
        if (!(x < reference_0) || !(y < top)) continue;
        area += (reference_0 - x) * (top - y);
        top = y;
    }
    return area;
}

/// Area below (1.1, 1.1) that ZDT1's whole front dominates: of [0, 1], 0.1 + 2/3, and of
/// [1, 1.1], 0.1 x 1.1.
constexpr double zdt1_hypervolume = 0.1 + 2.0 / 3.0 + 0.11;

inline Matrix run_zdt1(const optimise::Method& method) {
    optimise::Optimiser optimiser(optimise::Space(std::vector<optimise::Variable>(30)), 2,
                                  {}, method);
    for (Matrix points = optimiser.next_points(); points.rows > 0;
         points = optimiser.next_points()) {
        Matrix values(points.rows, 2);
        for (std::size_t r = 0; r < points.rows; ++r)
            std::ranges::copy(zdt1(points.row(r)), values.row(r).begin());
        optimiser.tell(values);
    }
    Matrix front(optimiser.found().size(), 2);
    for (std::size_t r = 0; r < front.rows; ++r)
        std::ranges::copy(optimiser.found()[r].objectives, front.row(r).begin());
    return front;
}

}  // namespace bemcal::test
