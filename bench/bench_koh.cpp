/// What a Kennedy-O'Hagan log density costs, with and without its gradient, in both
/// forms.
///
/// The problem is of bc-stan's shape: 3 known and 3 calibrated inputs, 10 designs times
/// 12 points, 12 measurements (N = 132), then 2 and 4 times as many designs and points,
/// at a point where all correlations are moderate. The reference is Stan's time for a
/// gradient of the same model (rstan 2.21.7, g++ 12 -O3, one core; CPU time, N = 132,
/// 264, 528). Medians of repetitions in CPU time. Lines: name value unit reference ratio.
#include "emulator/density.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

namespace bemcal::emulator {

namespace {

struct Size {
    std::size_t designs, points;
    double stan_ms;  ///< a gradient
};
constexpr Size sizes[] = {{10, 12, 3.0}, {21, 12, 12.0}, {21, 24, 56.0}};

double output_at(std::span<const double> x, std::span<const double> t) {
    return 2000 + 500 * std::sin(3 * x[0]) * (1 + t[0]) + 300 * x[1] * t[1] +
           100 * x[2] * x[2] * t[2];
}

Matrix random_points(std::size_t n, Stream& random) {
    Matrix points(n, 3);
    for (double& value : points.values) value = random.uniform();
    return points;
}

Observations made_up(const Size& size) {
    Stream random(1, 0, 0);
    const Matrix x = random_points(size.points, random),
                 t = random_points(size.designs, random);
    const std::vector<double> truth{0.3, 0.6, 0.5};
    Observations o;
    o.measured_x = x;
    for (std::size_t i = 0; i < size.points; ++i)
        o.measured.push_back(output_at(x.row(i), truth) + 30 * random.uniform());
    o.simulated_x = o.simulated_t = Matrix(size.designs * size.points, 3);
    for (std::size_t row = 0; row < o.simulated_x.rows; ++row) {
        const std::size_t d = row / size.points, i = row % size.points;
        std::ranges::copy(x.row(i), o.simulated_x.row(row).begin());
        std::ranges::copy(t.row(d), o.simulated_t.row(row).begin());
        o.simulated.push_back(output_at(x.row(i), t.row(d)));
    }
    return o;
}

double median_ms(KohDensity& density, bool gradients, int repetitions) {
    Matrix point(1, density.dimension(), 0.5);
    sampling::Evaluations out;
    std::vector<double> times;
    for (int r = 0; r < repetitions; ++r) {
        const std::clock_t start = std::clock();
        const int n = density.is_kronecker() ? 100 : 5;
        for (int k = 0; k < n; ++k) density.evaluate(point, gradients, out);
        times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC /
                        n);
    }
    std::ranges::sort(times);
    return times[times.size() / 2];
}

void run(const Size& size, Form form, const char* name) {
    ModelOptions options;
    options.form = form;
    KohDensity density(standardise(made_up(size)), options);
    const std::size_t n = (size.designs + 1) * size.points;
    const int repetitions = n > 300 ? 21 : 101;
    for (const bool gradients : {false, true}) {
        const double ms = median_ms(density, gradients, repetitions);
        fmt::print("koh_{}_{}_n{} {:.4g} ms {:.4g} {:.4g}\n", name,
                   gradients ? "gradient" : "value", n, ms, size.stan_ms,
                   size.stan_ms / ms);
    }
}

}  // namespace

void run_all() {
    for (const Size& size : sizes) {
        run(size, Form::dense, "dense");
        run(size, Form::kronecker_if_grid, "kronecker");
    }
}

}  // namespace bemcal::emulator

int main() {
    bemcal::emulator::run_all();
}
