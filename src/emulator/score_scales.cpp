/// Scores' lengths, slopes and nugget by the restricted marginal likelihood, in which
/// constant and variance are integrated out and at their best, times weak priors of
/// the scales' logarithms: few runs alone do not tell a dozen lengths.
/// Sources: Rasmussen and Williams 2006, eq. 2.45, 5.9; the lengths' prior: Hvarfner,
/// Hellsten and Nardi 2024. Left out: their uncertainty; other maxima than two starts
/// find.
#include "emulator/ascent.hpp"
#include "emulator/eigen_views.hpp"
#include "emulator/score_process.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace bemcal::emulator {
namespace {

/// Normal, of a logarithm.
struct LogPrior {
    double mean, sd;
};

/// Of lengths: log-normal, sqrt(2) + log(parameters) / 2 and sqrt(3) (Hvarfner et al.):
/// distances grow with the root of the number of parameters.
LogPrior prior_of_length(std::size_t n_parameters) {
    return {std::sqrt(2.0) + std::log(static_cast<double>(n_parameters)) / 2,
            std::sqrt(3.0)};
}
/// Most outputs of a building are nearly linear in its parameters: slopes are expected
/// to be several times what bends, and may well be a hundredth or a hundred times it.
const LogPrior prior_of_slopes{std::log(10.0), 3};
/// A thousandth of the spread in its standard deviation, within a factor of 20 or so.
const LogPrior prior_of_nugget{std::log(1e-6), 3};
/// Added to each nugget: a covariance of 120 runs is positive definite in double
/// precision with it, also where two are at one point.
constexpr double least_nugget = 1e-8;
/// The second start's lengths, by which neighbours know of each other only.
constexpr double short_length = 0.5;

/// The unknowns: logarithms of the lengths, of the slopes' variance, of the nugget above
/// the least one.
class ScaleDensity {
  public:
    ScaleDensity(const Matrix& points, const Matrix& scores);

    Eigen::Index n_unknowns() const { return squares_.cols() + 2; }
    Eigen::VectorXd prior_mean() const { return mean_; }
    /// Log density but for a constant; -inf where the covariance is not definite.
    double evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& gradient);

  private:
    void fill_covariance(const Eigen::VectorXd& at);
    double add_priors(const Eigen::VectorXd& at, Eigen::VectorXd& gradient) const;

    Eigen::Index n_;
    Eigen::MatrixXd scores_;    ///< [runs x scores]
    Eigen::MatrixXd squares_;   ///< [pairs x parameters] (a - b)^2, by columns of K
    Eigen::MatrixXd products_;  ///< [runs x runs] from the middle
    Eigen::VectorXd mean_, sd_;
    Eigen::MatrixXd covariance_;
    Eigen::VectorXd slopes_;  ///< [pairs] of the correlation, by the squared distance
};

ScaleDensity::ScaleDensity(const Matrix& points, const Matrix& scores)
    : n_(eigen_index(points.rows)),
      scores_(eigen_view(scores).transpose()),
      squares_(n_ * (n_ - 1) / 2, eigen_index(points.cols)),
      covariance_(n_, n_) {
    const Eigen::MatrixXd x = eigen_view(points).array() - 0.5;
    products_ = x * x.transpose();
    for (Eigen::Index j = 0, first = 0; j < n_; first += n_ - 1 - j, ++j)
        for (Eigen::Index i = j + 1; i < n_; ++i)
            squares_.row(first + i - j - 1) = (x.row(i) - x.row(j)).cwiseAbs2();
    const LogPrior length = prior_of_length(points.cols);
    mean_ = Eigen::VectorXd::Constant(n_unknowns(), length.mean);
    sd_ = Eigen::VectorXd::Constant(n_unknowns(), length.sd);
    mean_.tail(2) << prior_of_slopes.mean, prior_of_nugget.mean;
    sd_.tail(2) << prior_of_slopes.sd, prior_of_nugget.sd;
}

/// Its lower triangle.
void ScaleDensity::fill_covariance(const Eigen::VectorXd& at) {
    const Eigen::Index p = squares_.cols();
    const Eigen::VectorXd rates = (-2 * at.head(p)).array().exp();
    const Eigen::ArrayXd r = (5 * (squares_ * rates)).array().sqrt();
    const Eigen::ArrayXd decay = (-r).exp();
    const Eigen::ArrayXd correlations = (1 + r + r.square() / 3) * decay;
    slopes_ = -5. / 6 * (1 + r) * decay;
    covariance_ = std::exp(at[p]) * products_;
    covariance_.diagonal().array() += 1 + least_nugget + std::exp(at[p + 1]);
    for (Eigen::Index j = 0, first = 0; j < n_; first += n_ - 1 - j, ++j)
        covariance_.col(j).tail(n_ - 1 - j).array() +=
            correlations.segment(first, n_ - 1 - j);
}

double ScaleDensity::add_priors(const Eigen::VectorXd& at,
                                Eigen::VectorXd& gradient) const {
    const Eigen::VectorXd away = (at - mean_).cwiseQuotient(sd_);
    gradient -= away.cwiseQuotient(sd_);
    return -away.squaredNorm() / 2;
}

double ScaleDensity::evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    const Eigen::Index p = squares_.cols();
    fill_covariance(at);
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance_);
    if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(n_, n_));
    const Eigen::VectorXd of_one = inverse.rowwise().sum();
    const double of_constant = of_one.sum();
    const Eigen::MatrixXd solved =
        inverse * scores_ - of_one * (of_one.transpose() * scores_ / of_constant);
    const double dof = static_cast<double>(n_ - 1),
                 n_scores = static_cast<double>(scores_.cols());
    const Eigen::VectorXd variances =
        scores_.cwiseProduct(solved).colwise().sum().transpose() / dof;
    // d log density = sum of W dK / 2
    Eigen::MatrixXd W =
        solved * variances.cwiseInverse().asDiagonal() * solved.transpose();
    W -= n_scores * inverse;
    W += of_one * (n_scores / of_constant * of_one).transpose();
    Eigen::VectorXd of_pairs(squares_.rows());
    for (Eigen::Index j = 0, first = 0; j < n_; first += n_ - 1 - j, ++j)
        of_pairs.segment(first, n_ - 1 - j) = W.col(j).tail(n_ - 1 - j);
    gradient.head(p) = -2 * (squares_.transpose() * of_pairs.cwiseProduct(slopes_));
    gradient.head(p).array() *= (-2 * at.head(p)).array().exp();
    gradient[p] = std::exp(at[p]) / 2 * W.cwiseProduct(products_).sum();
    gradient[p + 1] = std::exp(at[p + 1]) / 2 * W.trace();
    const double log_determinant =
        2 * factor.matrixLLT().diagonal().array().log().sum() + std::log(of_constant);
    return add_priors(at, gradient) -
           (dof * variances.array().log().sum() + n_scores * log_determinant) / 2;
}

}  // namespace

ScoreScales learn_scales(const Matrix& points, const Matrix& scores) {
    ScaleDensity density(points, scores);
    const auto function = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
        return density.evaluate(at, gradient);
    };
    const Eigen::Index p = eigen_index(points.cols);
    Eigen::VectorXd short_start = density.prior_mean();
    short_start.head(p).setConstant(std::log(short_length));
    Summit best = ascend(function, density.prior_mean());
    const Summit other = ascend(function, short_start);
    if (other.value > best.value) best = other;
    const Eigen::VectorXd lengths = best.at.head(p).array().exp();
    return {{lengths.begin(), lengths.end()},
            std::exp(best.at[p]),
            least_nugget + std::exp(best.at[p + 1])};
}

}  // namespace bemcal::emulator
