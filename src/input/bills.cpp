/// Makes periods of a meter's read dates: from one stamp to the next, or from two
/// columns; estimated reads are merged with the next one that was read. Source:
/// CalTRACK 2.2.3 for estimated reads; what an end means follows from where the next bill
/// begins. Leaves out corrections of earlier bills; nothing is split, and overlaps are
/// refused.
#include "input/bills.hpp"

#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/nan.hpp"
#include "input/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using physics::format_date;
using physics::Interval;
using physics::Seconds;
using std::chrono::days;
using std::chrono::seconds;

[[noreturn]] void fail(const Csv& csv, std::size_t row, const std::string& message) {
    throw UserError(ExitCode::data,
                    fmt::format("{}:{}: {}", csv.file, csv.lines[row], message));
}

Seconds whole_hour(Seconds time) {
    return std::chrono::round<std::chrono::hours>(time);
}

/// The same day n months later; the last day of one month is the last of the other.
Seconds months_later(Seconds time, int n, bool is_last_day) {
    using namespace std::chrono;
    const auto day = floor<std::chrono::days>(time);
    const year_month_day date(day);
    const auto month = date.year() / date.month() + months(n);
    const auto last = sys_days(month / std::chrono::last);
    const auto same = sys_days(month / 1) + (date.day() - std::chrono::day(1));
    return (is_last_day ? last : std::min(same, last)) + (time - day);
}

bool is_last_of_month(Seconds time) {
    const std::chrono::year_month_day next(std::chrono::floor<days>(time + days(1)));
    return next.day() == std::chrono::day(1);
}

/// Whether each time is a month after the one before it, on the same day or the last.
bool are_months(const std::vector<Seconds>& times) {
    const bool last = std::ranges::all_of(times, is_last_of_month);
    for (std::size_t k = 1; k < times.size(); ++k)
        if (times[k] != months_later(times[k - 1], 1, last)) return false;
    return times.size() > 1;
}

/// The stamps as they are, whole hours.
std::vector<Seconds> times_of(const Stamps& stamps) {
    std::vector<Seconds> times;
    times.reserve(stamps.begins.size());
    // A stamp at an end was brought a second inside of what it ends.
    for (const Seconds begin : stamps.begins)
        times.push_back(whole_hour(begin + seconds(stamps.at_end ? 1 : 0)));
    return times;
}

/// Adds the time that is not in the file, where it is known.
void add_outermost(std::vector<Seconds>& times, bool at_end) {
    const bool last = std::ranges::all_of(times, is_last_of_month);
    if (at_end)
        times.insert(times.begin(), months_later(times.front(), -1, last));
    else
        times.push_back(months_later(times.back(), 1, last));
}

/// An end is the bill's last day, and not the day of the read, where most bills say so.
bool is_last_day(const std::vector<Seconds>& from, const std::vector<Seconds>& to) {
    int n_days = 0, n_meet = 0;
    for (std::size_t k = 1; k < from.size(); ++k) {
        n_meet += from[k] == to[k - 1] ? 1 : 0;
        n_days += from[k] == to[k - 1] + days(1) ? 1 : 0;
    }
    if (n_days != n_meet) return n_days > n_meet;
    return are_months({from.back(), to.back() + days(1)});
}

void check_bill(const Csv& csv, const std::vector<Bill>& bills, std::size_t k) {
    const Bill& bill = bills[k];
    if (bill.to <= bill.from)
        fail(csv, bill.row,
             fmt::format("ends on {}, not after its begin, {}", format_date(bill.to),
                         format_date(bill.from)));
    if (k > 0 && bill.from < bills[k - 1].to)
        fail(csv, bill.row,
             fmt::format("begins on {}, before the end of the bill before it, {}; take "
                         "one of them out",
                         format_date(bill.from), format_date(bills[k - 1].to)));
}

/// How many months each row is of, where none follows the next month: quarters begin on
/// days on which months do, too. 1 of rows of which some are months apart by chance.
int months_of_each(const std::vector<Bill>& months) {
    constexpr std::size_t fewest_rows = 3;
    if (months.size() < fewest_rows) return 1;
    std::vector<int> apart;
    for (std::size_t k = 1; k < months.size(); ++k)
        apart.push_back(physics::month_at(months[k].from) -
                        physics::month_at(months[k - 1].from));
    const int least = std::ranges::min(apart);
    const bool are_alike =
        std::ranges::all_of(apart, [&](int distance) { return distance % least == 0; });
    return are_alike ? least : 1;
}

