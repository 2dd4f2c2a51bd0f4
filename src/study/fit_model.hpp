/// A building over its training period as a least-squares problem: what its meters would
/// read as a function of unknowns in prior standard deviations, with derivatives by
/// differences. The lanes of the fast simulation carry the points of a difference.
#pragma once

#include "base/matrix.hpp"
#include "kernel/response.hpp"
#include "stats/prior.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// A parameter seen by a fit: value = centre + scale x.
struct FitUnknown {
    std::string name, unit;
    double centre = 0, scale = 1;  ///< the prior's mean and standard deviation
    double least = 0, most = 1;    ///< in the parameter's unit
    bool has_prior = true;         ///< else scale is a typical size only

    double value(double x) const { return centre + scale * x; }
    double within(double x) const { return std::clamp(value(x), least, most); }
    double lowest() const { return (least - centre) / scale; }
    double highest() const { return (most - centre) / scale; }
};

/// An unknown with the prior of a parameter; a uniform one is none.
FitUnknown unknown_of(const physics::Parameter& parameter, const stats::Prior& prior);

/// Readings of all meters over a period, one after the other.
struct Targets {
    std::vector<kernel::Channel> channels;
    std::vector<std::size_t> first;  ///< [channels + 1] where a channel's begin
    std::vector<double> measured;    ///< NaN = missing

    std::size_t size() const { return measured.size(); }
    std::size_t n_channels() const { return channels.size(); }
    std::span<const double> of(std::size_t channel, std::span<const double> all) const {
        return all.subspan(first[channel], first[channel + 1] - first[channel]);
    }
};

class FitModel {
  public:
    /// The building and the drive must outlive it. Channels may have no readings.
    FitModel(const physics::Building& building,
             std::vector<physics::Parameter> parameters, const physics::Drive& drive,
             std::vector<kernel::Channel> channels);

    std::size_t n_parameters() const { return parameters_.size(); }
    std::size_t n_readings() const { return first_.back(); }
    const std::vector<std::size_t>& first() const { return first_; }

    /// [points x n_readings]; a row of NaN where a point is impossible.
    Matrix predict(const Matrix& points) const;

    /// The same, handed over point by point: rows that live until the next.
    using Take = std::function<void(std::size_t point, std::span<const double> row)>;
    void predict_each(const Matrix& points, const Take& take) const;

  private:
    std::vector<physics::Parameter> parameters_;
    std::unique_ptr<kernel::Batch> batch_;
    std::unique_ptr<kernel::Response> response_;
    std::vector<std::size_t> first_;
    mutable kernel::Response::RunPointer run_;  ///< scratch: a model is of one thread
};

/// Where a fit stands: unknowns, predictions, their derivatives by the unknowns. What is
/// not known is empty.
struct Linearised {
    std::vector<double> x{};          ///< [p]
    std::vector<double> predicted{};  ///< [n]
    Matrix derivatives{};             ///< [p x n]; rows of 0 where a difference failed
    bool by_secants = false;          ///< derivatives are not by differences at x

    bool has_derivatives() const { return derivatives.cols > 0; }
};

struct FitOptions {
    int most_steps = 8;
    double tolerance = 1e-3;  ///< a step that lowers the objective by less ends the fit
    bool derivatives = true;  ///< whether they are wanted where it ends
};
inline constexpr bool without_derivatives = false;

struct Fit {
    Linearised at;
    double objective = 0;     ///< sum w r^2 + sum x^2 of those with a prior
    bool failed = false;      ///< not even the start could be simulated
    std::vector<char> bound;  ///< [p] 1 = held at an end of its range
};

/// Simulates the predictions where they are not known yet; NaN where x is impossible.
void predict_at(const FitModel& model, std::span<const FitUnknown> unknowns,
                Linearised& at);

/// The same, and derivatives, which are by differences then.
void linearise(const FitModel& model, std::span<const FitUnknown> unknowns,
               Linearised& at);

/// Levenberg-Marquardt within the ranges: four damped steps are simulated at once, and
/// the best is taken.
/// \param weights  [n], 0 = not fitted
/// \param start    [p]
Fit fit(const FitModel& model, std::span<const FitUnknown> unknowns,
        std::span<const double> measured, std::span<const double> weights,
        std::vector<double> start, const FitOptions& options = {});
/// The same from where a fit of the same model stands: what is known is not simulated.
Fit fit(const FitModel& model, std::span<const FitUnknown> unknowns,
        std::span<const double> measured, std::span<const double> weights,
        Linearised start, const FitOptions& options = {});

/// measured - predicted; 0 where nothing is measured. [n]
std::vector<double> residuals_of(std::span<const double> measured,
                                 std::span<const double> predicted);

/// What the prior adds to the normal equations. [p]
std::vector<double> prior_diagonal(std::span<const FitUnknown> unknowns);

}  // namespace bemcal::study
