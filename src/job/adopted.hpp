/// What an earlier night found in a building, laid over its description.
#pragma once

#include "schema/section.hpp"
#include "study/case.hpp"

#include <string>

namespace bemcal::job {

/// The periods of a building with what was adopted: that which it was found in, and what
/// has come since, if anything has.
constexpr const char *known_period = "training", *new_period = "since";

struct Adopted {
    std::string text;     ///< sections of a job; those of a name are one with the own
    study::Period known;  ///< what it was found in; empty: the last days
    double window_days = 365;  ///< of an empty one
};

/// Into the building's own tree, with these periods up to the description's last day.
/// What the building has not of a list is taken from the job's.
/// \param file  that the tree is of, for messages
void lay_adopted(const Adopted& adopted, const schema::Section& root,
                 const std::string& file, schema::Node& own);

}  // namespace bemcal::job
