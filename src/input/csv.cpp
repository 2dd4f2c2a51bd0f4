/// Splits a CSV text into records and cells that point into it, after finding the line of
/// names.
/// Source: RFC 4180, with quotes that open at the begin of a cell only; "sep=" is
/// Excel's. Leaves out blanks as separators, and names in several lines. Numbers are read
/// by `csv_numbers`, times by `stamps`; gaps are found by `series`.
#include "input/csv.hpp"

#include "base/byte_order_mark.hpp"
#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "input/data_text.hpp"
#include "input/suggest.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::input {

namespace {

constexpr std::size_t most_columns = 10000;
constexpr std::size_t most_before_names = 200;  // lines
constexpr std::size_t most_units = 3, most_behind = 50;
constexpr int most_lines_of_a_cell = 20;
constexpr std::string_view separators = ",;\t|";
constexpr std::size_t none = std::string_view::npos;

using Cells = std::vector<std::string_view>;

[[noreturn]] void fail_data(const std::string& message) {
    throw UserError(ExitCode::data, message);
}

/// Whether a cell can end at `at`.
bool ends_cell(std::string_view text, std::size_t at) {
    at = text.find_first_not_of(' ', at);
    return at == none || text[at] == '\n' || text[at] == '\r' ||
           separators.find(text[at]) != none;
}

/// Of the quote at `open`; `none` where it is not closed. "" within is a quote mark.
std::size_t closing_quote(std::string_view text, std::size_t open) {
    for (std::size_t at = text.find('"', open + 1); at != none;
         at = text.find('"', at + 1)) {
        if (at + 1 < text.size() && text[at + 1] == '"')
            ++at;
        else if (ends_cell(text, at + 1))
            return at;
    }
    return none;
}

/// Whether a cell of the line begins with a quote that is not closed in it.
bool leaves_quote_open(std::string_view line) {
    for (std::size_t at = line.find('"'); at != none; at = line.find('"', at)) {
        const std::string_view before = trimmed(line.substr(0, at));
        const bool opens = before.empty() || separators.find(before.back()) != none ||
                           (at > 0 && line[at - 1] == '\t');
        if (opens) at = closing_quote(line, at);
        if (at == none) return true;
        ++at;
    }
    return false;
}

struct Record {
    int line = 0;  ///< its first, from 1
    std::string_view text;
    bool is_comment() const { return text.starts_with('#'); }
    /// Of nothing but separators, blanks and quotes.
    bool is_blank() const { return text.find_first_not_of(" \t,;|\"\r\n\x1A") == none; }
};

/// The records of a text that hold something and are not to be skipped: lines, joined
/// where a cell in quotes goes on in the next one.
class Records {
  public:
    Records(std::string_view text, const CsvForm& form)
        : rest_(without_byte_order_mark(text)), form_(form) {}

    bool next(Record& record) {
        while (next_of_all(record)) {
            if (record.is_blank()) continue;
            if (!is_skipped(record)) return true;
            if (n_skipped_++ == 0) first_skipped_ = record.line;
        }
        return false;
    }
    int n_skipped() const { return n_skipped_; }
    int first_skipped() const { return first_skipped_; }

  private:
    bool next_of_all(Record& record) {
        std::string_view line;
        if (!next_line(rest_, line)) return false;
        record = {++number_, line};
        if (leaves_quote_open(line)) join(record);
        return true;
    }

    void join(Record& record) {
        std::string_view rest = rest_, line;
        for (int n = 1; n < most_lines_of_a_cell && next_line(rest, line); ++n) {
            const std::string_view joined(record.text.begin(), line.end());
            if (leaves_quote_open(joined)) continue;
            record.text = joined;
            rest_ = rest;
            number_ += n;
            return;
        }
    }

