/// EnergyPlus weather files (EPW): one year or a chain of years, read and completed.
///
/// EnergyPlus Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary". Rows
/// end at their hour and stand in local standard time; the summer time of the header is
/// not applied. The ground's reflectance is not read (files often give 0 or 999):
/// Site::albedo.
#pragma once

#include "physics/weather.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::job {

/// A row's temperature is an instant's, at the end of its hour. Mean of both ends, or as
/// read.
enum class TemperatureConvention { hour_mean, as_read };

struct EpwOptions {
    TemperatureConvention temperature = TemperatureConvention::hour_mean;
    int year = 0;  ///< of the first row; 0 = as the first row says (rows may come from
                   ///< many years)
};

struct EpwFile {
    physics::Weather weather;  ///< irradiance complete, temperature without gaps
    std::string place;         ///< as in the header
    /// What was filled, derived or ignored: one sentence each.
    std::vector<std::string> decisions;
};

/// Reads a file of one or more whole years. Throws UserError with file:row:column, what
/// is wrong, why, and what to write instead: no_input where it cannot be opened, data
/// otherwise.
EpwFile read_epw(const std::filesystem::path& file, const EpwOptions& options = {});

/// Several files that follow each other in time, of one place.
EpwFile read_epw_chain(const std::vector<std::filesystem::path>& files,
                       const EpwOptions& options = {});

/// The same for a text in memory. \param name  for messages
EpwFile parse_epw(std::string_view text, const std::string& name,
                  const EpwOptions& options = {});

}  // namespace bemcal::job
