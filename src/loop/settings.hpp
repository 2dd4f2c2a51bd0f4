/// Set-points and set-backs that the readings deny: a setting is known to whoever
/// described it, so that one far from it is a finding and no calibration.
#pragma once

#include "base/nan.hpp"
#include "physics/parameters.hpp"
#include "study/fit_model.hpp"

#include <optional>
#include <string>

namespace bemcal::loop {

/// A setting as it is described, and as the readings have it.
struct Setting {
    std::string name;       ///< "heating set-back of zone office"
    std::string parameter;  ///< that calibrated it
    std::string unit;
    double described = nan, found = nan;
    double least = nan, most = nan;  ///< 90 % interval
    double distance = nan;           ///< from the prior's mean [its standard deviation]
};

/// None where the parameter sets no set-point or set-back alone, or ended near its prior.
/// \param described  the building as described
/// \param x          where the fit ended [prior standard deviations from the mean]
/// \param deviation  of the parameter, by the fit [its unit]
std::optional<Setting> denied_setting(const physics::Building& described,
                                      const physics::Parameter& parameter,
                                      const study::FitUnknown& unknown, double x,
                                      double deviation);

}  // namespace bemcal::loop
