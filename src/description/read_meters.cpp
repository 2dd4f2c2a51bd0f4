/// Reads [[meter]]: rows of its files on an even axis, corrected by the job's scales and
/// mask, checked, converted to kWh or degC, and brought to the meter's interval.
/// Follows from `series`, `check_series`, `units` and `intervals`, in this order.
/// Readings over an hour apart are not checked, and of months only one file is read.
/// Stamps are read by `stamps`.
#include "base/error.hpp"
#include "base/nan.hpp"
#include "checks/values.hpp"
#include "description/building_readers.hpp"
#include "description/repeated.hpp"
#include "description/result_names.hpp"
#include "description/timed_csv.hpp"
#include "input/bills.hpp"
#include "input/intervals.hpp"
#include "input/suggest.hpp"
#include "input/units.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Interval;
using physics::Quantity;
using physics::Seconds;
using study::Meter;

constexpr double missing = nan;

const input::Unit& unit_of(const schema::Section& section, Quantity quantity) {
    const bool temperature = physics::is_temperature(quantity);
    const std::string name = section.text("unit");
    std::vector<std::string> names;
    for (const input::Unit& unit : input::units()) {
        if ((unit.kind == input::UnitKind::temperature) != temperature) continue;
        if (name == unit.name) return unit;
        names.emplace_back(unit.name);
    }
    section.fail_value("unit",
                       fmt::format("is not a unit of {}{}",
                                   temperature ? "temperature" : "energy or power",
                                   input::suggestion(name, names)));
}

/// A change of the readings in a range of time, as the job writes it.
struct Correction {
    std::string text;
    study::Period range;
    double factor = 1;
};

/// One meter on its way from its file to study::Meter.
class MeterReader {
  public:
    MeterReader(const schema::Section& section, input::InputFiles& files,
                study::Case& building)
        : section_(section), files_(files), building_(building) {}

    /// What stands in its section, whatever is known of the site and the periods.
    void read_keys() {
        section_.attempt_all(
            [&] { read_name(); },
            [&] {
                meter_.quantity = section_.choice_as<Quantity>("quantity");
                unit_of(section_, meter_.quantity);
            },
            [&] { meter_.interval = section_.choice_as<Interval>("interval"); },
            [&] { read_price("tariff", &Meter::tariff); },
            [&] { read_price("co2", &Meter::co2); }, [&] { read_corrections(); },
            [&] { read_column(); });
    }

    Meter read() {
        if (!section_.has("file")) return without_readings();
        const std::vector<TimedCsv> sources = open_files();
        input::RegularSeries series = sources[0].stamps.step_s <= physics::day_s
                                          ? even_rows(sources)
                                          : billed_rows(sources);
        meter_.axis = series.axis;
        meter_.values = std::move(series.values);
        check_readings(sources);
        return std::move(meter_);
    }

  private:
    void read_name() {
        meter_.name = section_.text("name");
        if (std::ranges::find(building_.meters, meter_.name, &Meter::name) !=
            building_.meters.end())
            section_.fail_value("name", "another meter has this name");
        check_name(section_, "name", Named::meter, meter_.name);
    }

    /// Of a kWh of an energy, whichever of its meters says it.
    void read_price(const char* key, double Meter::* price) {
        if (!section_.has(key)) return;
        meter_.*price = section_.number(key);
        if (physics::is_temperature(meter_.quantity))
            section_.fail(key, "has no place at a temperature; leave it out");
        for (const Meter& other : building_.meters)
            if (other.quantity == meter_.quantity && other.*price != meter_.*price &&
                !std::isnan(other.*price))
                section_.fail_value(
                    key, fmt::format("the meter \"{}\" of the same energy has {:g}; "
                                     "expected one price of an energy",
                                     other.name, other.*price));
    }

    /// The column, and that the files have it.
    void read_column() {
        if (!section_.has("file")) return;
        std::vector<std::string> names;
        section_.attempt_all(
            [&] {
                section_.node("column");
                names.push_back(column_ = section_.text("column"));
            },
            [&] { check_files(section_, "file", names, files_); });
    }

