/// Reads numbers out of the cells of a CSV file.
/// Follows from what can be told of a mark: "1,234" alone may be a thousand or one, so it
/// is asked about; "0.125", "12.5" and "1234.5" in a column say that its mark is a
/// decimal one. Leaves out units behind a number, groups of other than three digits, and
/// digits beyond ASCII.
#include "input/csv_numbers.hpp"

#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/nan.hpp"
#include "input/data_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

constexpr int few = 50;  // readings that do not tell what their mark is

/// Blanks of all kinds as ' ', apostrophes as '; nothing around it.
std::string plain_marks(std::string_view cell) {
    constexpr struct {
        std::string_view from;
        char to;
    } marks[] = {{"\xC2\xA0", ' '},
                 {"\xE2\x80\xAF", ' '},
                 {"\xE2\x80\x89", ' '},
                 {"\xE2\x80\x99", '\''},
                 {"\xE2\x88\x92", '-'}};
    std::string text(trimmed(cell));
    if (std::ranges::none_of(text, [](char c) { return (c & 0x80) != 0; })) return text;
    for (const auto& mark : marks)
        for (std::size_t at; (at = text.find(mark.from)) != std::string::npos;)
            text.replace(at, mark.from.size(), 1, mark.to);
    return std::string(trimmed(text));
}

/// A number in groups of three digits: "1,234", "-12.345.678", "1 234,5".
struct Grouped {
    char mark = 0;     ///< between the groups; 0 = it is none
    int n_marks = 0;   ///< of them
    char decimal = 0;  ///< behind the groups; 0 = there is none
};

std::size_t n_digits(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) -
                                    text.begin());
}

Grouped grouped(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const std::size_t first = n_digits(text);
    if (first < 1 || first > 3 || first == text.size() || text[0] == '0') return {};
    Grouped found{text[first], 0, 0};
    if (std::string_view(",.' ").find(found.mark) == std::string_view::npos) return {};
    text.remove_prefix(first);
    for (; text.starts_with(found.mark); text.remove_prefix(4), ++found.n_marks)
        if (n_digits(text.substr(1)) < 3) return {};
    if (text.empty()) return found;
    found.decimal = text[0];
    const bool is_decimal = found.decimal == '.' || found.decimal == ',';
    return is_decimal && n_digits(text.substr(1)) + 1 == text.size() ? found : Grouped{};
}

std::optional<double> plain_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// What the job has to say of a number in groups.
std::string question(std::string_view cell, const Grouped& is, const NumberForm& form) {
    const auto decimal = [&](char mark) {
        return mark == form.decimal ? "" : fmt::format(" and decimal = \"{}\"", mark);
    };
    const bool may_be_decimal =
        (is.mark == ',' || is.mark == '.') && is.n_marks == 1 && is.decimal == 0;
    const std::string first =
        fmt::format("set thousands = \"{}\"{}", is.mark,
                    is.decimal != 0           ? decimal(is.decimal)
                    : is.mark == form.decimal ? decimal(is.mark == '.' ? ',' : '.')
                                              : "");
    if (!may_be_decimal)
        return fmt::format("\"{}\" has a mark between its thousands; {}", cell, first);
    std::string whole(cell), fraction(cell);
    std::erase(whole, is.mark);
    std::ranges::replace(fraction, ',', '.');
    return fmt::format(
        "\"{}\" may be {} or {}; {} if it is the first, thousands = "
        "\"none\"{} if it is the second",
        cell, whole, fraction, first, decimal(is.mark));
}

std::string not_a_number(std::string_view cell, const NumberForm& form) {
    const std::string is = fmt::format("\"{}\" is not a number; ", cell.substr(0, 40));
    if (form.thousands.size() == 1 && cell.find(form.thousands) != std::string::npos)
        return is + fmt::format(
                        "expected groups of three digits between \"{}\", and "
                        "\"{}\" as decimal mark",
                        form.thousands, form.decimal);
    if (form.decimal == '.' && cell.find(',') != std::string_view::npos)
        return is + "set decimal = \",\" in the job if that is a decimal comma";
    const bool is_word = std::ranges::none_of(cell, is_digit);
    if (form.thousands != "none" && is_word)
        return is + fmt::format(
                        "leave the cell empty where a value is missing, or set "
                        "missing = [\"{}\"]",
                        cell.substr(0, 40));
    return is + "leave the cell empty where a value is missing";
}

/// The number of a cell that is not missing, or what is wrong with it.
struct Reading {
    std::optional<double> value;
    std::string wrong;
};

