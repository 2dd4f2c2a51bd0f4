/// What was found in data and what was done about it, in words for the reader of a
/// result.
#pragma once

#include <string>

namespace bemcal::study {

struct DataDecision {
    std::string series;   ///< the meter, column or file
    std::string finding;  ///< "46 h of zeros from 2013-04-02 00:00"
    std::string action;   ///< "masked", "kept", "scaled by 11.2"
};

}  // namespace bemcal::study
