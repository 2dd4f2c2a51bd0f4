/// Density avoidance as its description reads, every point against every other: what
/// stats/nearest.hpp is held to, and the point sets for it.
#pragma once

#include "base/random.hpp"
#include "stats/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::stats {

inline double plain_distance(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// \return which points are tagged
inline std::vector<char> plain_tags(const Matrix& points,
                                    std::span<const double> reference,
                                    const Crowding& crowding) {
    const std::size_t n = points.rows;
    std::vector<std::size_t> visits(n);
    std::iota(visits.begin(), visits.end(), std::size_t{0});
    std::ranges::stable_sort(visits, {}, [&](std::size_t r) {
        return plain_distance(points.row(r), reference);
    });
    std::vector<char> tagged(n, 0);
    const double square = crowding.radius * crowding.radius;
    const double volume = ball_volume(points.cols, crowding.radius);
    for (const std::size_t x : visits) {
        if (tagged[x] != 0) continue;
        double count = 0, least = square;
        std::size_t closest = n;
        for (std::size_t y = 0; y < n; ++y) {
            const double d = plain_distance(points.row(x), points.row(y));
            if (y == x || tagged[y] != 0 || d > square) continue;
            count += 1;
            if (closest == n || d < least) {
                least = d;
                closest = y;
            }
        }
        if (count > 0 && count / static_cast<double>(n) / volume > crowding.threshold)
            tagged[closest] = 1;
    }
    return tagged;
}

inline std::vector<std::size_t> plain_nearest(const Matrix& points,
                                              std::span<const double> reference,
                                              const std::vector<char>& tagged,
                                              std::size_t k) {
    std::vector<std::size_t> found;
    for (std::size_t r = 0; r < points.rows; ++r)
        if (tagged[r] == 0) found.push_back(r);
    std::ranges::stable_sort(found, {}, [&](std::size_t r) {
        return plain_distance(points.row(r), reference);
    });
    found.resize(std::min(found.size(), k));
    return found;
}

inline Matrix uniform_points(std::size_t n, std::size_t d, Stream& random) {
    Matrix points(n, d);
    for (double& x : points.values) x = 20 * random.uniform() - 10;
    return points;
}

/// Around ten centres, each cluster narrower than the one before, with a few strays.
inline Matrix clustered_points(std::size_t n, std::size_t d, Stream& random) {
    const Matrix centres = uniform_points(10, d, random);
    Matrix points(n, d);
    for (std::size_t r = 0; r < n; ++r) {
        const std::size_t c = random.below(10);
        const double width = r % 50 == 0 ? 5 : std::pow(0.5, static_cast<double>(c));
        for (std::size_t k = 0; k < d; ++k)
            points(r, k) = centres(c, k) + width * (random.uniform() - 0.5);
    }
    return points;
}

/// On a coarse lattice: many at the same place, and many equal distances.
inline Matrix tied_points(std::size_t n, std::size_t d, Stream& random) {
    Matrix points(n, d);
    for (double& x : points.values) x = static_cast<double>(random.below(12)) / 2;
    return points;
}

}  // namespace bemcal::stats
