/// What a meter's column says of itself before it is read as a meter: where its readings
/// begin and end, how much they are, and by which steps they rise.
#pragma once

#include "input/bills.hpp"
#include "input/csv.hpp"

#include <string>
#include <vector>

namespace bemcal::description {

/// Where a meter's readings stand in its file.
struct LookColumns {
    input::BillColumns bills;  ///< of months and bills
    physics::Interval interval = physics::Interval::hourly;
    bool counts = false;  ///< readings are what a register shows
};

struct ReadingsLook {
    std::string first_day, last_day;  ///< whole days, "2018-01-01"; "" = no reading
    double hours = 0;                 ///< with a reading
    double hours_each = 0;            ///< of a reading; 0 of months and bills
    double total = 0;                 ///< of the readings, of a register of its uses
    /// Readings are whole multiples of it, though no round number: they are a share of
    /// another meter's pulses, or converted. 0 = nothing of the kind.
    double quantum = 0;
    double quantum_share = 0;  ///< of the readings that are multiples
    /// Of months and bills, which finer readings may be summed to: begins and ends.
    std::vector<physics::Seconds> bounds;
};

/// A meter's rows as they were read.
struct LookRows {
    const input::Csv& csv;
    const input::Stamps& stamps;
    const input::StampRules& rules;
    std::vector<double> values;  ///< [n_rows], NaN = missing
};

/// Throws UserError (data) where bills do not follow each other.
ReadingsLook look_at(const LookRows& rows, const LookColumns& columns);

/// The same of the readings alone. \return quantum and share, or zeros
ReadingsLook look_for_quantum(const std::vector<double>& values);

}  // namespace bemcal::description
