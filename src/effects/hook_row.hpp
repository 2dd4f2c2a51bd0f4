/// All that is known of a hook, as a row of a table (hooks.cpp).
#pragma once

#include "effects/effect.hpp"
#include "physics/building.hpp"

#include <vector>

namespace bemcal::effects {

class Placer;
class Sites;

struct Range {
    double least, most;
};

struct HookRow {
    Hook hook;
    const char* name;
    const char* unit;  ///< of the coefficient, per unit of what drives it
    /// Puts an effect into the building; throws CannotSimulate where it cannot.
    void (*enter)(Placer&, const HookRow&, const Effect&);
    /// How its profile enters the inputs that it changes.
    physics::ChangeKind kind = physics::ChangeKind::shift;
    /// Whether what it changes are conductances, set-points, air flows or efficiencies,
    /// so that its profile should have few levels.
    bool shapes_regimes = true;
    /// Of the coefficient, where `kind` alone does not say it (range_of).
    /// \param most  twice the largest plausible size
    Range (*range)(double most) = nullptr;
    /// The inputs that it changes: of every zone, facade or plant that has them; nullptr
    /// for a hook that adds a part instead.
    void (*sites)(const Effect&, Sites&) = nullptr;
    const char* lack = "the building has nothing that it could change";  ///< without any
    bool is_at_a_meter = false;  ///< which the others do not see
    bool leaves_loads = false;   ///< what it changes comes behind what rooms need
    bool is_use = false;         ///< what people do and switch on, in all seasons
    /// What two effects bring is the sum of what each brings.
    bool adds_up = true;
    /// The coefficient is per unit of the driver; not where the driver is a temperature
    /// on the other side of a conductance.
    bool is_per_driver = true;
    /// How far a search moves a threshold of the hook's own first; 0 = it has none, and
    /// the driver's row says it.
    double first_move = 0;
    /// What the grammar tries at it, with coefficients of a profile that reaches 1.
    struct {
        unsigned follows = 0;  ///< groups of Follows; 0 = nothing
        double most = 0, typical = 0;
    } grammar{};
};

}  // namespace bemcal::effects
