/// A Gaussian process of one score over the parameters of an external simulator:
///
///     score = constant + slopes (x - 1/2) + smooth(x) + nugget
///
/// The constant has a flat prior and is integrated out. Slopes are normal with mean 0 and
/// one variance, so that they are known with any number of runs; smooth is Matern's
/// process of order 5/2 with a length for each parameter, which follows a simulator's
/// bends less stiffly than the squared exponential. The nugget takes up what is no
/// function of the parameters, such as a simulator's tolerances.
/// Sources: Rasmussen and Williams 2006, eq. 2.37-2.45, 4.17; leaving out: Dubrule 1983.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::emulator {

/// Of a process, in units of its variance. Parameters are on the scale 0 to 1.
struct ScoreScales {
    std::vector<double> lengths;  ///< [parameters]
    double slope_variance = 0;
    double nugget = 0;
};

/// Those of the highest posterior density, given scores that share them: each has its
/// own variance.
/// \param points  [runs x parameters], at least 2 runs   \param scores  [scores x runs]
ScoreScales learn_scales(const Matrix& points, const Matrix& scores);

class ScoreProcess {
  public:
    /// The nugget is raised where rounding would leave no positive definite covariance.
    /// Throws std::domain_error where no nugget does, as of scores that are no numbers.
    ScoreProcess(const Matrix& points, std::span<const double> scores,
                 const ScoreScales& scales);

    const ScoreScales& scales() const { return scales_; }
    double mean(std::span<const double> point) const;
    /// d mean / d point. [parameters]
    std::vector<double> gradient(std::span<const double> point) const;
    /// Of the score without its nugget.
    double variance(std::span<const double> point) const;
    /// Of what is no function of the parameters.
    double nugget_variance() const { return variance_ * scales_.nugget; }
    /// Where it is known to promise too much.
    void multiply_variance(double factor) { variance_ *= factor; }
    /// [runs] each run's score less its mean from the other runs, by the same scales.
    std::vector<double> leave_one_out() const;

  private:
    std::vector<double> covariances(std::span<const double> point) const;

    Matrix points_;
    ScoreScales scales_;
    Matrix factor_;  ///< L of the runs' covariance L L', in units of the variance
    std::vector<double> whitened_one_;  ///< L^-1 1
    double constant_ = 0, variance_ = 0;
    std::vector<double> solved_;  ///< K^-1 (scores - constant)
    std::vector<double>
        left_precisions_;  ///< diagonal of K^-1 - K^-1 1 1' K^-1 / 1'K^-1 1
};

}  // namespace bemcal::emulator