    /// A meter that is predicted only.
    Meter without_readings() {
        Seconds from = building_.periods.front().from, to = from;
        for (const study::Period& period : building_.periods) {
            from = std::min(from, period.from);
            to = std::max(to, period.to);
        }
        unit_of(section_, meter_.quantity);
        const int step_s = meter_.interval == Interval::step ? building_.step_s : 3600;
        meter_.axis = {from, step_s, static_cast<int>((to - from).count() / step_s)};
        meter_.values.assign(static_cast<std::size_t>(meter_.axis.n_steps), missing);
        decide("no file", "predicted only");
        return std::move(meter_);
    }

    std::vector<TimedCsv> open_files() {
        std::vector<TimedCsv> sources;
        const OpenOptions options{nominal_step(),
                                  fold() == input::Fold::mean,
                                  column_,
                                  meter_.interval > Interval::hourly,
                                  section_.text("from"),
                                  section_.text("to"),
                                  counts()};
        for (const std::string& file : section_.texts("file")) {
            sources.push_back(open_csv(section_, "file", file, files_,
                                       building_.weather.site, options));
            state_lines(sources.back(), building_.decisions);
            note_stamps(sources.back(), meter_.name, building_.decisions);
        }
        if (sources.empty()) section_.fail("file", "is empty; expected a CSV file");
        return sources;
    }

    int nominal_step() const {
        constexpr int steps[] = {3600, 3600, physics::day_s, 31 * physics::day_s,
                                 365 * physics::day_s};
        return steps[static_cast<int>(meter_.interval.kind)];
    }

    void decide(std::string finding, std::string action) {
        building_.decisions.push_back(
            {meter_.name, std::move(finding), std::move(action)});
    }

    bool counts() const { return section_.choice("register") == "difference"; }

    /// Energies of finer rows add up; powers and temperatures are averaged.
    input::Fold fold() const {
        if (counts()) return input::Fold::first;
        return unit_of(section_, meter_.quantity).kind == input::UnitKind::energy
                   ? input::Fold::sum
                   : input::Fold::mean;
    }

    void drop_repeated_rows(input::RegularSeries& series, input::RegularSeries& next,
                            std::span<const TimedCsv> sources) {
        const int n_both = drop_repeated(series, next, sources);
        if (n_both > 0)
            decide(
                fmt::format("{}: {} readings that the files before it have, too, alike",
                            sources.back().csv->file, n_both),
                "taken once");
    }

    /// Files one after the other, at the longest of their steps.
    input::RegularSeries joined(const std::vector<TimedCsv>& sources) {
        std::vector<input::RegularSeries> parts;
        int step_s = 1;
        for (const TimedCsv& source : sources) {
            parts.push_back(series_of(source, column_, fold()));
            if (counts()) stamp_by_instant(source, parts.back().axis);
            step_s = std::lcm(step_s, parts.back().axis.step_s);
        }
        input::RegularSeries series = input::coarsened(parts[0], step_s, fold());
        for (std::size_t k = 1; k < parts.size(); ++k) {
            input::RegularSeries next = input::coarsened(parts[k], step_s, fold());
            drop_repeated_rows(series, next,
                               std::span<const TimedCsv>(sources).first(k + 1));
            if (next.axis.n_steps > 0) input::append(series, next, sources[k].csv->file);
        }
        return series;
    }

    /// A register is read at an instant, whichever interval the stamp closes.
    static void stamp_by_instant(const TimedCsv& source, physics::TimeAxis& axis) {
        if (source.rules.at_end) axis.start += std::chrono::seconds(axis.step_s);
    }

    input::RegularSeries even_rows(const std::vector<TimedCsv>& sources) {
        input::RegularSeries series = joined(sources);
        note_gaps(series);
        const bool checked = physics::day_s % series.axis.step_s == 0;
        if (checked && meter_checks("codes"))
            decide(checks::mask_codes(series, meter_.quantity));
        take_use(series, sources, checked);
        correct(series);
        if (checked) check(series, sources);
        convert(series);
        check_room(series, sources);
        return on_intervals(std::move(series));
    }

    bool meter_checks(const char* key) const { return section_.choice(key) == "check"; }

    void decide(std::vector<checks::Finding> findings) {
        for (checks::Finding& found : findings)
            decide(std::move(found.finding), std::move(found.action));
    }

