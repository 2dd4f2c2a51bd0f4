/// What was found in data and what was done about it, in words for the reader of a
/// result.
#pragma once

#include <string>

namespace bemcal::study {

/// What a decision is about.
enum class DecisionKind {
    data,       ///< readings or a column of weather
    one_class,  ///< an effect that readings cannot tell from parameters
    period,     ///< what was not predicted there
    parameter   ///< where a calibration ended
};
constexpr const char* name_of(DecisionKind kind) {
    return kind == DecisionKind::data        ? "data"
           : kind == DecisionKind::one_class ? "class"
           : kind == DecisionKind::period    ? "period"
                                             : "parameter";
}

struct DataDecision {
    std::string series;   ///< the meter, column or file, or what else it is about
    std::string finding;  ///< "46 h of zeros from 2013-04-02 00:00"
    std::string action;   ///< "masked", "kept", "scaled by 11.2"
    DecisionKind kind = DecisionKind::data;
};

}  // namespace bemcal::study
