/// What models predict of a building's meters, hour by hour and by the month, held
/// against the readings: errors, intervals, coverage, series, as a loop stores them.
#pragma once

#include "loop/baseline.hpp"
#include "loop/reading_bands.hpp"
#include "loop/stored_loop.hpp"
#include "stats/metrics.hpp"
#include "study/summary.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::loop {

/// Of a period.
struct ModelHours {
    std::vector<std::vector<std::vector<double>>> models;  ///< [models][channels][hours]
    std::vector<double> outdoors;  ///< [hours] mean outdoor temperature
};

/// Mean outdoor temperature of each hour of the drive's period.
std::vector<double> outdoors_of(const physics::Drive& drive);

/// Of training. [channels] \param predicted, left_out  [targets.size()] what a model
/// says, and its residuals in blocks that it had not seen
std::vector<UnseenHours> unseen_of(const LoopData& data,
                                   std::span<const double> predicted,
                                   std::span<const double> left_out);

class FitsWriter {
  public:
    /// \param data        what was searched
    /// \param readings    the building with the readings that models are held against
    /// \param unseen      [channels] of the last model
    /// \param hours_late  of the meters' clocks
    /// \param stored      its fit and coverage are filled; must outlive this
    FitsWriter(const LoopData& data, const study::Case& readings,
               const std::vector<UnseenHours>& unseen, int hours_late,
               StoredLoop& stored);

    /// Its errors, and what is stored of its hours. In the order of the case's periods.
    StoredPeriod add(const study::Period& period, const ModelHours& hours);

  private:
    struct FitPlace {
        std::size_t model, period, resolution, channel;
    };
    void set_fit(const FitPlace& at, const stats::FitMetrics& metrics);
    double level_of(const study::Period& period, std::size_t channel) const;
    StoredPeriod::Channel channel_of(std::size_t channel,
                                     const std::vector<double>& measured,
                                     const ModelHours& hours) const;
    void add_hours(const std::vector<Band>& bands, StoredPeriod::Channel& channel) const;

    const LoopData& data_;
    const study::Case& readings_;
    std::vector<ReadingBands> bands_;  ///< [channels]
    int hours_late_;
    StoredLoop& stored_;
    std::size_t period_ = 0;  ///< the next one
};

/// What the last model says, and by the hour its errors beside the plain model's.
study::Summary summary_of(const std::string& stage, const LoopData& data,
                          const StoredLoop& stored);

}  // namespace bemcal::loop
