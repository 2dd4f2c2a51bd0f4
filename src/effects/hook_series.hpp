/// What effects change in a building, as series at hooks: hour by hour, whatever they
/// follow. Another program can take them where its own model has the like.
#pragma once

#include "base/nan.hpp"
#include "physics/building.hpp"
#include "physics/drive.hpp"

#include <string>
#include <vector>

namespace bemcal::effects {

struct HookSeries {
    std::string hook;  ///< "infiltration": as hooks are called
    std::string unit;  ///< of the values
    bool is_factor =
        false;  ///< what is there is multiplied by 1 + value; else it is added
    std::string facade, meter;     ///< where it is at one of them; "" = at all
    std::vector<double> values{};  ///< [hours] of the drive's period
    double opens_above = nan;      ///< [degC] of the room, from which venting opens
};

/// Whether both are at one hook, facade and meter.
template <class A, class B>
bool is_same_place(const A& a, const B& b) {
    return a.hook == b.hook && a.facade == b.facade && a.meter == b.meter;
}

/// Hooks that a series may be called by.
std::vector<std::string> hooks_of_series();

/// A building over a period.
struct Version {
    const physics::Building& building;
    const physics::Drive& drive;
};

/// What one version has that another lacks, of a building's first zone (effects enter all
/// zones alike). What fans bring is a share of all that they bring at most. Inputs that
/// no other program could know of (a boundary that an effect added, a second mass) are
/// left out, and so is what a flow does beside the declared name of infiltration or fans.
std::vector<HookSeries> changes_between(const Version& without, const Version& with);

/// The hours of one period after those of another; hooks that only one has are 0 in the
/// other. \param n_before  hours of `all`   \param n_more  hours of `more`
void append(std::vector<HookSeries>& all, std::size_t n_before,
            std::vector<HookSeries> more, std::size_t n_more);

}  // namespace bemcal::effects
