/// Reads [site] and [weather]: EPW files or CSV columns as hourly means, cut to periods
/// and warm-up, short gaps filled, irradiance completed. A stock reads each weather once.
/// Source: EPW Data Dictionary, by `epw`; irradiance by `complete_irradiance`.
/// A longer gap within a period is an error; before it the warm-up only gets shorter.
/// Clocks are checked by `check_weather_clock`.
#include "base/error.hpp"
#include "base/nan.hpp"
#include "checks/series.hpp"
#include "checks/weather_units.hpp"
#include "description/building_readers.hpp"
#include "description/repeated.hpp"
#include "description/timed_csv.hpp"
#include "description/weather_memory.hpp"
#include "input/epw.hpp"
#include "input/suggest.hpp"
#include "input/time_zone.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Weather;

using checks::SunColumn;
using checks::WeatherKind;

struct Column {
    const char* key;
    std::vector<double> Weather::* series;
    WeatherKind kind;
    std::optional<SunColumn> sun = {};  ///< which share of the sun it is
};
constexpr Column columns[] = {
    {"outdoor_temperature", &Weather::theta_e, WeatherKind::temperature},
    {"global_horizontal", &Weather::global_horizontal, WeatherKind::irradiance,
     SunColumn::global_horizontal},
    {"direct_normal", &Weather::direct_normal, WeatherKind::irradiance,
     SunColumn::direct_normal},
    {"diffuse_horizontal", &Weather::diffuse_horizontal, WeatherKind::irradiance,
     SunColumn::diffuse_horizontal},
    {"wind_speed", &Weather::wind_speed, WeatherKind::speed},
    {"relative_humidity", &Weather::relative_humidity, WeatherKind::humidity},
    {"cloud_cover", &Weather::cloud_cover, WeatherKind::cloud},
    {"infrared", &Weather::infrared, WeatherKind::irradiance}};

void read_site(const schema::Section& section, physics::Site& site) {
    section.number_if("latitude", site.latitude);
    section.number_if("longitude", site.longitude);
    section.number_if("utc_offset", site.utc_offset_h);
    section.number_if("elevation", site.elevation);
    site.albedo = section.number("albedo");
}

void check_zone(const schema::Section& section, const physics::Site& site) {
    if (input::is_possible_zone(site) || !section.has("utc_offset")) return;
    section.fail_value(
        "utc_offset",
        fmt::format(
            "no place at longitude {} has it, where the sun is {:.1f} h from UTC; "
            "longitudes west and zones west of Greenwich are negative",
            site.longitude, site.longitude / 15));
}

/// What one entry of [weather.columns] says.
struct ColumnSource {
    std::string column;
    double factor = 1, offset = 0;
    const checks::WeatherUnit* unit = nullptr;  ///< as said
    bool at_end = false;
};

const checks::WeatherUnit& unit_of(const schema::Section& section, WeatherKind kind) {
    const std::string name = section.text("unit");
    std::vector<std::string> names;
    for (const checks::WeatherUnit& unit : checks::weather_units()) {
        if (unit.kind != kind) continue;
        if (name == unit.name) return unit;
        names.emplace_back(unit.name);
    }
    section.fail_value("unit",
                       "is not a unit of this column" + input::suggestion(name, names));
}

ColumnSource column_source(const schema::Section& section, const Column& of,
                           const input::StampRules& rules) {
    const char* key = of.key;
    ColumnSource source;
    source.at_end = rules.at_end;
    if (section.node(key).kind != schema::Node::Kind::table) {
        source.column = section.text(key);
        return source;
    }
    const schema::Section more = section.table(key, "column");
    source.column = more.text("column");
    if (more.has("unit")) source.unit = &unit_of(more, of.kind);
    source.factor = more.number("factor");
    source.offset = more.number("offset");
    if (more.has("stamp")) source.at_end = more.choice("stamp") == "end";
    return source;
}

/// The first number outside the range that the table gives; -1 = none is.
int first_outside(const input::RegularSeries& series, const schema::Key& row) {
    const auto outside = [&](double v) { return v < row.least || v > row.most; };
    const auto found = std::ranges::find_if(series.values, outside);
    return found == series.values.end() ? -1
                                        : static_cast<int>(found - series.values.begin());
}