    /// What the file leaves open, at the row that shows it.
    void ask(const std::optional<checks::Question>& question,
             const input::RegularSeries& series,
             const std::vector<TimedCsv>& sources) const {
        if (!question) return;
        const physics::Seconds begin = series.axis.begin_of(question->at);
        const auto source = std::ranges::find_if(sources, [&](const TimedCsv& candidate) {
            return candidate.stamps.begins.back() >= begin;
        });
        const TimedCsv& of = source == sources.end() ? sources.back() : *source;
        throw UserError(ExitCode::data, fmt::format("{}:{}: {}", row_at(of, begin),
                                                    column_, question->text));
    }

    /// The use of each step where the readings are a register's.
    void take_use(input::RegularSeries& series, const std::vector<TimedCsv>& sources,
                  bool checked) {
        if (counts())
            decide(checks::take_differences(series));
        else if (checked && meter_checks("register"))
            ask(checks::doubt_of_register(series, meter_.quantity), series, sources);
    }

    void check_below_zero(input::RegularSeries& series,
                          const std::vector<TimedCsv>& sources) {
        std::optional<checks::Question> question;
        decide(checks::check_negative(series, meter_.quantity,
                                      section_.choice_as<checks::Handling>("negative"),
                                      question));
        ask(question, series, sources);
    }

    /// Values, then runs and steps.
    void check(input::RegularSeries& series, const std::vector<TimedCsv>& sources) {
        const checks::CheckOptions options = check_options();
        check_below_zero(series, sources);
        if (meter_checks("spikes")) decide(checks::mask_spikes(series, meter_.quantity));
        decide(series.axis.step_s <= 3600
                   ? checks::check_series(series, meter_.quantity, options)
                   : checks::check_days(series, meter_.quantity, options));
    }

    /// After its conversion to degC.
    void check_room(const input::RegularSeries& series,
                    const std::vector<TimedCsv>& sources) const {
        if (meter_.quantity != Quantity::air_temperature) return;
        const bool is_as_read = meter_.unit == "degC" && section_.number("factor") == 1;
        ask(checks::doubt_of_room(series, is_as_read), series, sources);
    }

    /// Months and years of the calendar, and bills between any reads.
    input::RegularSeries billed_rows(const std::vector<TimedCsv>& sources) {
        if (sources.size() > 1)
            section_.fail("file",
                          "has several files of months or years; put them into one");
        check_step_of_bills(sources[0].stamps.step_s);
        std::vector<input::TimeNote> notes;
        const std::vector<input::Bill> bills = read_bills(sources[0], notes);
        if (bills.empty())
            section_.fail("file",
                          sources[0].csv->file +
                              (counts() ? " has less than two reads of its register"
                                        : " has one row, and not when it ends; give "
                                          "columns from and to"));
        if (!input::are_of_calendar(bills, meter_.interval)) {
            meter_.interval.bounds = input::bounds_of(bills);
            notes.push_back(
                {"its rows are no intervals of the calendar",
                 fmt::format("read as {} bills, each over its own time", bills.size())});
        }
        input::RegularSeries series = input::series_of(bills, notes);
        check_bills(series, sources);
        for (input::TimeNote& note : notes)
            building_.decisions.push_back({"stamps of " + meter_.name,
                                           std::move(note.finding),
                                           std::move(note.action)});
        correct(series);
        convert(series);
        check_room(series, sources);
        return series;
    }

    void check_bills(input::RegularSeries& series, const std::vector<TimedCsv>& sources) {
        if (meter_checks("codes")) decide(checks::mask_codes(series, meter_.quantity));
        if (meter_checks("register"))
            decide(checks::state_bills(series, meter_.quantity));
        check_below_zero(series, sources);
    }

    void check_step_of_bills(int step_s) const {
        constexpr int longest_month = 130 * physics::day_s,
                      shortest_year = 300 * physics::day_s;
        if (meter_.interval < Interval::monthly ||
            (meter_.interval == Interval::monthly ? step_s > longest_month
                                                  : step_s < shortest_year))
            refuse_rows(step_s);
        if (unit_of(section_, meter_.quantity).kind == input::UnitKind::power)
            section_.fail_value("unit",
                                "is a power, but the rows are months or years; convert "
                                "them to energies");
    }

