/// EnergyPlus weather files (EPW): one year or a chain of years, read and completed.
///
/// EnergyPlus Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary". Rows
/// end at their hour and stand in local standard time; the summer time of the header is
/// not applied. The ground's reflectance is not read (files often give 0 or 999):
/// Site::albedo.
#pragma once

#include "physics/weather.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

/// A row's temperature is an instant's, at the end of its hour. Mean of both ends, or as
/// read.
enum class TemperatureConvention { hour_mean, as_read };

struct EpwOptions {
    TemperatureConvention temperature = TemperatureConvention::hour_mean;
    int year = 0;  ///< of the first row; 0 = as the first row says (rows may come from
                   ///< many years)
    int longest_gap = 3;  ///< that is interpolated [h]
};

struct EpwFile {
    physics::Weather weather;  ///< irradiance complete, temperature without gaps
    std::string place;         ///< as in the header
    /// What was filled, derived or ignored: one sentence each.
    std::vector<std::string> decisions;
};

/// A file's content, unpacked, and its name for messages.
struct EpwText {
    std::string name;
    std::string_view text;
};

/// One or more files that follow each other in time, of one place; each of whole years or
/// a part of one. Hours that two of them have are taken once if they are alike.
/// Throws UserError (data) with file:row:column, what is wrong, why, and what to write
/// instead.
EpwFile parse_epw_chain(const std::vector<EpwText>& files,
                        const EpwOptions& options = {});

}  // namespace bemcal::input
