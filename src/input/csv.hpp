/// CSV (RFC 4180) as a table of cells that point into its text.
///
/// The separator is the comma, semicolon or tab that the first line has most of; empty
/// lines and lines that start with # are skipped. Numbers and times are the readers'
/// matter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

struct Csv {
    std::string file;                  ///< for messages
    std::vector<std::string> columns;  ///< names in the first line
    std::vector<int> lines;            ///< [n_rows] line of the file, from 1
    /// [n_rows x n_columns], quotes and blanks taken off.
    std::vector<std::string_view> cells;

    std::size_t n_rows() const { return lines.size(); }
    std::string_view cell(std::size_t row, std::size_t column) const {
        return cells[row * columns.size() + column];
    }
    /// Index of a column; throws UserError (data) that lists the columns and the nearest.
    std::size_t column(const std::string& name) const;
};

/// Throws UserError (data) with file:line where a row has too few or too many cells, or
/// there are no rows. `text` must outlive the table.
Csv parse_csv(const std::string& text, const std::string& file);

/// A number; NaN where the cell is empty or says NA, NaN, null. Throws UserError (data)
/// with file:line:column where it is neither.
double number_in(const Csv& csv, std::size_t row, std::size_t column, char decimal = '.');

/// A column of numbers [n_rows].
std::vector<double> numbers_in(const Csv& csv, std::size_t column, char decimal = '.');

}  // namespace bemcal::input
