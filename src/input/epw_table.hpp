/// The text of an EPW file as a table of hours: nothing filled in but a missing 29
/// February.
#pragma once

#include "physics/weather.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

/// What is read of each row, where it belongs, and which values it may have.
struct EpwColumn {
    int field;  ///< from 1, as in the file
    const char* name;
    const char* unit;
    double least, most;  ///< accepted
    double missing;      ///< this code and all above it
    bool needed;         ///< a value out of range is an error, else it counts as missing
    double scale;        ///< from the file's unit to Weather's
    std::vector<double> physics::Weather::* series;
};
inline constexpr int n_epw_columns = 8;
extern const std::array<EpwColumn, n_epw_columns> epw_columns;
/// Hours without a row, as many as fill_gaps may bridge [h].
inline constexpr int longest_epw_gap = 48;
inline constexpr int dry_bulb_field = 7, global_field = 14;

struct EpwTable {
    std::string name;  ///< of the file, for messages
    std::string place;
    physics::Weather weather;  ///< series of epw_columns, NaN = missing
    std::vector<int> lines;    ///< line of the file of every hour
    std::vector<std::string> decisions;
};

/// Hours behind the last one, of which nothing is known.
void add_missing_hours(int n, physics::Weather& weather);

/// \param year  of the first row, or 0: as it says
/// Throws UserError, see epw.hpp.
EpwTable parse_epw_table(std::string_view text, const std::string& name, int year);

[[noreturn]] void fail_epw(const std::string& name, int line, int field,
                           const std::string& message);

}  // namespace bemcal::input