    std::vector<input::Bill> read_bills(const TimedCsv& source,
                                        std::vector<input::TimeNote>& notes) {
        const input::Csv& csv = *source.csv;
        const input::BillColumns columns{section_.text("from"), section_.text("to"),
                                         section_.text("estimated")};
        const std::vector<double> values =
            input::numbers_in(csv, csv.column(column_), source.numbers);
        if (counts())
            return uses_between(
                input::reads_of_register(csv, columns, source.stamps, values, notes));
        return input::bills_in(csv, columns, source.stamps, source.rules, values,
                               meter_.interval,
                               meter_.quantity == Quantity::air_temperature, notes);
    }

    /// The bills from each read of a register to the next.
    std::vector<input::Bill> uses_between(std::vector<input::Bill> reads) {
        if (section_.has("from"))
            section_.fail_value("from",
                                "is the begin of a use, but register = "
                                "\"difference\" has reads, each at one time; "
                                "give their column as time");
        if (reads.size() < 2) return {};
        decide(checks::take_differences(reads));
        return reads;
    }

    void note_gaps(const input::RegularSeries& series) {
        int absent = 0;
        for (const input::Gap& gap : series.gaps) absent += gap.n;
        if (absent > 0)
            decide(
                fmt::format("{} gaps, {} rows in all; the first: {}", series.gaps.size(),
                            absent, input::words_of(series.gaps[0], series.axis)),
                "taken as missing");
        const auto n = std::count_if(series.values.begin(), series.values.end(),
                                     [](double v) { return std::isnan(v); });
        if (n > absent)
            decide(
                fmt::format("{} empty readings of {}", n - absent, series.values.size()),
                "taken as missing");
    }

    template <class Change>
    static void for_steps(input::RegularSeries& series, const study::Period& range,
                          Change change) {
        for (int k = 0; k < series.axis.n_steps; ++k) {
            const Seconds begin = series.axis.begin_of(k);
            if (range.from <= begin && begin < range.to)
                change(series.values[static_cast<std::size_t>(k)]);
        }
    }

    /// What [[meter.scale]] and the mask say of the readings of a file.
    void read_corrections() {
        if (!section_.has("file")) return;
        section_.attempt_all(
            [&] {
                const auto read = [&](const auto& scale) { read_scale(scale); };
                if (!section_.each("scale", "meter.scale", read)) throw schema::Follows();
            },
            [&] {
                section_.attempt_each(
                    section_.texts("mask"), [&](const std::string& text) {
                        masks_.push_back(
                            {text, read_slashed_range(section_, "mask", text)});
                    });
            });
    }

    void read_scale(const schema::Section& section) {
        Correction scale;
        section.attempt_all(
            [&] {
                scale.text = section.text("from");
                scale.range =
                    read_range(section, "from", scale.text,
                               section.has("to") ? section.text("to") : "2500-01-01");
            },
            [&] { scale.factor = section.number("factor"); });
        scales_.push_back(std::move(scale));
    }

    /// Scales in the order of the file, then the mask.
    void correct(input::RegularSeries& series) {
        for (const Correction& scale : scales_) {
            for_steps(series, scale.range, [&](double& value) { value *= scale.factor; });
            decide(fmt::format("the job's scale from {}", scale.text),
                   fmt::format("scaled by {:g}", scale.factor));
        }
        for (const Correction& mask : masks_) {
            for_steps(series, mask.range, [](double& value) { value = missing; });
            decide(fmt::format("the job's mask {}", mask.text), "masked");
        }
    }

    checks::CheckOptions check_options() const {
        return {section_.choice_as<checks::Handling>("zeros"),
                section_.choice_as<checks::Handling>("constant"),
                section_.choice_as<checks::StepHandling>("steps"),
                static_cast<int>(section_.integer("zero_run")),
                static_cast<int>(section_.integer("constant_run"))};
    }

    void convert(input::RegularSeries& series) {
        const input::Unit& unit = unit_of(section_, meter_.quantity);
        meter_.unit = unit.name;
        meter_.row_s = series.axis.step_s;
        const double hours =
            unit.kind == input::UnitKind::power ? series.axis.step_s / 3600.0 : 1;
        const double factor = section_.number("factor") * unit.factor * hours;
        for (double& value : series.values) value = value * factor + unit.offset;
        if (*unit.source != '\0')
            decide(fmt::format("readings in {}", unit.name),
                   fmt::format("scaled by {:.4g} kWh ({})", unit.factor, unit.source));
    }