    bool is_skipped(const Record& record) const {
        std::string_view text = trimmed(record.text);
        const std::string_view bare = text.starts_with('"') ? text.substr(1) : text;
        return std::ranges::count(form_.skip_lines, record.line) > 0 ||
               std::ranges::any_of(form_.skip_texts, [&](const std::string& begin) {
                   return text.starts_with(begin) || bare.starts_with(begin);
               });
    }

    std::string_view rest_;
    const CsvForm& form_;
    int number_ = 0, n_skipped_ = 0, first_skipped_ = 0;
};

/// Cuts lines into cells; keeps those that are not in the text as they are.
class Splitter {
  public:
    void split(std::string_view line, char separator, Cells& cells) {
        cells.clear();
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t end = end_of_cell(line, begin, separator);
            cells.push_back(bare(trimmed(line.substr(begin, end - begin))));
            begin = end + 1;
        }
    }
    std::shared_ptr<std::deque<std::string>> unquoted() const { return unquoted_; }

  private:
    static std::size_t end_of_cell(std::string_view line, std::size_t begin,
                                   char separator) {
        std::size_t at = begin;
        while (at < line.size() && line[at] == ' ') ++at;
        if (at < line.size() && line[at] == '"')
            if (const std::size_t close = closing_quote(line, at); close != none)
                begin = close + 1;
        return std::min(line.find(separator, begin), line.size());
    }

    std::string_view bare(std::string_view cell) {
        if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
        cell = trimmed(cell.substr(1, cell.size() - 2));
        if (cell.find('"') == none && cell.find('\r') == none) return cell;
        if (!unquoted_) unquoted_ = std::make_shared<std::deque<std::string>>();
        std::string& made = unquoted_->emplace_back();
        for (std::size_t k = 0; k < cell.size(); ++k) {
            if (cell[k] != '\r') made += cell[k];
            if (cell.substr(k).starts_with("\"\"")) ++k;
        }
        return made;
    }

    std::shared_ptr<std::deque<std::string>> unquoted_;
};

/// What "sep=;" in the first line says; 0 where it says nothing.
char separator_said(std::string_view line) {
    line = trimmed(line);
    if (line.starts_with('"') && line.ends_with('"') && line.size() > 1)
        line = line.substr(1, line.size() - 2);
    if (line.size() < 4 || lower_case(line.substr(0, 4)) != "sep=") return 0;
    return line.size() == 4 ? '\t' : line[4];
}

char commonest_separator(std::string_view line) {
    char best = separators[0];
    for (const char candidate : separators)
        if (std::ranges::count(line, candidate) > std::ranges::count(line, best))
            best = candidate;
    return best;
}

/// The names in a line; a # before them is none of them.
Cells names_in(const Record& record, char separator, Splitter& splitter) {
    std::string_view line = record.text;
    while (line.starts_with('#') || line.starts_with(' ')) line.remove_prefix(1);
    Cells cells;
    splitter.split(line, separator, cells);
    return cells;
}

bool may_be_number(std::string_view cell) {
    return std::ranges::any_of(cell, is_digit) &&
           cell.find_first_not_of("0123456789.,'+-eE \xC2\xA0") == none;
}

std::string absent(const std::string& file, int line, const std::string& name,
                   const std::vector<std::string>& columns) {
    return fmt::format("{}:{}: has no column \"{}\"; it has {}{}", file, line, name,
                       fmt::join(columns, ", "),
                       nearest(name, columns).empty() ? "" : suggestion(name, columns));
}

std::size_t index_of(const Cells& cells, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(cells, name) - cells.begin());
}

/// Looks for the line of names among the first ones of a file.
class NameFinder {
  public:
    NameFinder(std::string_view text, const std::string& file, const CsvForm& form)
        : file_(file), form_(form) {
        Records records(text, form);
        for (Record record;
             (head_.size() < most_before_names || record.line < form.header_line) &&
             records.next(record);)
            head_.push_back(record);
        if (!head_.empty()) said_ = separator_said(head_[0].text);
        if (said_ != 0) head_.erase(head_.begin());
        if (head_.empty())
            fail_data(fmt::format("{}: has no lines; expected a CSV file", file));
    }

