/// A building's way through a period, linear about the way that it takes: what a small
/// change of its state, or of what enters at a hook, does to the state after the step and
/// to what the meters show of it. Any number of functions then follow by a scan, without
/// a simulation.
#pragma once

#include "base/matrix.hpp"
#include "physics/meters.hpp"

#include <span>
#include <vector>

namespace bemcal::functions {

/// A building in which a hook brings more, and less, than the description says.
struct Moved {
    const physics::Building* more = nullptr;
    const physics::Building* less = nullptr;
    const physics::Drive* drive = nullptr;  ///< of both; its steps are the base's
    double size = 1;  ///< how much more, in units of the hook's typical size
};

/// Of a hook: [steps x states] and [steps x meters] per typical size of its input.
struct HookSteps {
    Matrix to_state, to_meters;
};

struct LinearSteps {
    std::size_t n_states = 0, n_meters = 0;
    Matrix states;  ///< [steps x states * states] d after / d before, row by row
    Matrix meters;  ///< [steps x meters * states] d shown / d before
    std::vector<HookSteps> hooks;

    std::size_t n_steps() const { return states.rows; }
};

/// Of the steps of the drive's period; the warm-up is simulated as it is. Derivatives are
/// differences to both sides. Throws CannotSimulate where a step cannot be made; a
/// hook that leaves the method does nothing at that step.
LinearSteps linear_steps(const physics::Building& building, const physics::Drive& drive,
                         std::span<const physics::Quantity> meters,
                         std::span<const Moved> hooks);

/// What functions at a hook do to the meters, each from a state unmoved.
/// \param inputs  [steps x functions] in typical sizes
/// \return        [meters * functions x steps], all functions of the first meter first
Matrix scan(const LinearSteps& steps, std::size_t hook, const Matrix& inputs);

}  // namespace bemcal::functions