/// Such a number is a wrong unit or a missing-value code.
[[noreturn]] void refuse_range(const input::RegularSeries& series, int k,
                               const schema::Key& row, const TimedCsv& file,
                               const std::string& column) {
    throw UserError(
        ExitCode::data,
        fmt::format(
            "{}:{}: {:g}: expected {:g} to {:g} {} for {}; set factor and offset for "
            "another unit, leave the cell empty where it is missing",
            row_at(file, series.axis.begin_of(k)), column,
            series.values[static_cast<std::size_t>(k)], row.least, row.most, row.unit,
            row.key));
}

bool is_irradiance(const schema::Key& row) {
    return row.least < 0 && std::string_view(row.unit) == "W/m2";
}

/// A CSV weather on its way: its files, and the weather that they give.
class CsvWeather {
  public:
    CsvWeather(const schema::Section& section, input::InputFiles& files,
               const physics::Site& site, std::vector<study::DataDecision>& decisions)
        : section_(section),
          names_(section.table("columns", "weather.columns")),
          files_(files),
          decisions_(decisions) {
        weather_.site = site;
    }

    Weather read() {
        for (const std::string& file : section_.texts("files")) {
            sources_.push_back(open_csv(section_, "files", file, files_, weather_.site));
            state_lines(sources_.back(), decisions_);
            note_stamps(sources_.back(), "weather", decisions_);
            add_columns(sources_.back());
        }
        return std::move(weather_);
    }
    /// Whether stamps are the ends of their hours, in the last file.
    bool at_end() const { return sources_.back().rules.at_end; }

  private:
    void add_columns(const TimedCsv& source) {
        bool first = true;
        n_again_ = 0;
        for (const Column& column : columns) {
            if (!names_.has(column.key)) continue;
            const input::RegularSeries part = read_column(column, source);
            if (first) extend(part.axis, source.csv->file);
            first = false;
            append(column, part);
        }
        if (n_again_ > 0)
            decide("weather",
                   fmt::format("{}: {} h that the files before it have, too, alike",
                               source.csv->file, n_again_),
                   "taken once");
    }

    void decide(std::string series, std::string finding, std::string action) {
        decisions_.push_back({std::move(series), std::move(finding), std::move(action)});
    }

    input::RegularSeries read_column(const Column& column, const TimedCsv& file) {
        const ColumnSource source = column_source(names_, column, file.rules);
        const schema::Key& row = *schema::find_key("weather.columns", column.key);
        input::RegularSeries series = series_of(file, source.column);
        convert(series, source);
        const int shift =
            static_cast<int>(source.at_end) - static_cast<int>(file.rules.at_end);
        const std::chrono::seconds later(shift * series.axis.step_s);
        const auto doubt_unit = [&] {
            if (source.unit == nullptr)
                check_unit(series, column, file, source.column, later);
        };
        if (const int k = first_outside(series, row); k >= 0) {
            doubt_unit();
            refuse_range(series, k, row, file, source.column);
        }
        if (is_irradiance(row)) take_off_night(series, row, file, source.column, later);
        doubt_unit();
        series.axis.start -= later;
        return hourly_means(series, file.csv->file);
    }

    static void convert(input::RegularSeries& series, const ColumnSource& source) {
        const checks::WeatherUnit* unit = source.unit;
        for (double& value : series.values) {
            value = value * source.factor + source.offset;
            if (unit != nullptr)
                value = value * factor_of(*unit, series.axis.step_s) + unit->offset;
        }
    }

    /// Refuses what is in no place of the Earth what the column is to hold.
    void check_unit(const input::RegularSeries& series, const Column& of,
                    const TimedCsv& file, const std::string& name,
                    std::chrono::seconds later) const {
        input::RegularSeries stamped = series;
        stamped.axis.start -= later;
        std::optional<std::string> doubt;
        if (of.sun)
            doubt = checks::doubt_of_irradiance(stamped, weather_.site, *of.sun);
        else if (of.kind == WeatherKind::temperature)
            doubt = checks::doubt_of_temperature(stamped, weather_.site);
        else if (of.kind == WeatherKind::humidity)
            doubt = checks::doubt_of_humidity(stamped);
        else if (of.kind == WeatherKind::speed)
            doubt = checks::doubt_of_wind(stamped);
        if (doubt)
            throw UserError(
                ExitCode::data,
                fmt::format("{}: {} as {}: {}", file.csv->file, name, of.key, *doubt));
    }

