/// Readings of a meter that are none by their value, masked or asked about; every finding
/// becomes a line of the decisions.
#pragma once

#include "checks/series.hpp"
#include "input/bills.hpp"

#include <optional>

namespace bemcal::checks {

/// What only the job can answer.
struct Question {
    int at = 0;  ///< the step that shows it
    std::string text;
};

/// Codes for missing (-9999, 65535), in the readings as they stand in the file; masked.
std::vector<Finding> mask_codes(input::RegularSeries& series, physics::Quantity quantity);

/// Whether the readings of an energy are a register's, which counts on.
std::optional<Question> doubt_of_register(const input::RegularSeries& series,
                                          physics::Quantity quantity);

/// Bills that may be a register's; stated only, as a steady rise of use is possible.
std::vector<Finding> state_bills(const input::RegularSeries& series,
                                 physics::Quantity quantity);

/// Whether a room can have been as warm as this [degC]; where the readings stand as in
/// the file, with the units that would fit them.
std::optional<Question> doubt_of_room(const input::RegularSeries& series,
                                      bool is_as_read);

/// Makes of a register's reads, each at its time, the bills from one to the next [one
/// less].
std::vector<Finding> take_differences(std::vector<input::Bill>& reads);

/// The use of each step, from a register's counts at the beginnings of the steps.
std::vector<Finding> take_differences(input::RegularSeries& series);

/// Spikes; masked.
std::vector<Finding> mask_spikes(input::RegularSeries& series,
                                 physics::Quantity quantity);

/// An energy below 0: offsets become 0, single hours are masked, more is asked about.
/// Every one is kept or masked where the job says so.
std::vector<Finding> check_negative(input::RegularSeries& series,
                                    physics::Quantity quantity, Handling handling,
                                    std::optional<Question>& question);

}  // namespace bemcal::checks
