/// Readings of a building as one series, which an emulator of another program learns.
#pragma once

#include "emulator/series_emulator.hpp"
#include "study/case.hpp"

#include <vector>

namespace bemcal::study {

/// Of the runs' variance that is emulated: errors that remember each other let small
/// changes from hour to hour speak, so a tenth of the usual is left out.
inline constexpr double share_emulated = 1 - 1e-6;

/// How readings of a building stand in a series: period after period, in each meter after
/// meter.
class SeriesLayout {
  public:
    /// \param meters  of the building, rising
    SeriesLayout(const Case& building, std::vector<std::size_t> meters);

    std::size_t size() const { return size_; }
    const std::vector<std::size_t>& meters() const { return meters_; }
    /// Of the period of that name. [meters]
    const std::vector<emulator::ChannelRange>& ranges(const Case& building,
                                                      const Period& period) const;
    /// A run's readings. [size] \param hours  [meters][hours of all periods]
    std::vector<double> series(const Case& building,
                               const std::vector<std::vector<double>>& hours) const;
    /// 1 / standard deviation of a reading before the data. All meters weigh alike,
    /// however often they are read. [size]
    std::vector<double> weights(const Case& building) const;

  private:
    std::vector<std::size_t> meters_;
    std::vector<std::vector<emulator::ChannelRange>> ranges_;  ///< [periods][meters]
    std::size_t size_ = 0;
};

}  // namespace bemcal::study