    /// A pyranometer reads a little below 0 at night; by day that is a fault.
    void take_off_night(input::RegularSeries& series, const schema::Key& row,
                        const TimedCsv& file, const std::string& column,
                        std::chrono::seconds later) {
        constexpr double least_by_day = -20;  // [W/m2], as of an EPW file
        double least = 0;
        int n = 0;
        for (int k = 0; k < series.axis.n_steps; ++k) {
            double& value = series.values[static_cast<std::size_t>(k)];
            if (!(value < 0)) continue;
            const physics::Seconds begin = series.axis.begin_of(k);
            const std::chrono::seconds half(series.axis.step_s / 2);
            if (value < least_by_day && is_day(begin - later + half))
                throw UserError(
                    ExitCode::data,
                    fmt::format("{}:{}: {:g}: irradiance below {:g} {} while the sun is "
                                "up; leave the cell empty where it is missing, or check "
                                "the clock (stamp, utc_offset) and factor",
                                row_at(file, begin), column, value, least_by_day,
                                row.unit));
            least = std::min(least, value);
            value = 0;
            ++n;
        }
        if (n > 0)
            decide(fmt::format("weather {}", row.key),
                   fmt::format("{}: {} readings from {:g} to 0 W/m2", file.csv->file, n,
                               least),
                   "taken as 0");
    }

    bool is_day(physics::Seconds time) const {
        constexpr double horizon = 1.5707963;
        return physics::sun_position(weather_.site, time).zenith < horizon;
    }

    /// The hours of a file join those before it.
    void extend(const physics::TimeAxis& axis, const std::string& file) {
        physics::TimeAxis& whole = weather_.axis;
        if (whole.n_steps == 0) {
            whole = axis;
            return;
        }
        if (axis.start < whole.start)
            throw UserError(
                ExitCode::data,
                fmt::format("{}: begins at {}, before the end of the file before it "
                            "({}); give the files in order of time",
                            file, physics::format_time(axis.start),
                            physics::format_time(whole.end())));
        whole.n_steps =
            std::max(whole.n_steps,
                     static_cast<int>((axis.end() - whole.start).count() / whole.step_s));
    }

    void append(const Column& column, const input::RegularSeries& part) {
        std::vector<double>& values = weather_.*column.series;
        values.resize(static_cast<std::size_t>(weather_.axis.n_steps), nan);
        int n_again = 0;
        for (int k = 0; k < part.axis.n_steps; ++k) {
            const physics::Seconds begin = part.axis.begin_of(k);
            const int to = weather_.axis.step_of(begin);
            const double now = part.values[static_cast<std::size_t>(k)];
            if (to < 0 || to >= weather_.axis.n_steps || std::isnan(now)) continue;
            double& value = values[static_cast<std::size_t>(to)];
            if (!std::isnan(value) && value != now)
                refuse_two_readings(sources_, fmt::format("{} is ", column.key), begin,
                                    value, now);
            n_again += !std::isnan(value);
            value = now;
        }
        n_again_ = std::max(n_again_, n_again);
    }

    const schema::Section& section_;
    const schema::Section names_;
    input::InputFiles& files_;
    std::vector<study::DataDecision>& decisions_;
    Weather weather_;
    std::vector<TimedCsv> sources_;
    int n_again_ = 0;  ///< hours of this file that others have
};

Weather read_epw_weather(const schema::Section& section, input::InputFiles& files,
                         const schema::Section* site,
                         std::vector<study::DataDecision>& decisions) {
    input::EpwOptions options;
    if (section.has("temperature"))
        options.temperature =
            section.choice_as<input::TemperatureConvention>("temperature");
    section.number_if("year", options.year);
    options.longest_gap =
        std::max(options.longest_gap, static_cast<int>(section.integer("fill_gaps")));
    std::vector<input::EpwText> texts;
    section.attempt_each(section.texts("files"), [&](const std::string& file) {
        const std::filesystem::path path = section.path(file);
        texts.push_back({path.string(), files.data(path, section.where("files"))});
    });
    input::EpwFile epw = input::parse_epw_chain(texts, options);
    for (const std::string& sentence : epw.decisions)
        decisions.push_back({"weather", sentence, "as said"});
    if (site != nullptr) read_site(*site, epw.weather.site);
    return std::move(epw.weather);
}

