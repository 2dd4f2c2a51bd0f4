/// What acts on a building, step by step: made once for a building and a period, then
/// shared by all points. Warm-up steps stand first.
#pragma once

#include "base/matrix.hpp"
#include "physics/building.hpp"
#include "physics/plane_source.hpp"
#include "physics/schedule.hpp"
#include "physics/weather.hpp"

#include <vector>

namespace bemcal::physics {

/// A row of Drive::profiles before it is laid on an axis: a schedule or a measured
/// series.
struct Profile {
    std::string name;
    bool is_series = false;
    Schedule schedule;           ///< where not is_series
    TimeAxis axis;               ///< of the series
    std::vector<double> values;  ///< of the series; NaN = missing (an error if needed)
};

constexpr double start_temperature = 20;  ///< where none is known [degC]

struct Drive {
    TimeAxis axis;      ///< all simulated steps, warm-up included
    int n_warm_up = 0;  ///< steps before the period that is asked for
    double theta_start = start_temperature;  ///< of all nodes before the warm-up [degC]
    std::vector<double> theta_e;             ///< [n_steps] outdoor air temperature [degC]
    std::vector<double> w_e;   ///< its humidity ratio [kg/kg]; empty where the weather
                               ///< does not say
    double pressure = 101325;  ///< of the air [Pa]
    std::vector<double> theta_rm;  ///< [n_steps] running mean of theta_e (season) [degC]
    Matrix irradiance;             ///< [n_planes x n_steps] on Building::planes [W/m2]
    Matrix profiles;               ///< [n_profiles x n_steps]
    int n_steps() const { return axis.n_steps; }
    /// The steps that are asked for, without the warm-up.
    TimeAxis period() const {
        return {axis.begin_of(n_warm_up), axis.step_s, n_steps() - n_warm_up};
    }
    double profile_at(int profile, int step) const {
        return profiles(static_cast<std::size_t>(profile),
                        static_cast<std::size_t>(step));
    }
    double at(const Input& input, int step) const {
        if (input.is_changed()) return changed(input, step);
        if (input.profile < 0) return input.value;
        return input.low + (input.value - input.low) * profile_at(input.profile, step);
    }

  private:
    double changed(const Input& input, int step) const;
};

/// An air change at a step [1/h]. Effects that would take more air than flows leave none;
/// what is described below 0 stays so, and is refused where it flows.
inline double air_change_at(const Drive& drive, const Input& air_change, int step) {
    const double n = drive.at(air_change, step);
    return air_change.is_changed() && n < 0 ? 0 : n;
}

/// How many whole hours before `from`, at most `most`, weather and series cover without a
/// gap.
int known_hours_before(const Weather& weather, const Building& building,
                       const std::vector<Profile>& profiles, Seconds from, int most);

/// Lays weather and profiles on the steps [from, to), with `n_warm_up_hours` before them:
/// the real hours before `from` as far as weather and series have them; before these the
/// first hours of the period, repeated, or those 52 weeks later where it is that long.
/// Steps shorter than an hour: temperature linear between the hours' middles, irradiance
/// and schedules held. Throws std::invalid_argument where a needed value is missing.
/// \param planes  of this very weather, if somebody has them; nullptr: they are computed
Drive make_drive(const Weather& weather, const Building& building,
                 const std::vector<Profile>& profiles, Seconds from, Seconds to,
                 int step_s, int n_warm_up_hours, SkyModel sky = SkyModel::perez,
                 PlaneSource* planes = nullptr);

}  // namespace bemcal::physics
