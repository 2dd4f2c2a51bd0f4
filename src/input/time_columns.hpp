/// Where the time of a CSV file's rows stands: in one column, in two for date and clock,
/// in one for each part, or in the names of columns that are a day's steps.
#pragma once

#include "input/csv.hpp"
#include "input/time_text.hpp"

#include <string>
#include <vector>

namespace bemcal::input {

enum class TimePart { year, month, day, day_of_year, hour, minute, second };

struct TimeColumns {
    enum class Form { text, date_and_clock, parts, joined };

    TimeColumns(std::size_t column = 0) : columns{column} {}

    Form form = Form::text;
    std::vector<std::size_t> columns;
    std::vector<TimePart> parts;  ///< [columns] where each is a part
    bool minutes_to_60 = false;   ///< hours 1 to 24, minutes up to 60, as in EPW
    int per_day = 0;              ///< readings of each line that was a day; else 0
    bool by_ends = false;         ///< their columns are named after ends
    std::string found;            ///< how it was found, where nobody said; else ""
};

/// The columns of these names; where there are none, the first column or what its names
/// and cells show. Throws UserError (data) where a name is not there.
TimeColumns time_columns(const Csv& csv, const std::vector<std::string>& names,
                         const std::string& format);

/// The time of a row. Throws std::invalid_argument with a sentence that says what was
/// expected.
Stamp stamp_in(const Csv& csv, std::size_t row, const TimeColumns& time,
               const std::string& format);

/// The names of the columns, for messages.
std::string names_of(const Csv& csv, const TimeColumns& time);

/// Of trends side by side, "time, a, time, b": the column of times in front of `column`,
/// where they are not those of `time`; nothing where a row has one time.
std::optional<std::size_t> own_time_of(const Csv& csv, const TimeColumns& time,
                                       std::size_t column, const std::string& format);

/// A file with a day a line and a column for each hour, half-hour or quarter of it, as
/// one with a reading a line; `time` then is that of the new one. \return nothing where
/// the file is none
/// \param first  its first column
/// \param by_clock  only where the columns are named after times, "00:15", not counted
std::optional<Csv> unrolled(const Csv& csv, const std::string& first, TimeColumns& time,
                            const std::string& format, bool by_clock);

}  // namespace bemcal::input
