/// What effects follow: the series of a period on the steps of its drive.
#pragma once

#include "effects/effect.hpp"
#include "physics/drive.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::effects {

/// Series that only a calibrated model knows, of the drive's steps.
struct ModelSeries {
    std::vector<double> heating, cooling;       ///< [n_steps] W; empty = not known yet
    double most_heating = 0, most_cooling = 0;  ///< in training [W]: one scale for all
};

struct Surroundings {
    const physics::Building* building = nullptr;  ///< before effects
    const physics::Drive* drive = nullptr;        ///< of that building
    std::vector<physics::CalendarStep> calendar;  ///< [n_steps]
    std::vector<double> wind, moisture, sky_difference, sun_horizontal, ground;
    double mean_wind = 0;  ///< of all the weather [m/s]: the same for every period
    std::map<std::string, std::vector<double>> columns;
    ModelSeries model;
    physics::Seconds from{};  ///< where `elapsed` is 0: the first step of training
};

/// Wind, humidity and sky laid on the drive's steps, warm-up included; an hour's value
/// holds for its steps. Before the weather begins its first days repeat; gaps hold the
/// last value. A series that the weather lacks, or of which more than a tenth is missing,
/// stays empty, and no effect follows it. `ground`: theta_e before the weather begins is
/// taken to be as in its first year.
/// \param from  the beginning of training: the same for every period
Surroundings make_surroundings(const physics::Building& building,
                               const physics::Drive& drive,
                               const physics::Weather& weather, physics::Seconds from);

/// Whether all that the effect follows is there.
bool is_known(const Effect& effect, const Surroundings& surroundings);

/// shape(driver) x gate at every step [n_steps]. Throws std::invalid_argument where not
/// is_known.
std::vector<double> profile_of(const Effect& effect, const Surroundings& surroundings);

}  // namespace bemcal::effects
