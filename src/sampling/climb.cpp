/// A chain's start: L-BFGS with backtracking up to a mode, and a metric from the
/// curvature there, by central differences of the gradient; again, as long as that rises.
/// Source: Nocedal and Wright 2006, algorithms 7.4 and 3.1. It finds the mode above its
/// start only; whole numbers stand still, and so do sizes of others.
#include "sampling/climb.hpp"

#include "sampling/normal.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace bemcal::sampling {
namespace {

using Vector = Eigen::VectorXd;
using DenseMatrix = Eigen::MatrixXd;

constexpr int most_climbs = 8, most_iterations = 200, most_halvings = 30;
constexpr std::size_t memory = 12;
constexpr double widest = 4;         ///< standard deviation of a first metric
constexpr double least_rise = 1e-3;  ///< of the log density, over `patience` iterations
constexpr int patience = 3;
constexpr double longest_step = 2;  ///< in any coordinate

Eigen::Index index(std::size_t k) {
    return static_cast<Eigen::Index>(k);
}

/// The real coordinates of a point, and the gradient in them.
Vector position_of(const Walker& walker, const Point& point) {
    Vector x(index(walker.metric.size()));
    for (std::size_t k = 0; k < walker.metric.size(); ++k)
        x[index(k)] = point.x[walker.metric.coordinates()[k]];
    return x;
}

Vector gradient_of(const Walker& walker, const Point& point) {
    Vector gradient(index(walker.metric.size()));
    for (std::size_t k = 0; k < walker.metric.size(); ++k) {
        const std::size_t c = walker.metric.coordinates()[k];
        gradient[index(k)] = point.prior_gradient[c] +
                             walker.inverse_temperature * point.likelihood_gradient[c];
    }
    return gradient;
}

/// Without those that a climb leaves where they are.
Vector let_move(const Walker& walker, Vector v) {
    for (std::size_t k = 0; k < walker.metric.size(); ++k)
        if (walker.coordinates.held[walker.metric.coordinates()[k]] != 0) v[index(k)] = 0;
    return v;
}

/// The trial point becomes the current one, moved.
void set_trial(Walker& walker, const Vector& x) {
    walker.trial.x = walker.current.x;
    for (std::size_t k = 0; k < walker.metric.size(); ++k)
        walker.trial.x[walker.metric.coordinates()[k]] = x[index(k)];
}

/// The metric's covariance times a vector.
Vector stretched(const Vector& v, Metric& metric) {
    using RowMajor =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const double* values = metric.factor().data();
    if (metric.shape() == MetricShape::diagonal)
        return v.cwiseProduct(Eigen::Map<const Vector>(values, v.size()).cwiseAbs2());
    const Eigen::Map<const RowMajor> factor(values, v.size(), v.size());
    return factor * (factor.transpose() * v);
}

/// What L-BFGS remembers of its last moves.
class Moves {
  public:
    void add(const Vector& step, const Vector& fall) {
        const double curvature = step.dot(fall);
        if (!(curvature > 1e-12 * step.norm() * fall.norm())) return;
        moves_.push_back({step, fall, curvature});
        if (moves_.size() > memory) moves_.pop_front();
    }

    /// The direction in which to climb, by the two-loop recursion from the metric.
    Vector direction(const Vector& gradient, Metric& metric) const {
        Vector q = gradient;
        std::vector<double> alpha(moves_.size());
        for (std::size_t k = moves_.size(); k-- > 0;) {
            alpha[k] = moves_[k].step.dot(q) / moves_[k].curvature;
            q -= alpha[k] * moves_[k].fall;
        }
        q = stretched(q, metric);
        if (!moves_.empty()) {
            const Move& last = moves_.back();
            q *= last.curvature / last.fall.dot(stretched(last.fall, metric));
        }
        for (std::size_t k = 0; k < moves_.size(); ++k)
            q +=
                (alpha[k] - moves_[k].fall.dot(q) / moves_[k].curvature) * moves_[k].step;
        return q;
    }

    bool is_empty() const { return moves_.empty(); }
    void forget() { moves_.clear(); }

