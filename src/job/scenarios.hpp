/// What [[scenario]] sections of our own model and of another program share.
#pragma once

#include "retrofit/scenario.hpp"
#include "schema/section.hpp"

#include <functional>

namespace bemcal::job {

/// How a [[scenario.change]] says what becomes of a number.
struct Way {
    const char* key;  ///< value, factor, offset or insulation
    retrofit::ChangeBy by;
    double amount = 0;  ///< of insulation its resistance [m2 K/W]
};
Way read_way(const schema::Section& change);

/// Reads each with its name. Throws UserError where there is none, or two have one name.
void each_scenario(const schema::Section& root,
                   const std::function<void(const schema::Section&)>& read);

}  // namespace bemcal::job
