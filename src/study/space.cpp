/// Moves unknowns between their units and the real line: values, slopes, log priors with
/// Jacobian and gradient, draws. Fixed ones have no coordinate, discrete ones an index.
/// Follows from the transforms of `PriorDensity`; powers of a size between the centred
/// and the non-centred form: Papaspiliopoulos, Roberts and Skoeld 2003, Bayesian
/// Statistics 7.
/// Unknowns are independent beforehand, but for those whose size is one of them;
/// discrete ones have no gradient.
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

/// A place on the line over the quotient by the size, and a value over its place.
double length(const Coordinate& coordinate, double size) {
    return std::pow(size, coordinate.centring);
}
double stretch(const Coordinate& coordinate, double size) {
    return std::pow(size, 1 - coordinate.centring);
}

}  // namespace

Space::Space(std::vector<Coordinate> coordinates) : coordinates_(std::move(coordinates)) {
    densities_.reserve(coordinates_.size());
    for (std::size_t k = 0; k < coordinates_.size(); ++k) {
        densities_.emplace_back(coordinates_[k].prior);
        place_.push_back(free_.size());
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

/// What a free one's prior is of; a discrete one has no slope.
stats::Mapped Space::mapped(std::span<const double> position, std::size_t f) const {
    const Coordinate& coordinate = coordinates_[free_[f]];
    if (coordinate.values.empty())
        return densities_[free_[f]].transform().at(position[f]);
    return {coordinate.values.at(static_cast<std::size_t>(position[f])), 0};
}

std::vector<char> Space::sizes() const {
    std::vector<char> sizes(free_.size(), 0);
    for (const Coordinate& coordinate : coordinates_)
        if (coordinate.in) sizes[place_[*coordinate.in]] = 1;
    return sizes;
}

void Space::read(std::span<const double> position, std::span<double> values) const {
    for (std::size_t k = 0; k < size(); ++k)
        if (is_fixed(coordinates_[k])) values[k] = coordinates_[k].prior.a;
    for (std::size_t f = 0; f < free_.size(); ++f)
        values[free_[f]] = mapped(position, f).x;
    for (const std::size_t k : free_)
        if (const auto& in = coordinates_[k].in)
            values[k] *= stretch(coordinates_[k], values[*in]);
    for (std::size_t k = 0; k < size(); ++k)
        if (const auto& step = coordinates_[k].step)
            values[k] = values[step->size] * step->share(values[step->moment]);
}

void Space::pull_back(std::span<const double> position, std::span<const double> by_value,
                      std::span<double> by_position) const {
    std::vector<double> values(size()), by(by_value.begin(), by_value.end());
    read(position, values);
    for (std::size_t k = 0; k < size(); ++k)
        if (const auto& step = coordinates_[k].step) {
            by[step->size] += by_value[k] * step->share(values[step->moment]);
            by[step->moment] +=
                by_value[k] * values[step->size] * step->slope(values[step->moment]);
        }
    for (const std::size_t k : free_)
        if (const auto& in = coordinates_[k].in) {
            const double size = values[*in];
            by[*in] += by[k] * (1 - coordinates_[k].centring) * values[k] / size;
            by[k] *= stretch(coordinates_[k], size);
        }
    for (std::size_t f = 0; f < free_.size(); ++f)
        by_position[f] = by[free_[f]] * mapped(position, f).slope;
}

/// Of x, where x / size^centring has the prior, by x and by the size.
/// \param size  its place
double Space::log_prior_in(std::size_t size, std::span<const double> position,
                           std::size_t f, std::span<double> gradient) const {
    const stats::Mapped scale = mapped(position, size);
    const Coordinate& one = coordinates_[free_[f]];
    const double unit = length(one, scale.x), own = position[f] / unit;
    const stats::LogDensity at = densities_[free_[f]].at(own);
    gradient[f] += at.derivative / unit;
    gradient[size] -= one.centring * (at.derivative * own + 1) / scale.x * scale.slope;
    return at.value - std::log(unit);
}

double Space::log_prior(std::span<const double> position,
                        std::span<double> gradient) const {
    double sum = 0;
    for (std::size_t f = 0; f < free_.size(); ++f) {
        if (!coordinates_[free_[f]].values.empty()) continue;
        if (const auto& in = coordinates_[free_[f]].in) {
            sum += log_prior_in(place_[*in], position, f, gradient);
            continue;
        }
        const auto at = densities_[free_[f]].on_the_line(position[f]);
        sum += at.value;
        gradient[f] += at.derivative;
    }
    return sum;
}

std::vector<double> Space::position_of(std::span<const double> values) const {
    std::vector<double> position;
    position.reserve(free_.size());
    for (const std::size_t k : free_) {
        const Coordinate& one = coordinates_[k];
        if (!one.values.empty())
            position.push_back(level_of(one.values, values[k]));
        else if (one.in)
            position.push_back(values[k] / stretch(one, values[*one.in]));
        else
            position.push_back(densities_[k].transform().inverse(values[k]));
    }
    return position;
}

std::vector<double> Space::draw_position(Stream& random) const {
    std::vector<double> position;
    position.reserve(free_.size());
    for (const std::size_t k : free_) {
        const Coordinate& coordinate = coordinates_[k];
        if (!coordinate.values.empty()) {
            position.push_back(
                random.below(static_cast<std::uint32_t>(coordinate.values.size())));
            continue;
        }
        const double own = densities_[k].quantile_on_the_line(random.uniform());
        const auto& in = coordinate.in;
        position.push_back(in ? own * length(coordinate, mapped(position, place_[*in]).x)
                              : own);
    }
    return position;
}

}  // namespace bemcal::study
