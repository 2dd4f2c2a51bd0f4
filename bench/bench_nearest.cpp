/// What density avoidance costs: 3840 points, as many as paper 3's first grid has, and a
/// million, uniform and in clusters, with 50 points within the radius on average; and
/// where crowds are far larger: a hundred times the radius, and all points in one place.
///
/// CPU time of one core, the median of a few. Lines: name value unit reference ratio.
#include "stats/density_avoidance.hpp"

#include <ctime>
#include <string>

#include <fmt/format.h>

namespace bemcal::stats {
namespace {

/// Mean number of points within the radius of a point, from a sample of the points.
double mean_count(const Matrix& points, double radius) {
    constexpr std::size_t n_sampled = 40;
    double count = 0;
    for (std::size_t s = 0; s < n_sampled; ++s) {
        const auto own = points.row(s * (points.rows / n_sampled) + s);
        for (std::size_t r = 0; r < points.rows; ++r)
            count += plain_distance(points.row(r), own) <= radius * radius ? 1 : 0;
    }
    return count / n_sampled - 1;
}

/// The radius with that many points within it on average, by bisection.
double radius_for(const Matrix& points, double wanted) {
    double least = 0, most = 20;
    for (int step = 0; step < 12; ++step) {
        const double middle = (least + most) / 2;
        (mean_count(points, middle) > wanted ? most : least) = middle;
    }
    return least;
}

void run(const std::string& name, const Matrix& points, double radius,
         double reference_ms) {
    NearestOptions options;
    options.radius = radius;
    const std::vector<double> origin(points.cols, 0.0);
    std::vector<double> times;
    for (int r = 0; r < 3; ++r) {
        const std::clock_t start = std::clock();
        const Selection found = nearest_avoiding_density(points, origin, options);
        times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::ranges::sort(times);
    fmt::print("{} {:.4g} ms {:.4g} {:.4g}\n", name, times[1], reference_ms,
               times[1] / reference_ms);
}

}  // namespace
}  // namespace bemcal::stats

int main() {
    using namespace bemcal::stats;
    bemcal::Stream random(3, 0, 0);
    constexpr double wanted = 50, small_ms = 20, large_ms = 10000;
    const auto points = [&](auto make, std::size_t n, std::size_t d) {
        return make(n, d, random);
    };
    const auto small_uniform = points(uniform_points, 3840, 2);
    run("nearest_3840_uniform", small_uniform, radius_for(small_uniform, wanted),
        small_ms);
    const auto small_clustered = points(clustered_points, 3840, 2);
    run("nearest_3840_clustered", small_clustered, radius_for(small_clustered, wanted),
        small_ms);
    run("nearest_3840_one_place", bemcal::Matrix(3840, 2, 1.0), 0.1, small_ms);
    for (const std::size_t d : {2U, 3U}) {
        const auto uniform = points(uniform_points, 1000000, d);
        const std::string name = fmt::format("nearest_million_{}d_", d);
        run(name + "uniform", uniform, radius_for(uniform, wanted), large_ms);
        const auto clustered = points(clustered_points, 1000000, d);
        const double radius = radius_for(clustered, wanted);
        run(name + "clustered", clustered, radius, large_ms);
        run(name + "crowded", clustered, 100 * radius, large_ms);
    }
    run("nearest_million_one_place", bemcal::Matrix(1000000, 2, 1.0), 0.1, large_ms);
}
