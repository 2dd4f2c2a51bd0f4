/// What effects follow: the series of a period on the steps of its drive.
#pragma once

#include "effects/effect.hpp"
#include "physics/drive.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::effects {

/// Series that only a simulation knows, of the drive's steps.
struct ModelSeries {
    std::vector<double> heating, cooling;       ///< [n_steps] W; empty = not known yet
    double most_heating = 0, most_cooling = 0;  ///< the largest in training [W]
};

/// By which people live: days off and summer time.
struct WallClock {
    std::vector<physics::DateRange> holidays{};  ///< of any schedule
    std::string summer_time = "none";
    double utc_offset_h = 0;
};
WallClock wall_clock_of(const std::vector<physics::Profile>& profiles,
                        const physics::Site& site);

struct Surroundings {
    const physics::Building* building = nullptr;  ///< before effects
    const physics::Drive* drive = nullptr;        ///< of that building
    std::vector<physics::CalendarStep> calendar;  ///< [n_steps]
    /// Of every driver that the weather alone makes [n_steps]; empty where it lacks what
    /// that takes, and no effect follows it.
    std::map<Driver, std::vector<double>> weather;
    std::map<std::string, std::vector<double>> columns;
    ModelSeries model;
    WallClock clock;
    physics::Seconds from{};  ///< where `elapsed` is 0: the first step of training
};

}  // namespace bemcal::effects
