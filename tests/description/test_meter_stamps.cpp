/// [[meter]], [[series]] and [weather]: stamps in the forms that utilities, loggers and
/// portals write, each read as the same readings in the plainest form.
#include "input/csv_numbers.hpp"
#include "input/input_files.hpp"
#include "input/series.hpp"
#include "job/small_office.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::Seconds;

const std::string meter_keys =
    "file = \"measured.csv\"\ncolumn = \"elec_kWh\"\nunit = \"kWh\"\nstamp = \"end\"\n";
constexpr int n_hours = 24 * 59;

double reading(int hour) {
    return 12 + 6 * std::sin(hour / 3.8);
}

Seconds begin_of(int hour) {
    return physics::parse_time("2021-01-01") + std::chrono::hours(hour);
}

/// A file with a row an hour; `stamp` writes the hour's begin.
template <class F>
std::string hourly(const std::string& head, F stamp) {
    std::string text = head + "\n";
    for (int k = 0; k < n_hours; ++k)
        text += fmt::format("{},{:.2f}\n", stamp(begin_of(k)), reading(k));
    return text;
}

/// The sample's electricity read from another file by these keys.
study::Case read_with(const std::string& file_text, const std::string& keys,
                      const std::string& column = "x") {
    const Folder folder;
    folder.write("other.csv", file_text);
    std::string text = replaced(
        small_office_text(), meter_keys,
        "file = \"other.csv\"\ncolumn = \"" + column + "\"\nunit = \"kWh\"\n" + keys);
    return read_job(write_small_office(folder, text)).buildings[0];
}

/// Whether they are the sample's readings, at their hours; masked days apart.
void expect_same(const study::Case& building) {
    const study::Meter& meter = building.meters[0];
    ASSERT_EQ(meter.axis.start, begin_of(0));
    ASSERT_EQ(meter.axis.step_s, 3600);
    ASSERT_EQ(meter.axis.n_steps, n_hours);
    for (int k = 0; k < n_hours; ++k) {
        const double value = meter.values[static_cast<std::size_t>(k)];
        if (std::isnan(value)) continue;
        EXPECT_NEAR(value, reading(k), 0.006);
    }
    EXPECT_FALSE(std::isnan(meter.values[5]));
}

int count(const study::Case& building, const std::string& words) {
    return static_cast<int>(
        std::ranges::count_if(building.decisions, [&](const auto& decision) {
            return (decision.series + ": " + decision.finding + ": " + decision.action)
                       .find(words) != std::string::npos;
        }));
}

std::string text_of_time(Seconds time) {
    return physics::format_time(time);
}

TEST(MeterStamps, DateAndClockMayStandApart) {
    const auto stamp = [](Seconds time) {
        return text_of_time(time).substr(0, 10) + "," + text_of_time(time).substr(11, 5);
    };
    const std::string file = hourly("date,from,x", stamp);
    const study::Case found = read_with(file, "");
    expect_same(found);
    EXPECT_EQ(count(found,
                    "stamps of electricity: its time stands in the columns date, "
                    "from"),
              1);
    const study::Case said = read_with(file, "time = [\"date\", \"from\"]\n");
    expect_same(said);
    EXPECT_EQ(count(said, "stamps of"), 0);
}

TEST(MeterStamps, PartsAreReadByTheNamesOfTheirColumns) {
    const std::string file = hourly("Hour,Year,Month,Day,x", [](Seconds time) {
        const auto step = physics::calendar_step(time);
        return fmt::format("{},{},{},{}", step.hour, step.year, step.month, step.day);
    });
    expect_same(read_with(file, "time = [\"Year\", \"Month\", \"Day\", \"Hour\"]\n"));
}

TEST(MeterStamps, HoursFrom1To24AreEnds) {
    const std::string file = hourly("date,hour,x", [](Seconds time) {
        return fmt::format("{},{}", physics::format_date(time),
                           physics::calendar_step(time).hour + 1);
    });
    const study::Case building = read_with(file, "");
    expect_same(building);
    EXPECT_EQ(count(building, "its midnights are written as 24:00"), 1);
}

TEST(MeterStamps, EndsThatNobodySaidAreToldAndOverruled) {
    const std::string file = hourly("time,x", [](Seconds time) {
        return text_of_time(time + std::chrono::hours(1));
    });
    const study::Case building = read_with(file, "");
    expect_same(building);
    EXPECT_EQ(count(building,
                    "stamps of electricity: its first stamp is 01:00, its last 00:00: "
                    "they close whole days: read as ends of their intervals, which begin "
                    "1 h before; stamp = \"start\" overrules it"),
              1);
    EXPECT_EQ(read_with(file, "stamp = \"start\"\n").meters[0].axis.start, begin_of(1));
}