    CsvNames find() {
        if (form_.header_line > 0) return said_by_job();
        if (form_.names.empty()) return first_line();
        return named();
    }

  private:
    CsvNames at(const Record& record) {
        return {record.line, said_ != 0 ? said_ : commonest_separator(record.text)};
    }

    CsvNames first_line() {
        const auto first = std::ranges::find_if_not(head_, &Record::is_comment);
        if (first == head_.end())
            fail_data(fmt::format("{}: has no lines; expected a CSV file", file_));
        return at(*first);
    }

    CsvNames said_by_job() {
        const auto there = std::ranges::find(head_, form_.header_line, &Record::line);
        if (there == head_.end())
            fail_data(
                fmt::format("{}:{}: header_line says that the names stand here, "
                            "but the line is empty or not there",
                            file_, form_.header_line));
        const CsvNames found = with_names(*there);
        return found.line > 0 ? found : at(*there);
    }

    /// The line with the separator that gives the most cells, if it has all names.
    CsvNames with_names(const Record& record) {
        CsvNames found;
        std::size_t most = 0;
        for (const char separator :
             said_ != 0 ? std::string_view(&said_, 1) : separators) {
            const Cells cells = names_in(record, separator, splitter_);
            if (cells.size() <= most || n_found(cells) < form_.names.size()) continue;
            most = cells.size();
            found = {record.line, separator};
        }
        return found;
    }

    std::size_t n_found(const Cells& cells) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(form_.names, [&](const std::string& name) {
                return std::ranges::count(cells, name) > 0;
            }));
    }

    /// A line before the table may have the names, too; but no numbers stand below it.
    CsvNames named() {
        CsvNames first;
        for (std::size_t k = 0; k < head_.size(); ++k) {
            const CsvNames found = with_names(head_[k]);
            if (found.line == 0) continue;
            if (numbers_below(k, found.separator)) return found;
            if (first.line == 0) first = found;
        }
        if (first.line == 0) fail_absent();
        return first;
    }

    bool numbers_below(std::size_t names, char separator) {
        const Cells columns = names_in(head_[names], separator, splitter_);
        Cells cells;
        const std::size_t end = std::min(head_.size(), names + most_units + 2);
        for (std::size_t k = names + 1; k < end; ++k) {
            if (head_[k].is_comment()) continue;
            splitter_.split(head_[k].text, separator, cells);
            for (const std::string& name : form_.names)
                if (const std::size_t c = index_of(columns, name);
                    name != form_.time && c < cells.size() && may_be_number(cells[c]))
                    return true;
        }
        return false;
    }

    /// Of the line that has the most of the names.
    [[noreturn]] void fail_absent() {
        const Record* best = &head_[0];
        Cells columns;
        std::size_t widest = 0;
        for (const Record& record : head_) {
            const Cells cells = names_in(record, at(record).separator, splitter_);
            widest = std::max(widest, cells.size());
            if (record.is_comment() && n_found(cells) == 0) continue;
            if (!columns.empty() && n_found(cells) <= n_found(columns)) continue;
            best = &record;
            columns = cells;
        }
        for (const std::string& name : form_.names)
            if (std::ranges::count(columns, name) == 0)
                fail_data(
                    absent(file_, best->line, name, {columns.begin(), columns.end()}) +
                    (widest > columns.size()
                         ? "; if the names stand in another line, set header_line"
                         : ""));
        fail_data(fmt::format("{}: has no line of names", file_));
    }

    const std::string& file_;
    const CsvForm& form_;
    std::vector<Record> head_;
    Splitter splitter_;
    char said_ = 0;
};

std::string wrong_width(const Csv& csv, int line, std::size_t n) {
    return fmt::format("{}:{}: has {} cell{}; expected {} as in {}", csv.file, line, n,
                       n == 1 ? "" : "s", csv.columns.size(),
                       csv.header_line == 1 ? std::string("the first line")
                                            : fmt::format("line {}", csv.header_line));
}

