/// Steps in a meter's scale: from one reading to the next everything it shows, base load
/// and hours of the day alike, is another by one factor, and stays so.
///
/// Windows of four weeks on either side are compared by hour of day and kind of day.
/// Seasons, holidays and schedules change some hours more than others, or come gradually,
/// or go again: each of these rules a step out. Factors below 2 are not sought: they are
/// as likely a change of the building. Leaves out series that are 0 most of the time.
#pragma once

#include "checks/data_readings.hpp"

namespace bemcal::checks {

/// What else shows that it is the scale and no season that changed.
enum class Proof {
    none,
    scatter,  ///< weather moves the days on both sides, and alike: no heating season
              ///< begins
    years,    ///< low and high season of the years around it changed alike
    quantum   ///< the rounding of the readings changed by the same factor
};

struct ScaleStep {
    int at = 0;        ///< first reading after it
    double ratio = 1;  ///< after / before, of a week on either side
    Proof proof = Proof::none;
};

/// In the order of time, four weeks apart at least. A step that only one of the seasons
/// shows, with a year on either side, is none; nor is one of a weather-driven meter
/// without a proof, or below a factor of 8 with scatter alone: heating seasons begin so.
std::vector<ScaleStep> scale_steps(const DataSeries& series);

}  // namespace bemcal::checks