TEST(MeterStamps, SecondsBesideTheHourAreMovedToIt) {
    const std::string file = hourly("time,x", [](Seconds time) {
        return text_of_time(time + std::chrono::seconds(5));
    });
    const study::Case building = read_with(file, "");
    expect_same(building);
    EXPECT_EQ(
        count(building, "1416 of 1416 stamps lie up to 5 s beside their step of 1 h"), 1);
}

TEST(MeterStamps, HoursAndThenQuartersAreBothRead) {
    std::string file = "time,x\n";
    for (int k = 0; k < n_hours; ++k) {
        const int n = k < 700 ? 1 : 4;
        for (int q = 0; q < n; ++q)
            file += fmt::format("{},{:.4f}\n",
                                text_of_time(begin_of(k) + std::chrono::minutes(15 * q)),
                                reading(k) / n);
    }
    const study::Case building = read_with(file, "");
    expect_same(building);
    EXPECT_EQ(
        count(building, "its rows are 1 h apart up to 2021-01-30 04:00:00, then 15 min"),
        1);
}

TEST(MeterStamps, ADayALineIsReadByItsColumns) {
    std::string file = "date";
    for (int h = 1; h <= 24; ++h) file += fmt::format(",h{:02}", h);
    for (int k = 0; k < n_hours; ++k)
        file += (k % 24 == 0 ? "\n" + physics::format_date(begin_of(k)) : "") +
                fmt::format(",{:.2f}", reading(k));
    const study::Case building = read_with(file + "\n", "", "h01");
    expect_same(building);
    EXPECT_EQ(
        count(building, "it has a day a line, its 24 readings in the columns h01 to h24"),
        1);
}

TEST(MeterStamps, OffsetsOfAFormAreApplied) {
    // 00:00 in Guangzhou is 16:00 UTC of the day before.
    const auto utc = [](Seconds time) { return time - std::chrono::hours(8); };
    expect_same(read_with(hourly("time,x",
                                 [&](Seconds time) {
                                     return fmt::format("{} +0000",
                                                        text_of_time(utc(time)));
                                 }),
                          "time_format = \"%Y-%m-%d %H:%M:%S %z\"\n"));
    expect_same(read_with(hourly("time,x",
                                 [&](Seconds time) {
                                     return fmt::format(
                                         "{}", utc(time).time_since_epoch().count());
                                 }),
                          "time_format = \"%s\"\n"));
}

TEST(MeterStamps, OffsetsBehindAStampAreReadWithoutAForm) {
    for (const char* offset : {"+0000", " +00:00", " GMT", " UTC", "Z"})
        expect_same(read_with(
            hourly("time,x",
                   [&](Seconds time) {
                       return text_of_time(time - std::chrono::hours(8)) + offset;
                   }),
            "stamp = \"start\"\n"));
    expect_same(read_with(
        hourly("time,x", [](Seconds time) { return text_of_time(time) + "+0800"; }),
        "stamp = \"start\"\n"));
}

TEST(MeterStamps, EndsInUtcCloseTheDaysOfTheSite) {
    const study::Case building =
        read_with(hourly("time,x",
                         [](Seconds time) {
                             return text_of_time(time + std::chrono::hours(1 - 8)) + "Z";
                         }),
                  "");
    expect_same(building);
    EXPECT_EQ(count(building,
                    "its first stamp is 01:00, its last 00:00 by the site's clock: they "
                    "close whole days: read as ends of their intervals"),
              1);
}

TEST(MeterStamps, AFormatThatReadsNoYearIsRefusedAtItsKey) {
    const Folder folder;
    ExitCode exit_code = ExitCode::usage;
    const std::string message =
        message_of(write_small_office(
                       folder, replaced(small_office_text(), meter_keys,
                                        meter_keys + "time_format = \"%d/%m %H:%M\"\n")),
                   &exit_code);
    EXPECT_NE(
        message.find("meter.time_format: reads no year; expected %Y, %y or %s in it"),
        std::string::npos)
        << message;
    EXPECT_EQ(exit_code, ExitCode::config);
}