/// One row for each interval of the calendar.
std::optional<std::vector<Bill>> on_calendar(const std::vector<Seconds>& stamps,
                                             const std::vector<double>& values,
                                             Interval interval, bool at_end) {
    constexpr seconds slack{36 * 3600};
    std::vector<Bill> bills;
    for (std::size_t row = 0; row < values.size(); ++row) {
        const Seconds stamp = stamps[row];
        const Seconds begin = interval_begin(stamp, interval);
        const Seconds end = next_interval(begin, interval);
        if ((at_end ? end - stamp : stamp - begin) > slack) return std::nullopt;
        if (!bills.empty() && begin < bills.back().to) return std::nullopt;
        bills.push_back({begin, end, values[row], false, row});
    }
    return bills;
}

/// The same of begins, by the site's clock or as they stand there: the first of a month
/// by a clock that is ahead of the site's is the last of the month before.
std::optional<std::vector<Bill>> begun_on_calendar(const Stamps& stamps,
                                                   const std::vector<double>& values,
                                                   Interval interval) {
    auto bills = on_calendar(stamps.begins, values, interval, false);
    return bills ? std::move(bills) : on_calendar(stamps.faces, values, interval, false);
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::find(words, word) != words.end();
}

/// Several bills that end with a read one; without it, nothing is known.
Bill one_of(const std::vector<Bill>& bills, std::size_t first, std::size_t last,
            bool is_mean) {
    Bill bill = bills[first];
    bill.to = bills[last].to;
    bill.is_estimated = bills[last].is_estimated;
    double sum = 0;
    for (std::size_t k = first; k <= last; ++k) {
        const double hours =
            static_cast<double>((bills[k].to - bills[k].from).count()) / 3600;
        sum += is_mean ? hours * bills[k].value : bills[k].value;
    }
    const double all = static_cast<double>((bill.to - bill.from).count()) / 3600;
    bill.value = bill.is_estimated ? nan : is_mean ? sum / all : sum;
    return bill;
}

void note_gaps(const std::vector<Bill>& bills, std::vector<TimeNote>& notes) {
    std::string first;
    int n = 0;
    for (std::size_t k = 1; k < bills.size(); ++k) {
        if (bills[k].from == bills[k - 1].to) continue;
        if (n++ == 0)
            first = fmt::format("{} to {}", format_date(bills[k - 1].to),
                                format_date(bills[k].from));
    }
    if (n > 0)
        notes.push_back({fmt::format("{} gap{} between its bills; the first: {}", n,
                                     n == 1 ? "" : "s", first),
                         "taken as missing"});
}

/// Another column of times, as they stand there.
Stamps ends_in(const Csv& csv, std::size_t column, const Stamps& stamps,
               StampRules rules) {
    rules.at_end = false;
    rules.is_said = true;
    return stamps_in(csv, column, rules, stamps.step_s);
}

/// Whether every row has a time there that is later than its begin, within half a year.
bool holds_ends(const Csv& csv, std::size_t column, const Stamps& stamps,
                const std::string& format) {
    for (std::size_t row = 0; row < csv.n_rows(); ++row) {
        try {
            const Seconds end = parse_stamp(csv.cell(row, column), format).face;
            const seconds length = end - stamps.begins[row];
            if (length < days(1) || length > days(183)) return false;
        } catch (const std::invalid_argument&) {
            return false;
        }
    }
    return true;
}

/// Of stamps that nobody called ends or begins.
std::optional<std::size_t> column_of_ends(const Csv& csv, const Stamps& stamps,
                                          const StampRules& rules) {
    for (std::size_t column = 1; column < csv.columns.size() && !rules.is_said; ++column)
        if (holds_ends(csv, column, stamps, rules.format)) return column;
    return std::nullopt;
}

void note_ends(const Csv& csv, std::size_t column, std::vector<TimeNote>& notes) {
    notes.push_back(
        {fmt::format("its column {} holds the ends of its bills", csv.columns[column]),
         "read so; the keys from and to overrule it"});
}

}  // namespace

