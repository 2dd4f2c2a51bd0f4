/// What a meter's column says of itself before it is read as a meter: where its readings
/// begin and end, how much they are, and by which steps they rise.
#pragma once

#include "input/csv.hpp"

#include <string>

namespace bemcal::input {

struct ReadingsLook {
    std::string first_day, last_day;  ///< whole days, "2018-01-01"; "" = no reading
    double hours = 0;                 ///< with a reading, at one an hour
    double total = 0;
    /// Readings are whole multiples of it, though no round number: they are a share of
    /// another meter's pulses, or converted. 0 = nothing of the kind.
    double quantum = 0;
    double quantum_share = 0;  ///< of the readings that are multiples
};

/// Times in the first column, in ISO form.
ReadingsLook look_at(const Csv& csv, const std::string& column);

/// The same of the readings alone. \return quantum and share, or zeros
ReadingsLook look_for_quantum(const std::vector<double>& values);

}  // namespace bemcal::input