Reading read_number(std::string_view cell, const NumberForm& form) {
    std::string text = plain_marks(cell);
    const Grouped is = grouped(text);
    if (form.thousands.size() == 1) {
        if (is.mark == form.thousands[0]) std::erase(text, is.mark);
    } else if (form.thousands.empty() && is.mark != 0 &&
               (is.mark != form.decimal || is.n_marks > 1 || is.decimal != 0)) {
        return {{}, question(text, is, form)};
    }
    const bool mark_left =
        form.thousands.size() == 1 && text.find(form.thousands) != std::string::npos;
    if (form.decimal != '.') std::ranges::replace(text, form.decimal, '.');
    const auto value = mark_left ? std::nullopt : plain_number(text);
    return {value, value ? "" : not_a_number(cell, form)};
}

[[noreturn]] void fail_cell(const Csv& csv, std::size_t row, std::size_t column,
                            const std::string& wrong) {
    throw UserError(ExitCode::data, fmt::format("{}:{}:{}: {}", csv.file, csv.lines[row],
                                                csv.columns[column], wrong));
}

bool is_missing_in(std::string_view cell, const NumberForm& form) {
    return is_missing(cell) ||
           std::ranges::find(form.missing, cell) != form.missing.end();
}

/// Whether a decimal mark may be one of thousands: it stands before three digits in every
/// cell that has it, and the other cells are short enough to have none.
class MarkDoubt {
  public:
    explicit MarkDoubt(const NumberForm& form) : form_(form) {}

    /// \return false where the cell settles that the mark is a decimal one
    bool take(std::string_view cell) {
        if (is_missing_in(cell, form_)) return true;
        const std::string text = plain_marks(cell);
        if (text.find(form_.decimal) != std::string::npos) {
            ++n_marked_;
            return grouped(text).mark == form_.decimal;
        }
        const std::optional<double> value = plain_number(text);
        if (!value || *value == 0 ||
            std::ranges::count(form_.missing_numbers, *value) > 0)
            return true;
        std::set<double>& values = std::abs(*value) < 1000 ? short_ : long_;
        if (values.size() < 3) values.insert(*value);
        return long_.size() < 2;
    }

    bool is_left() const {
        if (n_marked_ == 0) return false;
        const bool both = short_.size() > (n_marked_ < few ? 0U : 2U);
        return both || (n_marked_ < few && !form_.decimal_is_said);
    }

  private:
    const NumberForm& form_;
    int n_marked_ = 0;
    std::set<double> short_, long_;  ///< some values of cells without the mark
};

void ask_about_groups(const Csv& csv, std::size_t column, const NumberForm& form) {
    MarkDoubt doubt(form);
    for (std::size_t row = 0; row < csv.n_rows(); ++row)
        if (!doubt.take(csv.cell(row, column))) return;
    if (!doubt.is_left()) return;
    for (std::size_t row = 0; row < csv.n_rows(); ++row) {
        const std::string text = plain_marks(csv.cell(row, column));
        if (const Grouped is = grouped(text); is.mark == form.decimal)
            fail_cell(csv, row, column, question(text, is, form));
    }
}

}  // namespace

bool is_missing(std::string_view cell) {
    static constexpr std::string_view words[] = {
        "",       "-",       "--",      "---",     ".",        "na",      "n/a",
        "n.a.",   "#n/a",    "#na",     "#nv",     "<na>",     "nan",     "-nan",
        "null",   "nil",     "none",    "missing", "no data",  "nodata",  "n.d.",
        "k.a.",   "#div/0!", "#ref!",   "#num!",   "#null!",   "#value!", "#wert!",
        "#name?", "1.#ind",  "-1.#ind", "1.#qnan", "-1.#qnan", "#n/a n/a"};
    if (cell.empty()) return true;
    if (cell.size() > 9 ||
        (is_digit(cell[0]) && cell.find('#') == std::string_view::npos))
        return false;
    return std::ranges::find(words, lower_case(cell)) != std::end(words);
}

double number_in(const Csv& csv, std::size_t row, std::size_t column,
                 const NumberForm& form) {
    const std::string_view cell = csv.cell(row, column);
    if (is_missing_in(cell, form)) return nan;
    std::optional<double> value;
    if (form.decimal == '.' && form.thousands.size() != 1) value = plain_number(cell);
    if (!value) {
        const Reading reading = read_number(cell, form);
        if (!reading.value) fail_cell(csv, row, column, reading.wrong);
        value = reading.value;
    }
    return std::ranges::count(form.missing_numbers, *value) > 0 ? nan : *value;
}

std::vector<double> numbers_in(const Csv& csv, std::size_t column,
                               const NumberForm& form) {
    if (form.thousands.empty()) ask_about_groups(csv, column, form);
    std::vector<double> values(csv.n_rows());
    for (std::size_t row = 0; row < values.size(); ++row)
        values[row] = number_in(csv, row, column, form);
    return values;
}

}  // namespace bemcal::input
