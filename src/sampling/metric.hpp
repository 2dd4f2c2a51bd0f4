/// The scale of the sample space: a factor L of the covariance L L', by which steps are
/// stretched and gradients whitened. In whitened coordinates momentum is standard normal.
/// It covers the real coordinates; whole numbers stand still.
#pragma once

#include "sampling/point.hpp"

#include <span>
#include <vector>

namespace bemcal::sampling {

enum class MetricShape { diagonal, dense };

/// Mean and scatter of a sample, point by point (Welford 1962).
class RunningCovariance {
  public:
    RunningCovariance(std::size_t size, MetricShape shape);
    void add(std::span<const double> x);
    void forget();
    int count() const { return count_; }
    bool is_full(int least_each) const {
        return static_cast<std::size_t>(count_) >=
               mean_.size() * static_cast<std::size_t>(least_each);
    }
    /// [size] variances or [size x size] covariances, row-major, shrunk towards 1e-3 as
    /// Stan does: n/(n+5) sample + 5/(n+5) 1e-3. Unlike Stan's, covariances are 0 as long
    /// as there are fewer than `least_each` points for each coordinate: a matrix near
    /// singular by chance is worse than none.
    std::vector<double> regularised(int least_each) const;

  private:
    MetricShape shape_;
    int count_ = 0;
    std::vector<double> mean_, scatter_, before_;
};

class Metric {
  public:
    /// \param coordinates  the real ones, of a point's
    Metric(std::vector<std::size_t> coordinates, MetricShape shape);

    std::size_t size() const { return coordinates_.size(); }
    std::span<const std::size_t> coordinates() const { return coordinates_; }
    MetricShape shape() const { return shape_; }
    /// [size] standard deviations or [size x size] lower triangle, row-major.
    std::span<double> factor() { return factor_; }
    /// A covariance without a Cholesky factor leaves the metric as it is.
    void set_covariance(const std::vector<double>& covariance);

    /// x += scale L step   \param step  [size]
    void move(std::vector<double>& x, double scale, std::span<const double> step);
    /// force = L' gradient of the density at that inverse temperature   \param force
    /// [size]
    void whiten_gradient(const Point& point, double inverse_temperature,
                         std::span<double> force);
    /// The real coordinates of x; valid until the next call.
    std::span<const double> real_part(const std::vector<double>& x);

  private:
    std::vector<std::size_t> coordinates_;
    MetricShape shape_;
    std::vector<double> factor_, scratch_;
};

}  // namespace bemcal::sampling
