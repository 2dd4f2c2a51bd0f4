/// What the bytes of a data file are: text, brought to UTF-8, or something else, which is
/// named. And the lines of a text, whoever wrote it.
#pragma once

#include <string>
#include <string_view>

namespace bemcal::input {

/// Throws UserError (data) that says what the file is and what to do, where it is no text
/// (a zip, a workbook, a web page, ...) or UTF-16.
void refuse_other_kinds(std::string_view bytes, const std::string& path);

bool is_utf8(std::string_view text);

/// Windows-1252, of which Latin-1 is a part, as UTF-8.
std::string from_windows_1252(std::string_view text);

/// Takes the next line off `rest`, without its end: \n, \r\n, or \r alone. \return false
/// where there is none.
bool next_line(std::string_view& rest, std::string_view& line);

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Without blanks and tabs around it.
std::string_view trimmed(std::string_view text);

}  // namespace bemcal::input
