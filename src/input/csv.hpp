/// CSV (RFC 4180) as a table of cells that point into its text.
///
/// The separator is what the line of names has most of: comma, semicolon, tab or bar, or
/// what a line "sep=;" says. Not fast-cpp-csv-parser: it is compiled for a separator and
/// a number of columns, which are found here. Empty lines, rows without any content and
/// lines that start with # are skipped. Numbers (`csv_numbers`) and times are the
/// readers' matter.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

/// Which lines of a file are its table, as far as that is said.
struct CsvForm {
    /// Columns that are asked for: the names stand in the first line that has them all.
    /// Without any, in the first line, and every line after it is a row.
    std::vector<std::string> names;
    std::string time;             ///< column of the stamps; "" = the first
    int header_line = 0;          ///< of the names, from 1; 0 = found as said above
    std::vector<int> skip_lines;  ///< left out, from 1
    std::vector<std::string> skip_texts;  ///< lines that begin so are left out
    /// A row with too few or too many cells is one of `short_rows`, and no error.
    bool keeps_odd_rows = false;
};

struct Csv {
    std::string file;                  ///< for messages
    int header_line = 1;               ///< where the names stand
    std::vector<std::string> columns;  ///< names
    std::vector<int> lines;            ///< [n_rows] line of the file, from 1
    /// [n_rows x n_columns], quotes and blanks taken off.
    std::vector<std::string_view> cells;
    std::vector<std::string> notes;  ///< which lines were left out, a sentence each
    /// Rows of readings that end before the last names, and odd rows that are kept.
    struct ShortRow {
        int line;
        std::size_t n_cells;
    };
    std::vector<ShortRow> short_rows;
    std::shared_ptr<std::deque<std::string>> unquoted;  ///< cells that held "" in quotes

    std::size_t n_rows() const { return lines.size(); }
    std::string_view cell(std::size_t row, std::size_t column) const {
        return cells[row * columns.size() + column];
    }
    /// Index of a column; throws UserError (data) that lists the columns and the nearest,
    /// or says that two have that name, or which row ends before it.
    std::size_t column(const std::string& name) const;
    /// Throws UserError (data) where the row ends before the last names.
    void check_is_whole(std::size_t row) const;
};

/// Where the names stand, found without reading the rest.
struct CsvNames {
    int line = 0;  ///< from 1
    char separator = ',';
};
/// Throws UserError (data) where no line has the columns that are asked for.
CsvNames find_names(std::string_view text, const std::string& file,
                    const CsvForm& form = {});

/// Of readings (`form.names`) a line of units below the names and lines behind the last
/// row that have no stamp are left out, with a note. Throws UserError (data) with
/// file:line where a row has too few or too many cells, or there are no rows. `text` must
/// outlive the table.
Csv parse_csv(std::string_view text, const std::string& file, const CsvForm& form,
              const CsvNames& names);
Csv parse_csv(const std::string& text, const std::string& file, const CsvForm& form = {});

}  // namespace bemcal::input