/// The hours from the first warm-up to the end of the last period; the rest is not
/// needed.
void cut(Weather& weather, const study::Case& building) {
    physics::Seconds from = physics::Seconds::max(), to = physics::Seconds::min();
    for (const study::Period& period : building.periods) {
        from = std::min(from, period.from - std::chrono::hours(building.warm_up_hours));
        to = std::max(to, period.to);
    }
    const physics::TimeAxis axis = weather.axis.between(from, to);
    const std::ptrdiff_t first = (axis.start - weather.axis.start).count() / 3600;
    for (const Column& column : columns) {
        std::vector<double>& values = weather.*column.series;
        if (values.empty()) continue;
        values = std::vector<double>(values.begin() + first,
                                     values.begin() + first + axis.n_steps);
    }
    weather.axis = axis;
}

/// Short gaps become lines; longer ones are check_hours' matter.
void fill(Weather& weather, int longest, std::vector<study::DataDecision>& decisions) {
    for (const Column& column : columns) {
        const int n = input::fill_gaps(weather.*column.series, longest);
        if (n > 0)
            decisions.push_back(
                {fmt::format("weather {}", column.key),
                 fmt::format("{} h missing in gaps of up to {} h", n, longest),
                 "filled by straight lines"});
    }
}

/// Means of the hours from readings at their ends or their starts.
void average(std::vector<double>& theta_e, bool at_end) {
    if (!at_end) std::reverse(theta_e.begin(), theta_e.end());
    theta_e = physics::hour_means(theta_e);
    if (!at_end) std::reverse(theta_e.begin(), theta_e.end());
}

/// What helps where the weather does not cover a period.
const char* advice_on(const schema::Section& section, const study::Period& period,
                      const physics::TimeAxis& axis) {
    constexpr std::chrono::hours hour(1);
    if (period.from == axis.start - hour)
        return "where a stamp is the end of its hour, set stamp = \"end\"";
    if (period.to == axis.end() + hour)
        return "where a stamp is the start of its hour, set stamp = \"start\"";
    if (section.choice("format") == "epw" && !section.has("year"))
        return "give more files, choose another period, or say by year which one a "
               "typical year stands for";
    return "give more files, or choose another period";
}

void check_periods(const schema::Section& section, const study::Case& building) {
    const physics::TimeAxis& axis = building.weather.axis;
    for (const study::Period& period : building.periods)
        if (period.from < axis.start || period.to > axis.end())
            section.fail(
                "files",
                fmt::format(
                    "the period {} is {} to {}, but the weather covers {} to {}; {}",
                    period.name, physics::format_time(period.from),
                    physics::format_time(period.to), physics::format_time(axis.start),
                    physics::format_time(axis.end()), advice_on(section, period, axis)));
}

bool in_a_period(const study::Case& building, physics::Seconds time) {
    return std::any_of(building.periods.begin(), building.periods.end(),
                       [&](const auto& p) { return p.from <= time && time < p.to; });
}

/// An hour without temperature or irradiance is an error in a period; before one it only
/// keeps the warm-up from using the real hours.
void check_hours(const schema::Section& section, study::Case& building) {
    Weather& weather = building.weather;
    const auto time_of = [&](std::size_t k) {
        return weather.axis.begin_of(static_cast<int>(k));
    };
    const auto refuse = [&](std::size_t k, const char* what, const char* advice) {
        section.fail("files", fmt::format("{} is missing at {}; {}", what,
                                          physics::format_time(time_of(k)), advice));
    };
    for (std::size_t k = 0; k < weather.theta_e.size(); ++k)
        if (std::isnan(weather.theta_e[k]) && in_a_period(building, time_of(k)))
            refuse(k, "the outdoor temperature",
                   "set fill_gaps to bridge a few hours, or choose other periods");
    for (const int step : physics::unknown_irradiance(weather)) {
        const auto k = static_cast<std::size_t>(step);
        if (in_a_period(building, time_of(k)))
            refuse(k, "irradiance",
                   "give columns for global_horizontal, or direct_normal and "
                   "diffuse_horizontal, or cloud_cover, and fill_gaps for short gaps");
        weather.theta_e[k] = nan;
        weather.global_horizontal.resize(weather.theta_e.size(), nan);
        weather.global_horizontal[k] = 0;
    }
}