std::optional<std::vector<Bill>> bills_by_calendar(const Stamps& stamps,
                                                   const std::vector<double>& values,
                                                   physics::Interval interval,
                                                   bool is_said,
                                                   std::vector<TimeNote>& notes) {
    const auto months_each = [&](const std::vector<Bill>& bills) {
        return interval == Interval::monthly ? months_of_each(bills) : 1;
    };
    if (stamps.at_end || is_said) {
        if (!stamps.at_end) return begun_on_calendar(stamps, values, interval);
        auto bills = on_calendar(stamps.begins, values, interval, true);
        if (!bills) return bills;
        const int n = months_each(*bills);
        if (n == 1) return bills;
        notes.push_back(
            {fmt::format("its rows end {} months apart", n), "each read as of as many"});
        for (Bill& bill : *bills) bill.from = months_later(bill.from, 1 - n, false);
        return bills;
    }
    if (auto bills = begun_on_calendar(stamps, values, interval)) {
        const int n = months_each(*bills);
        if (n == 1) return bills;
        notes.push_back({fmt::format("its rows begin {} months apart", n),
                         "each read as of as many; stamp = \"start\" makes them months"});
        return std::nullopt;
    }
    auto bills = on_calendar(stamps.begins, values, interval, true);
    if (bills && months_each(*bills) > 1) return std::nullopt;
    if (bills)
        notes.push_back({fmt::format("its stamps are the last days of {}",
                                     interval == Interval::monthly ? "months" : "years"),
                         "read as their ends; stamp = \"start\" overrules it"});
    return bills;
}

std::vector<Bill> bills_between(const Csv& csv, const Stamps& stamps,
                                const std::vector<double>& values,
                                std::vector<TimeNote>& notes) {
    std::vector<Seconds> times = times_of(stamps);
    const bool knows_all = are_months(times);
    const std::size_t outermost = stamps.at_end ? 0 : values.size() - 1;
    if (knows_all) add_outermost(times, stamps.at_end);
    if (!knows_all && !std::isnan(values[outermost]))
        notes.push_back({fmt::format("when its {} bill {} is not in the file",
                                     stamps.at_end ? "first" : "last",
                                     stamps.at_end ? "begins" : "ends"),
                         "that reading is left out; columns from and to say it"});
    std::vector<Bill> bills;
    const std::size_t skipped = !knows_all && stamps.at_end ? 1 : 0;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        const std::size_t row = k + skipped;
        bills.push_back({times[k], times[k + 1], values[row], false, row});
        check_bill(csv, bills, k);
    }
    return bills;
}

std::vector<Bill> bills_from_to(const Csv& csv, const Stamps& from, const Stamps& to,
                                const std::vector<double>& values,
                                std::vector<TimeNote>& notes) {
    const std::vector<Seconds> begins = times_of(from);
    std::vector<Seconds> ends = times_of(to);
    if (is_last_day(begins, ends)) {
        for (Seconds& end : ends) end += days(1);
        notes.push_back({"its bills end the day before the next begins",
                         "their ends are read as last days"});
    }
    std::vector<Bill> bills;
    for (std::size_t row = 0; row < begins.size(); ++row) {
        bills.push_back({begins[row], ends[row], values[row], false, row});
        check_bill(csv, bills, row);
    }
    return bills;
}

std::vector<Bill> bills_in(const Csv& csv, const BillColumns& columns,
                           const Stamps& stamps, const StampRules& rules,
                           const std::vector<double>& values, Interval interval,
                           bool is_mean, std::vector<TimeNote>& notes) {
    std::vector<Bill> bills;
    const auto with_ends = [&](std::size_t column) {
        return bills_from_to(csv, stamps, ends_in(csv, column, stamps, rules), values,
                             notes);
    };
    if (!columns.from.empty() && !columns.to.empty()) {
        bills = with_ends(csv.column(columns.to));
    } else if (auto found =
                   bills_by_calendar(stamps, values, interval, rules.is_said, notes)) {
        bills = std::move(*found);
    } else if (const auto column = column_of_ends(csv, stamps, rules)) {
        note_ends(csv, *column, notes);
        bills = with_ends(*column);
    } else {
        bills = bills_between(csv, stamps, values, notes);
    }
    if (columns.estimated.empty()) return bills;
    mark_estimated(csv, columns.estimated, bills);
    return merged(bills, is_mean, notes);
}

