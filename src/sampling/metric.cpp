/// The scale of the sample space: running covariances (Welford), Cholesky factors, and
/// their products with steps and gradients, by Eigen.
/// Source: Welford 1962; shrinkage as in Stan. A covariance without a factor leaves the
/// metric as it is. Metrics that depend on the position are left out.
#include "sampling/metric.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace bemcal::sampling {
namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Column = Eigen::Map<const Eigen::VectorXd>;

Eigen::Map<const Square> square(const std::vector<double>& values, std::size_t size) {
    const auto n = static_cast<Eigen::Index>(size);
    return {values.data(), n, n};
}

Column column(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Eigen::Map<Eigen::VectorXd> column(std::span<double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::size_t n_values(std::size_t size, MetricShape shape) {
    return shape == MetricShape::dense ? size * size : size;
}

}  // namespace

RunningCovariance::RunningCovariance(std::size_t size, MetricShape shape)
    : shape_(shape), mean_(size), scatter_(n_values(size, shape)), before_(size) {}

void RunningCovariance::forget() {
    count_ = 0;
    std::ranges::fill(mean_, 0.0);
    std::ranges::fill(scatter_, 0.0);
}

void RunningCovariance::add(std::span<const double> x) {
    ++count_;
    const std::size_t n = mean_.size();
    for (std::size_t i = 0; i < n; ++i) {
        before_[i] = x[i] - mean_[i];
        mean_[i] += before_[i] / count_;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const double after = x[i] - mean_[i];
        if (shape_ == MetricShape::diagonal)
            scatter_[i] += before_[i] * after;
        else
            for (std::size_t j = 0; j < n; ++j) scatter_[i * n + j] += after * before_[j];
    }
}

std::vector<double> RunningCovariance::regularised(int least_each) const {
    const double weight = count_ / (count_ + 5.0);
    const std::size_t n = mean_.size();
    const bool full = is_full(least_each);
    const std::size_t step = shape_ == MetricShape::dense ? n + 1 : 1;
    std::vector<double> covariance = scatter_;
    for (std::size_t k = 0; k < covariance.size(); ++k)
        covariance[k] *= full || k % step == 0 ? weight / std::max(count_ - 1, 1) : 0;
    for (std::size_t i = 0; i < n; ++i) covariance[i * step] += 1e-3 * (1 - weight);
    return covariance;
}

Metric::Metric(std::vector<std::size_t> coordinates, MetricShape shape)
    : coordinates_(std::move(coordinates)),
      shape_(shape),
      factor_(n_values(coordinates_.size(), shape)),
      scratch_(coordinates_.size()) {
    const std::size_t step = shape == MetricShape::dense ? size() + 1 : 1;
    for (std::size_t i = 0; i < size(); ++i) factor_[i * step] = 1;
}

void Metric::set_covariance(const std::vector<double>& covariance) {
    if (shape_ == MetricShape::diagonal) {
        std::ranges::transform(covariance, factor_.begin(),
                               [](double variance) { return std::sqrt(variance); });
        return;
    }
    const Eigen::LLT<Square> cholesky(square(covariance, size()));
    if (cholesky.info() != Eigen::Success) return;
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::Map<Square>(factor_.data(), n, n) = cholesky.matrixL();
}

void Metric::move(std::vector<double>& x, double scale, std::span<const double> step) {
    if (shape_ == MetricShape::dense)
        column(std::span<double>(scratch_)).noalias() =
            square(factor_, size()) * column(step);
    else
        for (std::size_t i = 0; i < size(); ++i) scratch_[i] = factor_[i] * step[i];
    for (std::size_t i = 0; i < size(); ++i) x[coordinates_[i]] += scale * scratch_[i];
}

void Metric::whiten_gradient(const Point& point, double inverse_temperature,
                             std::span<double> force) {
    for (std::size_t i = 0; i < size(); ++i) {
        const std::size_t c = coordinates_[i];
        scratch_[i] =
            point.prior_gradient[c] + inverse_temperature * point.likelihood_gradient[c];
    }
    if (shape_ == MetricShape::dense)
        column(force).noalias() = square(factor_, size()).transpose() *
                                  column(std::span<const double>(scratch_));
    else
        for (std::size_t i = 0; i < size(); ++i) force[i] = factor_[i] * scratch_[i];
}

std::span<const double> Metric::real_part(const std::vector<double>& x) {
    for (std::size_t i = 0; i < size(); ++i) scratch_[i] = x[coordinates_[i]];
    return scratch_;
}

}  // namespace bemcal::sampling
