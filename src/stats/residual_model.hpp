/// The likelihood of a meter: how far readings may stray from predictions, and how that
/// hangs together in time.
///
/// A reading y_t of a prediction f_t has the scale s_t^2 = (constant scale)^2 +
/// (proportional f_t)^2. The scaled residual z_t = (y_t - f_t) / s_t has variance 1: a
/// short memory (white, or AR(1) with the correlation phi from one reading to the next),
/// and, with `discrepancy`, a slow part: a share of its variance is a Gaussian process in
/// time with the Matern-3/2 covariance, in state-space form (Hartikainen and Sarkka 2010,
/// doi:10.1109/MLSP.2010.5589113), O(n) in the readings. Missing readings are gaps: time
/// goes on through them.
///
/// All arrays are [rows x lanes]; a lane's bits depend on that lane only.
#pragma once

#include "stats/residual_model_options.hpp"
#include "stats/residual_model_times.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::stats {

class ResidualModel {
  public:
    /// \param measured  NaN = missing   \param scale  of the constant part, in the
    /// meter's unit: a typical reading, or 1 K
    ResidualModel(std::vector<double> measured, double scale, ResidualOptions options);

    std::size_t n_readings() const { return measured_.size(); }
    std::size_t n_present() const { return times_.n_present(); }  ///< not missing
    std::size_t n_parameters() const;
    const ResidualOptions& options() const { return options_; }

    /// Scratch of a thread.
    struct Work {
        std::vector<double> doubles;
        std::vector<std::size_t> indices;
    };

    /// \param predictions  [n_readings x lanes]   \param parameters  [n_parameters x
    /// lanes]
    /// \param values  [lanes] log likelihood, 0 where all readings are missing; -inf,
    /// with derivatives of 0, where a scale is not above 0, a prediction not finite, or a
    /// parameter out of range
    /// \param by_prediction  [n_readings x lanes] d value / d prediction, or nullptr
    /// \param by_parameter  [n_parameters x lanes] d value / d parameter, or nullptr
    void log_likelihood(const double* predictions, const double* parameters, int lanes,
                        double* values, double* by_prediction, double* by_parameter,
                        Work& work) const;

    /// Readings as the model would draw them: prediction plus residual, at every time,
    /// missing or not. \param normals  [n_normals()] independent standard normals
    std::vector<double> draw(std::span<const double> prediction,
                             std::span<const double> parameters,
                             std::span<const double> normals) const;
    std::size_t n_normals() const;

  private:
    std::vector<double> measured_;
    double scale_;
    ResidualOptions options_;
    ReadingTimes times_;
};

}  // namespace bemcal::stats
