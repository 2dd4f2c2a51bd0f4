/// Log density of scaled residuals with a slow part, by the Kalman filter of (a, m, d),
/// and its way back. Internal to the residual model.
///
/// Where the gain has settled it is held to the end of the stretch of readings; the way
/// back differentiates what was done: all held readings act on the one covariance that
/// their gain came from. A lane settles by itself: while its neighbours still move it
/// repeats its covariance.
#pragma once

#include "stats/residual_model_covariance.hpp"
#include "stats/residual_model_scale.hpp"

#include <vector>

namespace bemcal::stats::residual {

/// Scratch of a filter: rows of `width`.
struct FilterScratch {
    double* states;            ///< [3 (n_present + 1)] after each reading; the first is 0
    double* records;           ///< [7 n_present] covariances, and whether repeated
    std::size_t* records_end;  ///< [stretches]
    static constexpr std::size_t rows_for(std::size_t n) { return 3 * (n + 1) + 7 * n; }
};

class Filter {
  public:
    /// \param tolerance  relative change of the gain that counts as settled; -1: none
    /// does
    Filter(const ReadingTimes& times, const ParameterLanes& parameters, double tolerance,
           const Scaled& scaled, const FilterScratch& scratch);

    /// Without the constants of 2 pi.
    Lanes log_density();
    /// After log_density(): writes scaled.slope, adds to the derivative by parameter.
    void pull_back(ParameterLanes& derivative);

  private:
    struct Forward;
    struct Backward;
    void read(std::size_t begin, std::size_t end, const Transition& transition,
              const Gain& gain, Forward& now) const;
    void read_stretch(const ReadingTimes::Stretch& stretch, Forward& now) const;
    void unread(std::size_t begin, std::size_t end, std::size_t kind, Backward& now);
    void unread_stretch(std::size_t index, Backward& now);
    void undo_prediction(std::size_t record, std::size_t kind, Backward& now);

    const ReadingTimes& times_;
    const ParameterLanes& parameters_;
    double tolerance_;
    Scaled scaled_;
    FilterScratch scratch_;
    std::vector<Motion> motions_, slopes_;  ///< one for each of times.gaps
};

}  // namespace bemcal::stats::residual
