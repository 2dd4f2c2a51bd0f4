/// Moves unknowns between their units and the real line: values, slopes, log priors with
/// Jacobian and gradient, draws. Fixed ones have no coordinate, discrete ones an index.
/// Follows from the transforms of `PriorDensity`.
/// Unknowns are independent beforehand; discrete ones have no gradient.
#include "study/space.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::study {
namespace {

bool is_fixed(const Coordinate& coordinate) {
    return coordinate.values.empty() && coordinate.prior.kind == stats::PriorKind::fixed;
}

/// The discrete value nearest to x.
double level_of(const std::vector<double>& values, double x) {
    const auto nearer = [x](double a, double b) {
        return std::abs(a - x) < std::abs(b - x);
    };
    return static_cast<double>(std::ranges::min_element(values, nearer) - values.begin());
}

}  // namespace

Space::Space(std::vector<Coordinate> coordinates) : coordinates_(std::move(coordinates)) {
    densities_.reserve(coordinates_.size());
    for (std::size_t k = 0; k < coordinates_.size(); ++k) {
        densities_.emplace_back(coordinates_[k].prior);
        if (!is_fixed(coordinates_[k])) free_.push_back(k);
    }
}

std::vector<int> Space::levels() const {
    std::vector<int> levels;
    levels.reserve(free_.size());
    for (const std::size_t k : free_)
        levels.push_back(static_cast<int>(coordinates_[k].values.size()));
    return levels;
}

void Space::read(std::span<const double> position, std::span<double> values) const {
    for (std::size_t k = 0; k < size(); ++k)
        if (is_fixed(coordinates_[k])) values[k] = coordinates_[k].prior.a;
    for (std::size_t f = 0; f < free_.size(); ++f) {
        const Coordinate& coordinate = coordinates_[free_[f]];
        values[free_[f]] =
            coordinate.values.empty()
                ? densities_[free_[f]].transform().at(position[f]).x
                : coordinate.values.at(static_cast<std::size_t>(position[f]));
    }
}

void Space::slopes(std::span<const double> position, std::span<double> slopes) const {
    for (std::size_t f = 0; f < free_.size(); ++f)
        slopes[f] = coordinates_[free_[f]].values.empty()
                        ? densities_[free_[f]].transform().at(position[f]).slope
                        : 0;
}

double Space::log_prior(std::span<const double> position,
                        std::span<double> gradient) const {
    double sum = 0;
    for (std::size_t f = 0; f < free_.size(); ++f) {
        if (!coordinates_[free_[f]].values.empty()) continue;
        const auto at = densities_[free_[f]].on_the_line(position[f]);
        sum += at.value;
        gradient[f] += at.derivative;
    }
    return sum;
}

std::vector<double> Space::position_of(std::span<const double> values) const {
    std::vector<double> position;
    position.reserve(free_.size());
    for (const std::size_t k : free_)
        position.push_back(coordinates_[k].values.empty()
                               ? densities_[k].transform().inverse(values[k])
                               : level_of(coordinates_[k].values, values[k]));
    return position;
}

std::vector<double> Space::draw_position(Stream& random) const {
    std::vector<double> position;
    position.reserve(free_.size());
    for (const std::size_t k : free_) {
        const Coordinate& coordinate = coordinates_[k];
        if (coordinate.values.empty())
            position.push_back(densities_[k].quantile_on_the_line(random.uniform()));
        else
            position.push_back(
                random.below(static_cast<std::uint32_t>(coordinate.values.size())));
    }
    return position;
}

}  // namespace bemcal::study
