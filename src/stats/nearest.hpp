/// The points nearest to a reference point, plain or with density avoidance.
///
/// Density avoidance is that of Basurra and Jankovic's k-NN calibration of a
/// semi-detached house; where its Figure 2 and its text differ, the text holds. Points
/// are visited by rising distance from the reference. Around each the points within a
/// radius are counted; where their density (count / n) / volume is above a threshold, the
/// visited point's nearest neighbour is tagged "high density". Tagged points are neither
/// visited nor counted nor tagged again, and the k nearest are taken from the others. A
/// point does not count as its own neighbour; n is the number of all points, tagged ones
/// included; points visited already can be tagged too, even the nearest of all; ties go
/// by index. In d dimensions the paper's circle is a d-ball. Left out: the vote of k-NN
/// and the Parzen window, which the paper introduces and does not use.
#pragma once

#include "base/matrix.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace bemcal::stats {

enum class CountRule { given, square_root };  ///< k as given, or sqrt(n) rounded

struct NearestOptions {
    std::size_t k = 7;
    CountRule count_rule = CountRule::given;
    std::optional<double> radius;     ///< default: by default_crowding
    std::optional<double> threshold;  ///< [1 / volume]; default: by default_crowding
};

/// When a neighbourhood counts as crowded.
struct Crowding {
    double radius = 0;     ///< in the points' unit
    double threshold = 0;  ///< share of the points per volume
};

/// Volume of a ball; 1 in no dimension.
double ball_volume(std::size_t dimension, double radius);

/// k for n points, at most n.
std::size_t neighbour_count(const NearestOptions& options, std::size_t n);

/// Indices of the k nearest, or of all where there are fewer, by rising distance.
/// Throws std::invalid_argument where a coordinate is no finite number.
/// \param points  [n x d]  \param reference  [d]
std::vector<std::size_t> nearest(const Matrix& points, std::span<const double> reference,
                                 std::size_t k);

/// What counts as crowded where nobody says: the radius is half the distance r from the
/// reference to its k-th nearest point, the threshold the density of the k points in the
/// ball of radius r. A place is crowded where it is denser than the reference's own
/// surroundings. Nothing is where the k-th nearest lies on the reference.
Crowding default_crowding(const Matrix& points, std::span<const double> reference,
                          const NearestOptions& options);

struct Selection {
    std::vector<std::size_t> nearest;   ///< k or fewer, by rising distance
    std::vector<char> is_high_density;  ///< [n]
    Crowding crowding;                  ///< as used
};

/// Throws std::invalid_argument where a coordinate is no finite number, or the radius or
/// threshold is negative. Its time is that of sorting plus n times the points around one.
Selection nearest_avoiding_density(const Matrix& points,
                                   std::span<const double> reference,
                                   const NearestOptions& options);

}  // namespace bemcal::stats
