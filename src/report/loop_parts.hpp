/// The tables of a loop; each is text, empty where the result has nothing for it.
#pragma once

#include "loop/stored_loop.hpp"

#include <string>
#include <vector>

namespace bemcal::report {

/// The hourly errors of what was held out, in sentences.
std::string loop_headline(const loop::StoredLoop& loop);
/// Errors of the three models for every channel, period and interval.
std::string loop_fit_table(const loop::StoredLoop& loop);

/// What was found in the data and is not said elsewhere; the structures that were tried.
/// \param of_data  findings of the building's own table of its data
std::string loop_decision_table(const loop::StoredLoop& loop,
                                const std::vector<std::string>& of_data);
std::string loop_structure_table(const loop::StoredLoop& loop);
/// What the data can show at all: the effects most clearly seen, those that would not be,
/// and those that cannot be told apart.
std::string loop_power_table(const loop::StoredLoop& loop);
/// Where the residual raises an alarm, before and after.
std::string loop_localisation_table(const loop::StoredLoop& loop);
/// What drivers and calendar still predict of the residual.
std::string loop_unexplained_table(const loop::StoredLoop& loop);

/// A number with three digits, NaN as "-".
std::string three_digits(double value);
/// "0.841 +- 0.051"
std::string plus_minus_brief(double value, double sd);
/// The table, or nothing where it has no row.
class TextTable;
std::string text_of(const TextTable& table, std::size_t widest);

}  // namespace bemcal::report
