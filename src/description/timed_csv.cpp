/// Opens a CSV file as a section says it is to be read (clock, stamp, format, decimal
/// mark, gaps), and gives columns as even series or hourly means.
/// Follows from `csv`, `stamps` and `series`, one after the other.
/// Units and ranges are left to the readers. Rows over an hour apart have no hourly
/// means: an error.
#include "description/timed_csv.hpp"

#include "base/error.hpp"
#include "description/building_readers.hpp"
#include "description/csv_form.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

input::Clock clock_of(const schema::Section& section) {
    return section.has("clock")
               ? static_cast<input::Clock>(static_cast<int>(input::Clock::standard) +
                                           section.choice_as<int>("clock"))
               : input::Clock::unstated;
}

std::string time_format_of(const schema::Section& section) {
    const std::string format = section.text("time_format");
    if (!format.empty())
        at_key(section, "time_format", [&] { input::check_time_format(format); });
    return format;
}

}  // namespace

input::StampRules stamp_rules(const schema::Section& section, const physics::Site& site) {
    input::StampRules rules;
    rules.at_end = section.choice("stamp") == "end";
    rules.is_said = section.has("stamp");
    rules.clock = clock_of(section);
    rules.site_offset_h = site.utc_offset_h;
    rules.file_offset_h = site.utc_offset_h;
    section.number_if("utc_offset", rules.file_offset_h);
    rules.format = time_format_of(section);
    return rules;
}

void check_files(const schema::Section& section, const char* key,
                 const std::vector<std::string>& columns, input::InputFiles& files) {
    section.attempt_all(
        [&] { time_format_of(section); }, [&] { number_form(section); },
        [&] {
            section.attempt_each(section.texts(key), [&](const std::string& file) {
                const input::Csv& csv =
                    files.csv(section.path(file), section.where(key), csv_form(section));
                section.attempt_each(
                    columns, [&](const std::string& column) { csv.column(column); });
            });
        });
}

namespace {

/// The columns of the time; a file with a day a line is rolled out before.
input::TimeColumns open_time(const schema::Section& section, const OpenOptions& options,
                             TimedCsv& source) {
    const std::string& format = source.rules.format;
    const std::string& column = options.from.empty() ? options.to : options.from;
    input::TimeColumns time = input::time_columns(
        *source.csv,
        column.empty() ? section.texts("time") : std::vector<std::string>{column},
        format);
    if (options.days_of.empty()) return time;
    auto rows = input::unrolled(*source.csv, options.days_of, time, format,
                                options.days_by_clock);
    if (!rows) return time;
    source.own = std::make_shared<const input::Csv>(std::move(*rows));
    source.csv = source.own.get();
    source.rules.at_end = source.rules.at_end && !time.by_ends;
    source.rules.is_said = true;
    return time;
}

/// A column called time_utc by a job that does not say so.
void doubt_clock(const schema::Section& section, const input::TimeColumns& time,
                 TimedCsv& source) {
    const std::string name = input::names_of(*source.csv, time);
    const bool says_utc = name.find("utc") != std::string::npos ||
                          name.find("UTC") != std::string::npos ||
                          name.find("GMT") != std::string::npos;
    if (!says_utc || section.has("utc_offset") || source.rules.site_offset_h == 0) return;
    source.stamps.notes.push_back(
        {fmt::format("its time stands in the column {}", name),
         fmt::format("stamps without an offset read by the site's clock, {:+g} h; "
                     "utc_offset = 0 would read them as UTC",
                     source.rules.site_offset_h)});
}

/// A trend with times of its own beside others.
void refuse_other_times(const schema::Section& section, const OpenOptions& options,
                        const input::TimeColumns& time, const TimedCsv& source) {
    if (options.days_of.empty() || section.has("time") ||
        source.stamps.step_s > physics::day_s)
        return;
    const input::Csv& csv = *source.csv;
    const auto other =
        input::own_time_of(csv, time, csv.column(options.days_of), source.rules.format);
    if (!other) return;
    throw UserError(
        ExitCode::data,
        fmt::format("{}:{}: {}: stands behind a time of its own, {}, whose times are not "
                    "those of {}; write time = \"{}\", or time = \"{}\" if they are no "
                    "times of its readings",
                    csv.file, csv.header_line, options.days_of, csv.columns[*other],
                    input::names_of(csv, time), csv.columns[*other],
                    input::names_of(csv, time)));
}

/// Files of one meter often show the same; it is said once.
void add_once(const study::DataDecision& made,
              std::vector<study::DataDecision>& decisions) {
    if (std::ranges::none_of(decisions, [&](const study::DataDecision& known) {
            return known.series == made.series && known.finding == made.finding;
        }))
        decisions.push_back(made);
}

}  // namespace

