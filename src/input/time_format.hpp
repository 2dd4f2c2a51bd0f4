/// A time in a text, as a form of strptime describes it; alike on every machine.
#pragma once

#include "physics/calendar.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace bemcal::input {

/// A time as it stands there.
struct Stamp {
    physics::Seconds face{};  ///< what it shows; 24:00 is the next day's 00:00
    /// Of that clock from UTC, where the text says it: "Z", "+01:00", "CET", epochs.
    std::optional<std::chrono::seconds> offset;
    bool is_24 = false;    ///< written as 24:00
    bool is_zone = false;  ///< the offset is that of a zone's name, such as CST
};

/// Throws std::invalid_argument with a sentence where the form is none: an unknown
/// conversion, or no year.
void check_time_format(const std::string& format);

/// Whether the form reads a time of day, too.
bool has_clock(const std::string& format);

/// Nothing where the text is not of the form, or names no day of the calendar.
std::optional<Stamp> read_time(std::string_view text, std::string_view format);

/// "14:00", "2:00 PM", "1400", "24:00:00": the time of a day, up to 24:00.
std::optional<std::chrono::seconds> read_clock(std::string_view text);

/// "Z", "+01:00", "-0530", "+01", "GMT", "UTC+1", "CET" [s]; nothing where it is none.
std::optional<std::chrono::seconds> read_offset(std::string_view text);

/// Whether the text is a zone's name other than UTC and GMT.
bool is_zone_name(std::string_view text);

}  // namespace bemcal::input
