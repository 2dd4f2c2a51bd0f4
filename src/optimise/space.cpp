/// What is varied: shares of ranges and places in tables, their start, draws, mesh and
/// values.
/// Plain bookkeeping without a source. Ranges are linear: no logarithmic scale;
/// constraints among variables are left out.
#include "optimise/space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace bemcal::optimise {
namespace {

void check(const Variable& variable) {
    const bool has_range = std::isfinite(variable.least) &&
                           std::isfinite(variable.most) && variable.least < variable.most;
    if (variable.values.empty() && !has_range)
        throw std::invalid_argument("a variable needs a range with least < most");
}

/// The number of the value nearest to x.
double nearest(const std::vector<double>& values, double x) {
    const auto nearer = [x](double a, double b) {
        return std::abs(a - x) < std::abs(b - x);
    };
    return static_cast<double>(std::ranges::min_element(values, nearer) - values.begin());
}

}  // namespace

Space::Space(std::vector<Variable> variables) : variables_(std::move(variables)) {
    if (variables_.empty()) throw std::invalid_argument("there is no variable");
    for (const Variable& variable : variables_) check(variable);
}

double Space::highest(std::size_t k) const {
    return is_discrete(k) ? static_cast<double>(variables_[k].values.size() - 1) : 1.0;
}

Position Space::start() const {
    Position position;
    position.reserve(size());
    for (std::size_t k = 0; k < size(); ++k) {
        const Variable& variable = variables_[k];
        if (std::isnan(variable.start))
            position.push_back(0.5 * highest(k));
        else if (is_discrete(k))
            position.push_back(nearest(variable.values, variable.start));
        else
            position.push_back((variable.start - variable.least) /
                               (variable.most - variable.least));
    }
    return snapped(std::move(position), 0);
}

Position Space::draw(Stream& random) const {
    Position position;
    position.reserve(size());
    for (std::size_t k = 0; k < size(); ++k) {
        const auto n_levels = static_cast<std::uint32_t>(highest(k)) + 1;
        position.push_back(is_discrete(k) ? random.below(n_levels) : random.uniform());
    }
    return position;
}

Position Space::snapped(Position position, double mesh) const {
    for (std::size_t k = 0; k < size(); ++k) {
        double& x = position[k];
        if (is_discrete(k))
            x = std::round(x);
        else if (mesh > 0)
            x = std::round(x / mesh) * mesh;
        x = std::clamp(x, 0.0, highest(k));
    }
    return position;
}

double Space::value_of(std::size_t k, double coordinate) const {
    const Variable& variable = variables_[k];
    if (is_discrete(k)) return variable.values[static_cast<std::size_t>(coordinate)];
    return variable.least + (variable.most - variable.least) * coordinate;
}

Matrix Space::values_of(std::span<const Position> positions) const {
    Matrix values(positions.size(), size());
    for (std::size_t r = 0; r < positions.size(); ++r)
        for (std::size_t k = 0; k < size(); ++k)
            values(r, k) = value_of(k, positions[r][k]);
    return values;
}

}  // namespace bemcal::optimise
