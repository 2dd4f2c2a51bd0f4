/// Targets whose moments are known.
#pragma once

#include "sampling/density.hpp"
#include "sampling/normal.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace bemcal::test {

/// A density given point by point: what tests define one with.
class PlainDensity : public sampling::Density {
  public:
    struct Values {
        double prior = 0, likelihood = 0;
        std::vector<double> prior_gradient, likelihood_gradient;
    };
    using Function = std::function<void(std::span<const double>, Values&)>;

    PlainDensity(std::size_t dimension, Function function, std::size_t width = 1)
        : dimension_(dimension), function_(std::move(function)), width_(width) {}

    std::size_t dimension() const override { return dimension_; }
    std::size_t width() const override { return width_; }
    std::vector<int> levels() const override {
        return levels_.empty() ? Density::levels() : levels_;
    }
    void set_levels(std::vector<int> levels) { levels_ = std::move(levels); }
    void set_start_spread(double sd) { start_sd_ = sd; }
    long long n_points() const { return n_points_; }
    std::size_t most_points() const { return most_points_; }

    void evaluate(const Matrix& points, bool, sampling::Evaluations& out) override {
        n_points_ += static_cast<long long>(points.rows);
        most_points_ = std::max(most_points_, points.rows);
        out.prior.resize(points.rows);
        out.likelihood.resize(points.rows);
        out.prior_gradient = out.likelihood_gradient = Matrix(points.rows, dimension_);
        for (std::size_t k = 0; k < points.rows; ++k) evaluate_row(points, k, out);
    }

    std::vector<double> draw_start(Stream& random) const override {
        std::vector<double> x(dimension_);
        const std::vector<int> n_values = levels();
        for (std::size_t i = 0; i < dimension_; ++i)
            x[i] = n_values[i] == 0 ? start_sd_ * sampling::standard_normal(random)
                                    : random.below(static_cast<unsigned>(n_values[i]));
        return x;
    }

  private:
    void evaluate_row(const Matrix& points, std::size_t k, sampling::Evaluations& out) {
        Values values{0, 0, std::vector<double>(dimension_),
                      std::vector<double>(dimension_)};
        function_(points.row(k), values);
        out.prior[k] = values.prior;
        out.likelihood[k] = values.likelihood;
        std::ranges::copy(values.prior_gradient, out.prior_gradient.row(k).begin());
        std::ranges::copy(values.likelihood_gradient,
                          out.likelihood_gradient.row(k).begin());
    }

    std::size_t dimension_;
    Function function_;
    std::size_t width_;
    std::vector<int> levels_;
    double start_sd_ = 2;
    long long n_points_ = 0;
    std::size_t most_points_ = 0;
};

/// x = A z with z standard normal and A lower bidiagonal: variance and correlation of all
/// coordinates are known, and so is its inverse.
struct Gaussian {
    std::size_t dimension;
    double link = 0.9;  ///< x_i = scale_i (link x_(i-1)/scale_(i-1) + sqrt(1-link^2) z_i)
    double ratio = 100;  ///< of the largest to the smallest scale

    double scale(std::size_t i) const {
        return std::pow(ratio,
                        static_cast<double>(i) / static_cast<double>(dimension - 1)) /
               std::sqrt(ratio);
    }
    double mean(std::size_t i) const { return static_cast<double>(i) * 0.1; }

    /// Half of it prior, half likelihood.
    void operator()(std::span<const double> x, PlainDensity::Values& out) const {
        const double innovation = std::sqrt(1 - link * link);
        double before = 0;
        for (std::size_t i = 0; i < dimension; ++i) {
            const double u = (x[i] - mean(i)) / scale(i);
            const double width = i == 0 ? 1 : innovation;
            const double z = (u - (i == 0 ? 0 : link * before)) / width;
            out.prior -= 0.25 * z * z;
            out.prior_gradient[i] -= 0.5 * z / width / scale(i);
            if (i > 0) out.prior_gradient[i - 1] += 0.5 * z * link / width / scale(i - 1);
            before = u;
        }
        out.likelihood = out.prior;
        out.likelihood_gradient = out.prior_gradient;
    }
};

}  // namespace bemcal::test