std::vector<Bill> reads_of_register(const Csv& csv, const BillColumns& columns,
                                    const Stamps& stamps,
                                    const std::vector<double>& values,
                                    std::vector<TimeNote>& notes) {
    const std::vector<Seconds> times = times_of(stamps);
    std::vector<Bill> reads;
    reads.reserve(values.size());
    for (std::size_t row = 0; row < values.size(); ++row)
        reads.push_back({times[row], times[row], values[row], false, row});
    if (!columns.estimated.empty()) mark_estimated(csv, columns.estimated, reads);
    const auto n = std::erase_if(reads, [](const Bill& read) {
        return read.is_estimated || std::isnan(read.value);
    });
    for (std::size_t k = 1; k < reads.size(); ++k)
        if (reads[k].from <= reads[k - 1].from)
            fail(csv, reads[k].row,
                 "a second read of the register in the same hour; leave one of them out");
    if (n > 0)
        notes.push_back({fmt::format("{} of its reads {} missing or estimated", n,
                                     n == 1 ? "is" : "are"),
                         "left out; the use is from the read before to the one after"});
    return reads;
}

void mark_estimated(const Csv& csv, const std::string& column, std::vector<Bill>& bills) {
    const std::size_t at = csv.column(column);
    for (Bill& bill : bills) {
        const std::string word = lower_case(csv.cell(bill.row, at));
        bill.is_estimated = is_one_of(word, {"1", "1.0", "true", "yes", "y", "e", "est",
                                             "estimate", "estimated", "x"});
        if (bill.is_estimated ||
            is_one_of(word, {"", "0", "0.0", "false", "no", "n", "a", "actual", "r",
                             "read", "m", "measured", "-"}))
            continue;
        fail(csv, bill.row,
             fmt::format("{}: \"{}\": expected 1, true, yes or E where the read is "
                         "estimated, and 0, false, no, A or nothing where it is not",
                         column, word.substr(0, 40)));
    }
}

std::vector<Bill> merged(const std::vector<Bill>& bills, bool is_mean,
                         std::vector<TimeNote>& notes) {
    std::vector<Bill> found;
    int n_merged = 0, n_lost = 0;
    for (std::size_t first = 0, k = 0; k < bills.size(); ++k) {
        const bool goes_on = k + 1 < bills.size() && bills[k + 1].from == bills[k].to;
        if (bills[k].is_estimated && goes_on) continue;
        found.push_back(one_of(bills, first, k, is_mean));
        const int n = static_cast<int>(k - first) + (bills[k].is_estimated ? 1 : 0);
        (bills[k].is_estimated ? n_lost : n_merged) += n;
        first = k + 1;
    }
    if (n_merged > 0)
        notes.push_back({fmt::format("{} read{} estimated", n_merged,
                                     n_merged == 1 ? " is" : "s are"),
                         "merged with the next that was read"});
    if (n_lost > 0)
        notes.push_back({fmt::format("{} estimated read{} followed by none that was read",
                                     n_lost, n_lost == 1 ? " is" : "s are"),
                         "taken as missing"});
    return found;
}

bool are_of_calendar(const std::vector<Bill>& bills, Interval interval) {
    return std::ranges::all_of(bills, [&](const Bill& bill) {
        return bill.from == interval_begin(bill.from, interval) &&
               bill.to == next_interval(bill.from, interval);
    });
}

RegularSeries series_of(const std::vector<Bill>& bills, std::vector<TimeNote>& notes) {
    RegularSeries hours;
    const Seconds start = bills.front().from, end = bills.back().to;
    hours.axis = {start, 3600, static_cast<int>((end - start).count() / 3600)};
    hours.values.assign(static_cast<std::size_t>(hours.axis.n_steps), nan);
    for (const Bill& bill : bills)
        hours.values[static_cast<std::size_t>(hours.axis.step_of(bill.from))] =
            bill.value;
    note_gaps(bills, notes);
    return hours;
}

std::vector<Seconds> bounds_of(const std::vector<Bill>& bills) {
    std::vector<Seconds> bounds;
    for (const Bill& bill : bills)
        for (const Seconds time : {bill.from, bill.to})
            if (bounds.empty() || bounds.back() != time) bounds.push_back(time);
    return bounds;
}

}  // namespace bemcal::input
