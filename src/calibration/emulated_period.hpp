/// A period of another program's model, by an emulator of its hours.
#pragma once

#include "calibration/period_model.hpp"
#include "study/series_layout.hpp"

#include <memory>

namespace bemcal::calibration {

/// \param building  with the program's parameters, and the meters that it has hours of
/// \param layout    of all of its meters   \param emulator  of such series over the
/// parameters on the scale 0 to 1; it may be null until points are asked for
std::unique_ptr<PeriodModel> emulated_period_model(
    const study::Case& building, const study::Period& period,
    const study::SeriesLayout& layout,
    std::shared_ptr<const emulator::SeriesEmulator> emulator);

}  // namespace bemcal::calibration
