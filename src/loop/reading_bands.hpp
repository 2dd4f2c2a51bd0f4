/// How far readings may lie from what a model predicts: intervals for hours and months,
/// learned from what blocks of training were that the model had not seen.
#pragma once

#include "physics/calendar.hpp"

#include <span>
#include <vector>

namespace bemcal::loop {

/// The hours of a channel in training.
struct UnseenHours {
    std::vector<physics::Seconds> begins;  ///< [hours]
    std::vector<double> predicted;         ///< [hours]
    std::vector<double> residuals;  ///< [hours] measured less predicted, of a fit to
                                    ///< other blocks; NaN = nothing is read
};

struct Band {
    double least = 0, most = 0;
};

class ReadingBands {
  public:
    /// \param is_mean  of a temperature: a month is the mean of its hours, else the sum
    ReadingBands(const UnseenHours& hours, bool is_mean);

    /// The 90 % interval of an hour's reading; NaN where training has too few.
    /// \param level  standard deviation of the level beside training's, as a share of
    /// what
    ///               is predicted
    Band hour(double predicted, physics::Seconds begin, double level = 0) const;
    /// The same of a month, or of a part of one. \param predicted  its sum or mean
    Band month(double predicted, double level = 0) const;

    /// Of many. [hours], [months]
    std::vector<Band> hours(std::span<const double> predicted,
                            std::span<const physics::Seconds> begins, double level) const;
    std::vector<Band> months(std::span<const double> predicted, double level) const;

  private:
    std::size_t kind_of(double predicted, physics::Seconds begin) const;

    std::vector<double> edges_;  ///< of levels of the prediction, rising
    std::vector<Band> of_kind_;  ///< [levels x day or night] residuals
    bool is_mean_;
    double month_ = 0;  ///< standard deviation of a month's residual: of a mean; of a sum
                        ///< over the square root of what is predicted
};

/// Which share of the readings lies within their bands, of those that are known; NaN of
/// none.
double share_within(std::span<const Band> bands, std::span<const double> measured);

}  // namespace bemcal::loop