TEST(MeterStamps, FilesOfTwoStepsAreJoinedAtTheLonger) {
    const Folder folder;
    std::string hours = "time,x\n", quarters = hours;
    for (int k = 0; k < n_hours; ++k)
        for (int q = 0; q < (k < 700 ? 1 : 4); ++q)
            (k < 700 ? hours : quarters) += fmt::format(
                "{},{:.4f}\n", text_of_time(begin_of(k) + std::chrono::minutes(15 * q)),
                reading(k) / (k < 700 ? 1 : 4));
    folder.write("a.csv", hours);
    folder.write("b.csv", quarters);
    const std::string text =
        replaced(small_office_text(), meter_keys,
                 "file = [\"a.csv\", \"b.csv\"]\ncolumn = \"x\"\nunit = \"kWh\"\n");
    expect_same(read_job(write_small_office(folder, text)).buildings[0]);
}

TEST(MeterStamps, WeatherInPartsAtHalfPastIsThatOfItsHours) {
    const Folder folder;
    const Job plain = read_job(write_small_office(folder));
    std::istringstream lines(small_weather());
    std::string line, file = "Year,Month,Day,Hour,Minute,T_out_C,DNI,DHI,wind_kmh\n";
    std::getline(lines, line);
    while (std::getline(lines, line))
        file += fmt::format("{},{},{},{},30{}\n", line.substr(0, 4), line.substr(5, 2),
                            line.substr(8, 2), line.substr(11, 2), line.substr(19));
    const auto job = write_small_office(
        folder,
        replaced(small_office_text(), "time = \"time\"\nstamp = \"start\"\n", ""));
    folder.write("weather.csv", file);
    const study::Case building = read_job(job).buildings[0];
    EXPECT_EQ(building.weather.axis.start, plain.buildings[0].weather.axis.start);
    EXPECT_EQ(building.weather.theta_e, plain.buildings[0].weather.theta_e);
    EXPECT_EQ(count(building,
                    "stamps of weather: its stamps lie 30 min after the steps of "
                    "1 h: each read as of the step that it stands in"),
              1);
}

/// Each row of the weather's sample with another stamp.
std::string weather_stamped(const std::function<std::string(Seconds)>& stamp) {
    std::istringstream lines(small_weather());
    std::string line, file;
    std::getline(lines, file);
    file += "\n";
    while (std::getline(lines, line))
        file += stamp(physics::parse_time(line.substr(0, 19))) + line.substr(19) + "\n";
    return file;
}

study::Case read_weather(const std::string& file, const std::string& stamp_key) {
    const Folder folder;
    const auto job = write_small_office(
        folder, replaced(small_office_text(), "stamp = \"start\"\n", stamp_key));
    folder.write("weather.csv", file);
    return read_job(job).buildings[0];
}

TEST(MeterStamps, OfWeatherAreTakenAsTheirEndsWhereTheyCloseWholeDays) {
    const physics::Weather plain =
        read_weather(weather_stamped(text_of_time), "stamp = \"start\"\n").weather;
    const std::string ends = weather_stamped(
        [](Seconds time) { return text_of_time(time + std::chrono::hours(1)); });
    const study::Case unsaid = read_weather(ends, "");
    EXPECT_EQ(unsaid.weather.axis.start, plain.axis.start);
    EXPECT_EQ(unsaid.weather.theta_e, plain.theta_e);
    EXPECT_EQ(
        count(unsaid, "stamps of weather: its first stamp is 01:00, its last 00:00"), 1);
    const study::Case utc =
        read_weather(weather_stamped([](Seconds time) {
                         return text_of_time(time - std::chrono::hours(8)) + " GMT";
                     }),
                     "");
    EXPECT_EQ(utc.weather.axis.start, plain.axis.start);
    EXPECT_EQ(utc.weather.theta_e, plain.theta_e);
}

/// "+00:00" behind every stamp, from an hour of a home in Britain.
TEST(MeterStamps, AHomeOfBritainIsReadByTheOffsetOfItsStamps) {
    const std::filesystem::path file = BEMCAL_ROOT "/../shared/data/uk_home/gas.csv.gz";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
    input::InputFiles files;
    const input::Csv& csv = files.csv(file);
    input::StampRules rules;
    rules.site_offset_h = rules.file_offset_h = 5.5;  // if it stood in India
    rules.is_said = false;
    const input::Stamps stamps = input::stamps_in(csv, 0, rules);
    EXPECT_EQ(physics::format_time(stamps.begins[0]), "2020-04-01 06:30:00");
    EXPECT_FALSE(stamps.at_end);
    const input::RegularSeries hours = input::on_whole_steps(
        input::lay(csv, stamps, input::numbers_in(csv, csv.column("gas_kWh"))));
    EXPECT_EQ(physics::format_time(hours.axis.start), "2020-04-01 07:00:00");
}

}  // namespace
}  // namespace bemcal::job