/// Puts rows behind each other; knows what is none.
class TableMaker {
  public:
    TableMaker(const std::string& file, const CsvForm& form, const CsvNames& names)
        : form_(form), separator_(names.separator), is_timed_(!form.names.empty()) {
        csv_.file = file;
        csv_.header_line = names.line;
    }

    void begin(const Record& record, int n_before) {
        const Cells cells = names_in(record, separator_, splitter_);
        if (cells.size() > most_columns)
            fail_data(fmt::format("{}:{}: has more than {} columns", csv_.file,
                                  record.line, most_columns));
        csv_.columns.assign(cells.begin(), cells.end());
        n_named_ = csv_.columns.size();
        while (n_named_ > 0 && csv_.columns[n_named_ - 1].empty()) --n_named_;
        time_ = index_of(cells, form_.time) % csv_.columns.size();
        if (n_before > 0 && form_.header_line == 0)
            csv_.notes.push_back(
                fmt::format("the names stand in line {}; {} before it left out",
                            record.line, lines(n_before)));
    }

    void reserve(std::size_t n_rows, std::size_t n_letters) {
        csv_.cells.reserve(std::min(n_rows * csv_.columns.size(), n_letters));
    }

    void take(const Record& record) {
        if (record.is_comment()) return;
        splitter_.split(record.text, separator_, cells_);
        if (is_timed_ && !has_stamp()) {
            pending_.push_back(record);
            return;
        }
        if (!pending_.empty()) settle_pending(record);
        add(record);
    }

    Csv finish(const Records& records) {
        if (csv_.lines.empty() || pending_.size() > most_behind)
            add_pending();
        else if (!pending_.empty())
            csv_.notes.push_back(fmt::format(
                "{} behind the last row left out: line {}, {}", lines(pending_.size()),
                pending_[0].line, shown(pending_[0])));
        if (records.n_skipped() > 0)
            csv_.notes.push_back(fmt::format("{} left out by skip, the first: line {}",
                                             lines(records.n_skipped()),
                                             records.first_skipped()));
        if (csv_.lines.empty()) fail_data(empty_table());
        csv_.unquoted = splitter_.unquoted();
        return std::move(csv_);
    }

  private:
    template <class Number>
    static std::string lines(Number n) {
        return fmt::format("{} line{}", n, n == 1 ? "" : "s");
    }

    static std::string shown(const Record& record) {
        return fmt::format("\"{}\"", record.text.substr(0, 40));
    }

    std::string empty_table() const {
        return csv_.header_line == 1
                   ? fmt::format("{}: has no rows after its first line", csv_.file)
                   : fmt::format("{}: has no rows after line {}, its names", csv_.file,
                                 csv_.header_line);
    }

    std::string_view time_cell() const {
        return time_ < cells_.size() ? cells_[time_] : std::string_view();
    }

    /// Stamps begin with a digit, or hold digits where those of the first row do not.
    bool has_stamp() const {
        const std::string_view cell = time_cell();
        if (!cell.empty() && is_digit(cell[0])) return true;
        const auto n = std::ranges::count_if(cell, is_digit);
        return csv_.lines.empty() ? n >= 3 : n >= 1 && !stamps_begin_with_digit_;
    }

    bool are_units() {
        if (!csv_.lines.empty() || pending_.size() > most_units) return false;
        Cells cells;
        return std::ranges::all_of(pending_, [&](const Record& record) {
            splitter_.split(record.text, separator_, cells);
            return std::ranges::none_of(cells, may_be_number);
        });
    }

    /// What stands between the names and the first row, or between two rows.
    void settle_pending(const Record& row) {
        if (are_units())
            for (const Record& record : pending_)
                csv_.notes.push_back(fmt::format("line {} below the names left out: {}",
                                                 record.line, shown(record)));
        else
            add_pending();
        pending_.clear();
        splitter_.split(row.text, separator_, cells_);
    }

