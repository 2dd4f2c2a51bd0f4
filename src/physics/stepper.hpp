/// A building on its way through time, one step at a time, written plainly: what
/// `simulate` does from end to end, stopped wherever its caller likes. All that a step
/// depends on is a state, which can be read and set.
#pragma once

#include "physics/drive.hpp"
#include "physics/structure.hpp"

#include <span>
#include <vector>

namespace bemcal::physics {

/// Other zones' air is what it was in the step before, so it must not hold a zone's own
/// more than its surfaces do. Throws CannotSimulate where all that ties the zone to
/// others [W/K] is above H_tr_is.
/// \param zone  in building.zones
/// \param H_tr_is  of that zone [W/K]
void reject_tight_coupling(const Building& building, const Drive& drive, std::size_t zone,
                           int step, double H_tr_is);

class Stepper {
  public:
    /// Starts with all nodes at drive.theta_start. Building and drive must outlive it.
    Stepper(const Building& building, const Drive& drive);
    Stepper(Stepper&&) noexcept;
    ~Stepper();

    std::size_t n_states() const;
    /// Zone by zone: mass, second mass and air [degC], what leaves the emitter [W], then
    /// a radiator's elements, air and surfaces as it saw them last [degC]. [n_states]
    void write_state(std::span<double> state) const;
    void set_state(std::span<const double> state);

    /// Makes a step and says what every zone did. [zones] Throws CannotSimulate where a
    /// zone leaves the method or a value is not finite, naming the zone and the step.
    std::span<const StepResult> advance(int step);

  private:
    class ZoneRun;
    std::vector<ZoneRun> zones_;
    std::vector<double> theta_air_;  ///< [zones] of the step before [degC]
    std::vector<StepResult> results_;
};

}  // namespace bemcal::physics
