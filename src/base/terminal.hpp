/// What is printed: harmless whatever names and messages hold, and never lost in silence.
///
/// Names come from files of others; an escape sequence in one would command the reader's
/// terminal. A stream that is full or closed does not end the program: it is remembered.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace bemcal {

/// The text with control characters, marks that turn the direction of writing, and bytes
/// that are no UTF-8 as \x1b or \u202e. Line ends and tabs stay.
std::string printable(std::string_view text);

/// The same in one line: line ends and tabs become \n and \t.
std::string in_one_line(std::string_view text);

/// At the program's start: a standard stream that is closed is opened on a device that
/// takes nothing, so that no file gets its number; and a reader that goes away does not
/// end the program. Either way a lost line is noticed.
void open_standard_streams();

/// Prints made printable, at once. Never throws.
void print(std::FILE* stream, std::string_view text) noexcept;
/// Prints as it is: for our own control sequences.
void print_raw(std::FILE* stream, std::string_view text) noexcept;

/// Whether anything that was printed could not be written.
bool is_output_lost() noexcept;
/// Whether it was so because nobody reads the pipe any longer.
bool has_reader_gone() noexcept;

}  // namespace bemcal