    void add_pending() {
        for (const Record& record : pending_) {
            splitter_.split(record.text, separator_, cells_);
            add(record);
        }
    }

    /// A separator more or less at the end of a line says nothing. A row of readings may
    /// end before columns that nobody asks for, or with its stamp.
    bool fit(int line) {
        const std::size_t n = csv_.columns.size();
        while (cells_.size() > n && cells_.back().empty()) cells_.pop_back();
        if (form_.keeps_odd_rows && (cells_.size() < n_named_ || cells_.size() > n)) {
            csv_.short_rows.push_back({line, cells_.size()});
            cells_.resize(n);
        }
        if (cells_.size() >= n) return cells_.size() == n;
        const bool only_stamp =
            is_timed_ && std::all_of(cells_.begin() + 1, cells_.end(),
                                     [](std::string_view cell) { return cell.empty(); });
        const bool is_short = cells_.size() < n_named_ && !only_stamp;
        if (is_short && !is_timed_) return false;
        if (is_short) csv_.short_rows.push_back({line, cells_.size()});
        cells_.resize(n);
        return true;
    }

    void add(const Record& record) {
        if (csv_.lines.empty())
            stamps_begin_with_digit_ = !time_cell().empty() && is_digit(time_cell()[0]);
        if (!fit(record.line)) fail_width(record);
        csv_.cells.insert(csv_.cells.end(), cells_.begin(), cells_.end());
        csv_.lines.push_back(record.line);
    }

    [[noreturn]] void fail_width(const Record& record) const {
        std::string advice;
        if (is_timed_ && !has_stamp())
            advice =
                "; name lines that are no rows in skip, and the line of names in "
                "header_line";
        else if (cells_.size() > csv_.columns.size() && separator_ == ',')
            advice =
                "; if commas are decimal marks, put such cells into quotes or "
                "separate cells by semicolons";
        fail_data(wrong_width(csv_, record.line, cells_.size()) + advice);
    }

    const CsvForm& form_;
    char separator_;
    bool is_timed_;
    bool stamps_begin_with_digit_ = true;
    std::size_t n_named_ = 0, time_ = 0;
    Csv csv_;
    Splitter splitter_;
    Cells cells_;
    std::vector<Record> pending_;  ///< lines without a stamp since the last row
};

}  // namespace

std::size_t Csv::column(const std::string& name) const {
    const auto found = std::ranges::find(columns, name);
    if (found == columns.end()) fail_data(absent(file, header_line, name, columns));
    if (std::find(found + 1, columns.end(), name) != columns.end())
        fail_data(fmt::format("{}:{}: column \"{}\" stands there twice; rename one", file,
                              header_line, name));
    const auto index = static_cast<std::size_t>(found - columns.begin());
    for (const ShortRow& row : short_rows)
        if (row.n_cells <= index) fail_data(wrong_width(*this, row.line, row.n_cells));
    return index;
}

void Csv::check_is_whole(std::size_t row) const {
    for (const ShortRow& at : short_rows)
        if (at.line == lines[row]) fail_data(wrong_width(*this, at.line, at.n_cells));
}

CsvNames find_names(std::string_view text, const std::string& file, const CsvForm& form) {
    return NameFinder(text, file, form).find();
}

Csv parse_csv(std::string_view text, const std::string& file, const CsvForm& form,
              const CsvNames& names) {
    Records records(text, form);
    TableMaker table(file, form, names);
    Record record;
    int n_before = 0;
    while (records.next(record) && record.line < names.line)
        n_before += !record.is_comment() && separator_said(record.text) == 0;
    table.begin(record, n_before);
    table.reserve(static_cast<std::size_t>(std::ranges::count(text, '\n')), text.size());
    while (records.next(record)) table.take(record);
    return table.finish(records);
}

Csv parse_csv(const std::string& text, const std::string& file, const CsvForm& form) {
    return parse_csv(text, file, form, find_names(text, file, form));
}

}  // namespace bemcal::input