  private:
    struct Move {
        Vector step, fall;  ///< of the gradient
        double curvature;
    };
    std::deque<Move> moves_;
};

/// No further than `longest_step` in any coordinate; without memory a short one.
Vector bounded(const Vector& direction, bool is_first) {
    const double size = direction.lpNorm<Eigen::Infinity>();
    const double most = is_first ? 0.1 : longest_step;
    return size > most ? Vector(direction * (most / size)) : direction;
}

/// Halves the step until the trial point rises enough; whether it did.
Task<bool> step_up(Walker& walker, Vector direction) {
    const Vector x = position_of(walker, walker.current);
    const double slope = direction.dot(gradient_of(walker, walker.current));
    const double value = walker.log_density(walker.current);
    double length = 1;
    for (int k = 0; k < most_halvings; ++k, length /= 2) {
        set_trial(walker, x + length * direction);
        co_await walker.evaluate(walker.trial);
        const bool is_finite = gradient_of(walker, walker.trial).allFinite();
        if (is_finite &&
            walker.log_density(walker.trial) >= value + 1e-4 * length * slope)
            co_return true;
    }
    co_return false;
}

/// -d gradient / d x, row k moved by steps[k] to both sides; rows that leave the support
/// are zero.
Task<DenseMatrix> negative_hessian(Walker& walker, const Vector& steps) {
    const Vector x = position_of(walker, walker.current);
    DenseMatrix hessian = DenseMatrix::Zero(x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k)
        for (const double side : {1.0, -1.0}) {
            Vector moved = x;
            moved[k] += side * steps[k];
            set_trial(walker, moved);
            co_await walker.evaluate(walker.trial);
            const Vector gradient = gradient_of(walker, walker.trial);
            if (gradient.allFinite())
                hessian.row(k) -= side * gradient.transpose() / (2 * steps[k]);
        }
    co_return DenseMatrix((hessian + hessian.transpose()) / 2);
}

/// Row-major covariance (or variances) with every standard deviation below `widest`.
std::vector<double> covariance_of(const DenseMatrix& hessian, MetricShape shape) {
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> solver(hessian);
    const Vector scales = solver.eigenvalues().cwiseAbs().cwiseMax(1 / (widest * widest));
    const DenseMatrix covariance = solver.eigenvectors() *
                                   scales.cwiseInverse().asDiagonal() *
                                   solver.eigenvectors().transpose();
    std::vector<double> values;
    if (shape == MetricShape::diagonal)
        values.assign(
            covariance.rows() > 0 ? static_cast<std::size_t>(covariance.rows()) : 0, 0);
    for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
        if (shape == MetricShape::diagonal)
            values[static_cast<std::size_t>(k)] = 1 / std::max(hessian(k, k), scales[0]);
        else
            for (Eigen::Index j = 0; j < covariance.cols(); ++j)
                values.push_back(0.5 * (covariance(k, j) + covariance(j, k)));
    }
    return values;
}

/// Uphill until it hardly rises.
Task<> climb_on(Walker& walker) {
    Moves moves;
    int n_idle = 0;
    for (int k = 0; k < most_iterations && n_idle < patience; ++k) {
        const Vector x = position_of(walker, walker.current);
        const Vector gradient = let_move(walker, gradient_of(walker, walker.current));
        const double value = walker.log_density(walker.current);
        const bool is_first = moves.is_empty();
        const Vector direction =
            let_move(walker, moves.direction(gradient, walker.metric));
        const bool has_risen = co_await step_up(walker, bounded(direction, is_first));
        if (!has_risen && is_first) break;
        if (!has_risen) {
            moves.forget();
            ++n_idle;
            continue;
        }
        std::swap(walker.current, walker.trial);
        moves.add(position_of(walker, walker.current) - x,
                  gradient - let_move(walker, gradient_of(walker, walker.current)));
        const double rise = walker.log_density(walker.current) - value;
        n_idle = rise < least_rise ? n_idle + 1 : 0;
    }
}

/// Sets the metric to the inverse of the negative DenseMatrix at the current point.
Task<> learn_curvature(Walker& walker) {
    const auto n = index(walker.metric.size());
    const DenseMatrix rough =
        co_await negative_hessian(walker, Vector::Constant(n, 1e-4));
    const Vector steps =
        rough.diagonal().cwiseAbs().cwiseMax(1).cwiseSqrt().cwiseInverse().cwiseMax(1e-4);
    const DenseMatrix hessian = co_await negative_hessian(walker, steps);
    if (hessian.allFinite())
        walker.metric.set_covariance(covariance_of(hessian, walker.metric.shape()));
}

}  // namespace

Task<> climb(Walker& walker) {
    if (walker.metric.size() == 0) co_return;  // whole numbers only
    co_await climb_on(walker);
    for (int k = 1; k < most_climbs; ++k) {
        const double value = walker.log_density(walker.current);
        co_await learn_curvature(walker);
        co_await climb_on(walker);
        if (walker.log_density(walker.current) - value < 1) break;
    }
}

Task<> leave_mode(Walker& walker) {
    if (walker.metric.size() == 0) co_return;
    std::vector<double> normals(walker.metric.size());
    fill_standard_normal(walker.random, normals);
    walker.trial.x = walker.current.x;
    walker.metric.move(walker.trial.x, 1, normals);
    co_await walker.evaluate(walker.trial);
    const double most_fall = 10.0 * static_cast<double>(walker.metric.size());
    if (gradient_of(walker, walker.trial).allFinite() &&
        walker.log_density(walker.trial) > walker.log_density(walker.current) - most_fall)
        std::swap(walker.current, walker.trial);
}

}  // namespace bemcal::sampling
