/// Runs of paper 1's single hour for an emulator: every design of the calibrated inputs
/// at every field point (eq. 2).
#pragma once

#include "posterior/koh_options.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::posterior {

struct OfficeHourDesign {
    std::size_t n_designs = 100;
    std::uint64_t seed = 0;
    /// Inputs that are neither known nor calibrated, by name.
    std::vector<std::pair<std::string, double>> fixed;
};

/// The calibrated inputs by name, each with its unit and uniform in the range of Table 2.
/// Throws std::invalid_argument for a name that is not one of the 19.
std::vector<study::Coordinate> office_hour_coordinates(
    const std::vector<std::string>& names);

/// Simulates a scrambled Sobol design over those ranges; fills the simulated parts of the
/// observations. x_names, t_names and measured_x are given. Throws std::invalid_argument
/// where an input is left over or stands twice, or where the box is impossible.
void add_office_hour_runs(const OfficeHourDesign& design,
                          emulator::Observations& observations);

}  // namespace bemcal::posterior
