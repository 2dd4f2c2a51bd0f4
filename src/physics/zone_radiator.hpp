/// A zone's radiator on its way through time: the plain hour with the heat of a radiator
/// in place of a thermostat's.
///
/// Radiator and room act on each other within a step, so each step is made twice: with
/// the room as the step before left it, then with the temperatures that this gave.
/// Whether the heating is on follows the air of the step before. Radiant heat meets
/// theta_s, and is split over surfaces and mass as the standard splits radiant gains.
/// Left out: thermostatic valves, and what the pipes lose.
#pragma once

#include "physics/drive.hpp"
#include "physics/structure.hpp"

#include <functional>
#include <span>
#include <vector>

namespace bemcal::physics {

class RadiatorRun {
  public:
    /// The radiator must outlive it. Throws CannotSimulate where it is none.
    RadiatorRun(const ZoneRadiator& radiator, double theta_start);

    /// The zone's hour for what drives it.
    using Room = std::function<StepResult(const HourDrive&)>;
    /// A step of room and radiator; its heating is what the water has lost, or 0 where
    /// the radiator was warmer than its water.
    StepResult advance(const Drive& drive, int step, HourDrive hour, const Room& room);

    /// Its elements, then air and surfaces of the step before [degC]. [n_states]
    std::size_t n_states() const { return elements_.size() + 2; }
    void write_state(std::span<double> state) const;
    void set_state(std::span<const double> state);

  private:
    RadiatorSurroundings surroundings(const Drive& drive, int step) const;

    const ZoneRadiator* radiator_;
    std::vector<double> elements_;      ///< [degC]
    double theta_air_, theta_surface_;  ///< of the step before [degC]
};

}  // namespace bemcal::physics