TimedCsv open_csv(const schema::Section& section, const char* key,
                  const std::string& file, input::InputFiles& files,
                  const physics::Site& site, const OpenOptions& options) {
    TimedCsv source;
    source.csv = &files.csv(section.path(file), section.where(key), csv_form(section));
    source.rules = stamp_rules(section, site);
    source.rules.is_mean = options.is_mean;
    source.rules.is_count = options.is_count;
    if (!options.from.empty() || !options.to.empty()) {
        source.rules.is_said = true;
        source.rules.at_end = options.from.empty();
    }
    const input::TimeColumns time = open_time(section, options, source);
    source.stamps =
        input::stamps_in(*source.csv, time, source.rules, options.fallback_step_s);
    source.rules.at_end = source.stamps.at_end;
    doubt_clock(section, time, source);
    refuse_other_times(section, options, time, source);
    source.numbers = number_form(section);
    source.gaps_are_missing = section.choice("gaps") == "missing";
    return source;
}

std::string row_at(const TimedCsv& source, physics::Seconds begin) {
    const auto& begins = source.stamps.begins;
    const auto row = std::ranges::lower_bound(begins, begin);
    if (row == begins.end()) return source.csv->file;
    return fmt::format("{}:{}", source.csv->file,
                       source.csv->lines[static_cast<std::size_t>(row - begins.begin())]);
}

void state_lines(const TimedCsv& source, std::vector<study::DataDecision>& decisions) {
    const std::string file = std::filesystem::path(source.csv->file).filename();
    for (const std::string& note : source.csv->notes)
        add_once({file, note, "as said"}, decisions);
}

void note_stamps(const TimedCsv& source, const std::string& series,
                 std::vector<study::DataDecision>& decisions) {
    for (const input::TimeNote& note : source.stamps.notes)
        add_once({"stamps of " + series, note.finding, note.action}, decisions);
}

input::RegularSeries series_of(const TimedCsv& source, const std::string& column,
                               input::Fold fold) {
    const input::Csv& csv = *source.csv;
    input::RegularSeries series =
        input::lay(csv, source.stamps,
                   input::numbers_in(csv, csv.column(column), source.numbers), fold);
    if (!source.gaps_are_missing) input::refuse_gaps(csv, series);
    return input::on_whole_steps(std::move(series));
}

input::RegularSeries hourly_means(const input::RegularSeries& series,
                                  const std::string& file) {
    const int per_hour = 3600 / std::max(series.axis.step_s, 1);
    if (3600 % series.axis.step_s != 0)
        throw UserError(
            ExitCode::data,
            fmt::format("{}: its rows are {} s apart; expected hours, or steps that "
                        "divide an hour",
                        file, series.axis.step_s));
    const auto first = std::chrono::ceil<std::chrono::hours>(series.axis.start);
    if ((first - series.axis.start).count() % series.axis.step_s != 0)
        throw UserError(
            ExitCode::data,
            fmt::format("{}: its hours begin at {} local standard time, not on the "
                        "hour; check time, stamp and utc_offset",
                        file, physics::format_time(series.axis.start)));
    const auto last = std::chrono::floor<std::chrono::hours>(series.axis.end());
    input::RegularSeries hours;
    hours.axis = {first, 3600, std::max(0, static_cast<int>((last - first).count()))};
    const int skipped = series.axis.step_of(first);
    for (int hour = 0; hour < hours.axis.n_steps; ++hour) {
        double sum = 0;
        for (int i = 0; i < per_hour; ++i)
            sum += series.values[static_cast<std::size_t>(skipped + hour * per_hour + i)];
        hours.values.push_back(sum / per_hour);
    }
    return hours;
}

}  // namespace bemcal::description