/// Where a CSV weather is.
physics::Site place_of(const schema::Section& weather, const schema::Section* site) {
    if (site == nullptr)
        weather.fail("format",
                     "a CSV file does not say where it is; add [site] with latitude, "
                     "longitude and utc_offset");
    constexpr const char* keys[] = {"latitude", "longitude", "utc_offset"};
    site->attempt_each(keys, [&](const char* key) { site->node(key); });
    physics::Site place;
    read_site(*site, place);
    check_zone(*site, place);
    return place;
}

/// Names and files, before what is in them is read.
void check_columns(const schema::Section& section, input::InputFiles& files) {
    const schema::Section names = section.table("columns", "weather.columns");
    names.node("outdoor_temperature");
    std::vector<std::string> there;
    names.attempt_each(columns, [&](const Column& column) {
        if (names.has(column.key))
            there.push_back(column_source(names, column, {}).column);
    });
    check_files(section, "files", there, files);
}

void read_any_weather(const schema::Section& section, const schema::Section* site,
                      input::InputFiles& files, study::Case& building) {
    if (section.choice("format") == "epw") {
        building.weather = read_epw_weather(section, files, site, building.decisions);
        return;
    }
    physics::Site place;
    section.attempt_all([&] { place = place_of(section, site); },
                        [&] { check_columns(section, files); });
    CsvWeather csv(section, files, place, building.decisions);
    building.weather = csv.read();
    if (section.choice("temperature") == "hour_mean")
        average(building.weather.theta_e, csv.at_end());
}

}  // namespace

namespace {

void drop_absent_parts(study::Case& building) {
    const auto days = physics::drop_absent_parts(building.weather);
    if (days.empty()) return;
    building.decisions.push_back(
        {"weather",
         fmt::format("global, direct or diffuse irradiance is 0 all day on {} day{} on "
                     "which another is not, the first {}",
                     days.size(), days.size() == 1 ? "" : "s",
                     physics::format_date(days.front())),
         "made of the other parts"});
}

void read_weather_now(const schema::Section& section,
                      const std::optional<schema::Section>& site,
                      input::InputFiles& files, study::Case& building) {
    building.sky = section.choice_as<physics::SkyModel>("sky");
    read_any_weather(section, site ? &*site : nullptr, files, building);
    if (building.periods.empty()) throw schema::Follows();
    check_periods(section, building);
    cut(building.weather, building);
    fill(building.weather, static_cast<int>(section.integer("fill_gaps")),
         building.decisions);
    if (section.choice("format") == "csv") drop_absent_parts(building);  // EPW's are done
    check_hours(section, building);
    at_key(section, "files", [&] { physics::complete_irradiance(building.weather); });
    checks::check_weather_sun(building);
    checks::check_weather_clock(building);
}

/// What a weather is made of: contents of files, keys, hours that are needed.
std::string key_of(const schema::Section& section,
                   const std::optional<schema::Section>& site, input::InputFiles& files,
                   const study::Case& building) {
    std::string key = text_of(section, "files") + (site ? text_of(*site) : "");
    key += fmt::format("{};", building.warm_up_hours);
    for (const study::Period& period : building.periods)
        key +=
            fmt::format("{}:{}:{};", period.name, period.from.time_since_epoch().count(),
                        period.to.time_since_epoch().count());
    for (const std::string& file : section.texts("files")) {
        const std::filesystem::path path = section.path(file);
        const std::string hash = files.weathers->content_hash(path);
        files.note(path, hash);
        key += hash + ";";
    }
    return key;
}

}  // namespace

void read_weather(const Sources& sources, input::InputFiles& files,
                  study::Case& building) {
    if (!sources.has("weather")) sources.own.node("weather");
    const schema::Section section = sources.with("weather").table("weather", "weather");
    std::optional<schema::Section> site;
    if (sources.has("site")) site = sources.with("site").table("site", "site");
    if (!files.weathers) return read_weather_now(section, site, files, building);
    files.weathers->get(key_of(section, site, files, building), building,
                        [&](study::Case& made) {
                            input::InputFiles own;
                            read_weather_now(section, site, own, made);
                        });
}

}  // namespace bemcal::description
