/// Opens a CSV file as a section says it is to be read (clock, stamp, format, decimal
/// mark, gaps), and gives columns as even series or hourly means.
/// Follows from `csv`, `stamps` and `series`, one after the other.
/// Units and ranges are left to the readers. Rows over an hour apart have no hourly
/// means: an error.
#include "job/timed_csv.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace bemcal::job {

namespace {

input::Clock clock_of(const schema::Section& section) {
    return section.has("clock")
               ? static_cast<input::Clock>(static_cast<int>(input::Clock::standard) +
                                           section.choice_as<int>("clock"))
               : input::Clock::unstated;
}

}  // namespace

input::StampRules stamp_rules(const schema::Section& section, const physics::Site& site) {
    input::StampRules rules;
    rules.at_end = section.choice("stamp") == "end";
    rules.clock = clock_of(section);
    rules.site_offset_h = site.utc_offset_h;
    rules.file_offset_h = site.utc_offset_h;
    section.number_if("utc_offset", rules.file_offset_h);
    rules.format = section.text("time_format");
    return rules;
}

TimedCsv open_csv(const schema::Section& section, const char* key,
                  const std::string& file, input::InputFiles& files,
                  const physics::Site& site, int fallback_step_s) {
    TimedCsv source;
    source.csv = &files.csv(section.path(file), section.where(key));
    source.rules = stamp_rules(section, site);
    const std::string time = section.text("time");
    const std::size_t column = time.empty() ? 0 : source.csv->column(time);
    source.stamps = input::stamps_in(*source.csv, column, source.rules, fallback_step_s);
    source.decimal = section.choice("decimal")[0];
    source.gaps_are_missing = section.choice("gaps") == "missing";
    return source;
}

input::RegularSeries series_of(const TimedCsv& source, const std::string& column) {
    const input::Csv& csv = *source.csv;
    input::RegularSeries series = input::lay(
        csv, source.stamps, input::numbers_in(csv, csv.column(column), source.decimal));
    if (!source.gaps_are_missing) input::refuse_gaps(csv, series);
    return series;
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

}  // namespace bemcal::job