    input::RegularSeries on_intervals(input::RegularSeries series) {
        const int step_s = series.axis.step_s;
        const Interval rows = input::interval_of_rows(step_s);
        if ((rows == Interval::step ? 3600 : physics::day_s) % step_s != 0)
            refuse_rows(step_s);
        if (meter_.interval == Interval::step) return series;
        if (rows > meter_.interval) refuse_rows(step_s);
        return step_s == physics::day_s ? on_days(std::move(series)) : summed(series);
    }

    input::RegularSeries summed(const input::RegularSeries& series) const {
        return input::sum_intervals(series, meter_.interval,
                                    physics::is_temperature(meter_.quantity));
    }

    /// Days that begin at another hour than midnight, such as those of gas, stay as they
    /// are.
    input::RegularSeries on_days(input::RegularSeries series) {
        const Seconds midnight = std::chrono::floor<std::chrono::days>(series.axis.start);
        const auto late =
            std::chrono::round<std::chrono::hours>(series.axis.start - midnight);
        series.axis.start = midnight;
        input::RegularSeries days = summed(series);
        if (late.count() == 0) return days;
        meter_.interval.bounds = input::bounds_of(days.axis, meter_.interval);
        for (Seconds& bound : meter_.interval.bounds) bound += late;
        days.axis.start += late;
        decide(
            fmt::format("its days begin at {:02}:00 local standard time", late.count()),
            "held against the same hours of the model");
        return days;
    }

    [[noreturn]] void refuse_rows(int step_s) const {
        constexpr int shortest_month_s = 28 * physics::day_s;
        section_.fail(
            "interval",
            fmt::format("is {}, but the rows of the file are {} s apart; expected "
                        "steps that divide an hour, hours, days, calendar months or "
                        "years, none longer than the interval{}",
                        physics::name_of(meter_.interval), step_s,
                        step_s >= shortest_month_s ? ", as interval = \"monthly\"" : ""));
    }

    bool has_reading_in(const study::Period& period) const {
        for (int k = 0; k < meter_.axis.n_steps; ++k) {
            const Seconds begin = meter_.axis.begin_of(k);
            if (period.from <= begin && begin < period.to &&
                !std::isnan(meter_.values[static_cast<std::size_t>(k)]))
                return true;
        }
        return false;
    }

    /// The training period needs readings; what else was not measured is predicted only.
    void check_readings(const std::vector<TimedCsv>& sources) {
        for (const study::Period& period : building_.periods) {
            if (has_reading_in(period)) continue;
            if (&period != &building_.periods.front()) {
                decide("no reading in the period " + period.name, "predicted only there");
                continue;
            }
            section_.fail(
                "file",
                fmt::format("{} has no reading of {} in the period {} ({} to {}); {}",
                            sources[0].csv->file, column_, period.name,
                            physics::format_time(period.from),
                            physics::format_time(period.to), advice_on(period, sources)));
        }
    }

    /// What to look at where a period has no reading.
    std::string advice_on(const study::Period& period,
                          const std::vector<TimedCsv>& sources) const {
        const Seconds from = meter_.axis.start, to = meter_.axis.end();
        const bool has_rows = from < period.to && period.from < to;
        return fmt::format(
            "its stamps {} to {} are {} to {} local standard time: {}",
            sources.front().stamps.first, sources.back().stamps.last,
            physics::format_time(from), physics::format_time(to),
            has_rows ? "those in the period are empty, masked or of intervals that are "
                       "not whole; check mask, zeros, constant and interval"
                     : "check the period, time_format, utc_offset, clock and stamp");
    }

    const schema::Section& section_;
    input::InputFiles& files_;
    study::Case& building_;
    std::string column_;
    std::vector<Correction> scales_, masks_;
    Meter meter_;
};

}  // namespace

void read_meters(const Sources& sources, input::InputFiles& files, bool is_placed,
                 study::Case& building) {
    const bool is_whole = sources.each("meter", [&](const schema::Section& section) {
        MeterReader reader(section, files, building);
        reader.read_keys();
        if (!is_placed) throw schema::Follows();
        building.meters.push_back(reader.read());
    });
    if (is_whole) checks::check_clocks(building);
}

}  // namespace bemcal::description
