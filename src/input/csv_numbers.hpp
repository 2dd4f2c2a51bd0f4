/// Numbers in the cells of a CSV file: decimal mark, thousands, words for missing.
///
/// Groups of three digits ("1,234") are a number only where the mark is declared; else
/// they are asked about.
#pragma once

#include "input/csv.hpp"

#include <string>
#include <vector>

namespace bemcal::input {

/// How numbers are written.
struct NumberForm {
    NumberForm(char mark = '.') : decimal(mark) {}  // NOLINT: a mark is a form
    char decimal;
    bool decimal_is_said = true;
    /// "," "." "'" or " " (any blank); "none"; "" = not said: a column that may have them
    /// is asked about.
    std::string thousands = "none";
    std::vector<std::string> missing;     ///< cells that stand for no reading
    std::vector<double> missing_numbers;  ///< the same, by their value
};

/// A number; NaN where the cell is empty or says NA, NaN, null, ... Throws UserError
/// (data) with file:line:column where it is neither.
double number_in(const Csv& csv, std::size_t row, std::size_t column,
                 const NumberForm& form = {});

/// A column of numbers [n_rows]. Throws the same, also where the decimal mark may be one
/// of thousands.
std::vector<double> numbers_in(const Csv& csv, std::size_t column,
                               const NumberForm& form = {});

/// Whether a cell stands for no value: "", NA, N/A, NaN, null, none, -, missing, ...
bool is_missing(std::string_view cell);

}  // namespace bemcal::input
