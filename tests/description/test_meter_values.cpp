/// A meter with codes, spikes, negative use or a register's counts, through the job: what
/// is masked, what is said, which key overrules it; and units of a weather table.
#include "job/small_office.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr int n_hours = 24 * 59;

/// Use of the sample's electricity in the hour k.
double use(int k) {
    return std::round(100 * (12 + 6 * std::sin(k / 3.8))) / 100;
}

constexpr const char* scaled = "\n[[meter.scale]]\nfrom = \"2021-01-10\"\nfactor = 2\n";

std::string text_with(const std::string& lines) {
    if (lines == scaled)
        return replaced(small_office_text(), "mask = [\"2021-01-20/2021-01-21\"]\n",
                        lines);
    return replaced(small_office_text(), "unit = \"kWh\"", "unit = \"kWh\"\n" + lines);
}

/// The sample with other readings at the hours' ends.
struct Sample {
    Sample(const std::function<double(int)>& reading, const std::string& lines = "") {
        path = write_small_office(folder, text_with(lines));
        std::string text = "time,elec_kWh,T_air_C\n";
        for (int k = 0; k < n_hours; ++k)
            text += fmt::format("{},{:.10g},{:.1f}\n",
                                physics::format_time(physics::parse_time("2021-01-01") +
                                                     std::chrono::hours(k + 1)),
                                reading(k), 20 + 2 * std::cos(k / 3.8));
        folder.write("measured.csv", text);
    }
    study::Case read() const { return read_job(path).buildings[0]; }

    Folder folder;
    std::filesystem::path path;
};

std::string action_on(const study::Case& building, const std::string& finding) {
    for (const auto& decision : building.decisions)
        if (decision.finding.find(finding) != std::string::npos) return decision.action;
    return "";
}

const std::vector<double>& values_of(const study::Case& building) {
    return building.meters[0].values;
}

double with_code(int k) {
    return k % 290 == 5 ? -9999 : use(k);
}

TEST(MeterValues, CodesAreMaskedAndSaid) {
    const study::Case building = Sample(with_code).read();
    EXPECT_TRUE(std::isnan(values_of(building)[295]));
    EXPECT_EQ(values_of(building)[296], use(296));
    EXPECT_EQ(action_on(building,
                        "5 readings of -9999, a code for missing, the first "
                        "from 2021-01-01 05:00:00"),
              "masked; codes = \"keep\" would keep them");
}

TEST(MeterValues, CodesAreKnownBeforeAScaleHidesThem) {
    const study::Case building = Sample(with_code, scaled).read();
    EXPECT_TRUE(std::isnan(values_of(building)[295]));
    EXPECT_EQ(values_of(building)[296], 2 * use(296));
}

TEST(MeterValues, ASpikeIsMaskedOrKeptByTheKey) {
    const auto spike = [](int k) { return k == 700 ? 1e6 : use(k); };
    const study::Case building = Sample(spike).read();
    EXPECT_TRUE(std::isnan(values_of(building)[700]));
    EXPECT_EQ(action_on(building,
                        "1 reading far from all others (1e+06; the highest "
                        "other one: 18), the first from 2021-01-30 04:00:00"),
              "masked; spikes = \"keep\" would keep them");
    EXPECT_EQ(values_of(Sample(spike, "spikes = \"keep\"\n").read())[700], 1e6);
}

TEST(MeterValues, ANegativeHourIsMaskedOrKeptByTheKey) {
    const auto negative = [](int k) { return k == 700 ? -5 : use(k); };
    const study::Case building = Sample(negative).read();
    EXPECT_TRUE(std::isnan(values_of(building)[700]));
    EXPECT_EQ(action_on(building, "1 reading below 0, down to -5"),
              "masked; negative = \"keep\" would keep them");
    EXPECT_EQ(values_of(Sample(negative, "negative = \"keep\"\n").read())[700], -5);
}

TEST(MeterValues, OffsetsBelowZeroAreZero) {
    const study::Case building =
        Sample([](int k) { return k % 24 < 5 ? -0.01 : use(k); }).read();
    EXPECT_EQ(values_of(building)[24 * 29], 0);
    EXPECT_EQ(action_on(building, "285 readings below 0, down to -0.01"),
              "taken as 0; negative = \"keep\" would keep them");
}

/// The sample with the room's temperature in tenths or in another unit.
struct Room {
    Room(double factor, double offset, const std::string& unit) {
        path = write_small_office(folder,
                                  replaced(small_office_text(), "unit = \"degC\"", unit));
        std::string text = "time,elec_kWh,T_air_C\n";
        for (int k = 0; k < n_hours; ++k)
            text += fmt::format("{},{:.2f},{:.10g}\n",
                                physics::format_time(physics::parse_time("2021-01-01") +
                                                     std::chrono::hours(k + 1)),
                                use(k), (20 + 2 * std::cos(k / 3.8)) * factor + offset);
        folder.write("measured.csv", text);
    }
    double reading(std::size_t k) const {
        return read_job(path).buildings[0].meters[1].values.at(k);
    }
    Folder folder;
    std::filesystem::path path;
};

TEST(MeterValues, OfARoomInAnotherUnitAreRefusedWithItAndReadByIt) {
    const std::string as_read = "unit = \"degC\"", tenths = "factor = 0.1\n" + as_read;
    const double right = Room(1, 0, as_read).reading(7);
    EXPECT_NEAR(right, 20 + 2 * std::cos(7 / 3.8), 1e-8);
    ExitCode code = ExitCode::ok;
    const std::string message = message_of(Room(10, 0, as_read).path, &code);
    EXPECT_EQ(code, ExitCode::data);
    EXPECT_NE(message.find("measured.csv:2:T_air_C: half of its readings lie above 200"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("Write factor = 0.1"), std::string::npos) << message;
    EXPECT_NEAR(Room(10, 0, tenths).reading(7), right, 1e-8);
    EXPECT_NE(message_of(Room(1.8, 32, as_read).path).find("Write unit = \"degF\""),
              std::string::npos);
    EXPECT_NEAR(Room(1.8, 32, "unit = \"degF\"").reading(7), right, 1e-8);
}

double feeding_in(int k) {
    return use(k) - 12;
}

TEST(MeterValues, AMeterThatFeedsInIsAskedAbout) {
    ExitCode code = ExitCode::ok;
    const std::string message = message_of(Sample(feeding_in).path, &code);
    EXPECT_EQ(code, ExitCode::data);
    EXPECT_NE(message.find("measured.csv:14:elec_kWh: -0.1"), std::string::npos)
        << message;
    EXPECT_NE(message.find("of 1368 readings are below 0; a meter that only draws has "
                           "none. Set negative = \"missing\" if they are faults, "
                           "\"keep\" if it feeds in at times"),
              std::string::npos)
        << message;
    EXPECT_DOUBLE_EQ(values_of(Sample(feeding_in, "negative = \"keep\"\n").read())[14],
                     use(14) - 12);
    EXPECT_TRUE(
        std::isnan(values_of(Sample(feeding_in, "negative = \"missing\"\n").read())[14]));
}

/// What the register shows at the end of the hour k.
double counted(int k) {
    double sum = 54'321;
    for (int hour = 0; hour <= k; ++hour) sum += use(hour);
    return sum;
}

TEST(MeterValues, ARegisterIsAskedAboutAndItsDifferencesAreTheUse) {
    ExitCode code = ExitCode::ok;
    const std::string message = message_of(Sample(counted).path, &code);
    EXPECT_EQ(code, ExitCode::data);
    EXPECT_NE(message.find("measured.csv:2:elec_kWh: its readings rise 1415 times and "
                           "fall 0 times: a register that counts on, not the use of each "
                           "step. Set register = \"difference\""),
              std::string::npos)
        << message;
    const study::Case building = Sample(counted, "register = \"difference\"\n").read();
    const study::Meter& meter = building.meters[0];
    // The first row closes the first hour, so the use begins with the second.
    EXPECT_EQ(meter.axis.start, physics::parse_time("2021-01-01 01:00:00"));
    ASSERT_EQ(meter.values.size(), 1415U);
    EXPECT_NEAR(meter.values[0], use(1), 1e-6);
    EXPECT_NEAR(meter.values[699], use(700), 1e-6);
    EXPECT_EQ(action_on(building, "a register that rises 1415 times"),
              "its differences are taken");
}

TEST(MeterValues, ACodeInARegisterCostsTheTwoHoursBesideIt) {
    const study::Case building =
        Sample([](int k) { return k == 700 ? -999 : counted(k); },
               "register = \"difference\"\n")
            .read();
    EXPECT_NEAR(values_of(building)[698], use(699), 1e-6);
    EXPECT_TRUE(std::isnan(values_of(building)[699]));
    EXPECT_TRUE(std::isnan(values_of(building)[700]));
    EXPECT_NEAR(values_of(building)[701], use(702), 1e-6);
}

/// The sample's weather with one number after the other changed.
std::string weather_in(double factor, double offset, bool of_air) {
    std::istringstream lines(small_weather());
    std::string line, text;
    std::getline(lines, text);
    text += "\n";
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string time, cell;
        std::getline(cells, time, ',');
        std::vector<double> numbers;
        while (std::getline(cells, cell, ',')) numbers.push_back(std::stod(cell));
        for (std::size_t k = of_air ? 0 : 1; k < (of_air ? 1U : 3U); ++k)
            numbers[k] = numbers[k] * factor + offset;
        text += fmt::format("{},{:.17g},{:.17g},{:.17g},{}\n", time, numbers[0],
                            numbers[1], numbers[2], numbers[3]);
    }
    return text;
}

struct Weathered {
    Weathered(const std::string& weather, const std::string& from,
              const std::string& to) {
        path = write_small_office(folder, replaced(small_office_text(), from, to));
        folder.write("weather.csv", weather);
    }
    Folder folder;
    std::filesystem::path path;
};

TEST(WeatherColumns, InKilojoulesAreRefusedWithTheirUnitAndReadByIt) {
    const std::string plain = "direct_normal = \"DNI\"\ndiffuse_horizontal = \"DHI\"\n";
    const std::string weather = weather_in(3.6, 0, false);
    ExitCode code = ExitCode::ok;
    const std::string message = message_of(Weathered(weather, plain, plain).path, &code);
    EXPECT_EQ(code, ExitCode::data);
    EXPECT_NE(message.find("weather.csv: DNI as direct_normal: at its clearest middays"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("unit = \"kJ/m2\""), std::string::npos) << message;
    const Weathered said(weather, plain,
                         "direct_normal = {column = \"DNI\", unit = \"kJ/m2\"}\n"
                         "diffuse_horizontal = {column = \"DHI\", unit = \"kJ/m2\"}\n");
    const Folder folder;
    const auto right = read_job(write_small_office(folder)).buildings[0].weather;
    const auto read = read_job(said.path).buildings[0].weather;
    for (std::size_t k = 0; k < right.direct_normal.size(); ++k)
        ASSERT_NEAR(read.direct_normal[k], right.direct_normal[k], 1e-9);
}

TEST(WeatherColumns, WithCodesForMissingAreRefusedAtTheFirst) {
    std::string weather = small_weather();
    for (int day = 1; day <= 31; ++day) {
        const std::size_t row = weather.find(fmt::format("2021-01-{:02} 05:00:00,", day));
        const std::size_t cell = row + 20;
        weather.replace(cell, weather.find(',', cell) - cell, "99.9");
    }
    const std::string plain = "outdoor_temperature = \"T_out_C\"";
    const std::string message = message_of(Weathered(weather, plain, plain).path);
    EXPECT_NE(message.find("weather.csv:7:T_out_C: 99.9: expected -90 to 60 degC"),
              std::string::npos)
        << message;
    const Weathered said(weather, "stamp = \"start\"\n",
                         "stamp = \"start\"\nmissing = 99.9\nfill_gaps = 1\n");
    EXPECT_NEAR(read_job(said.path).buildings[0].weather.theta_e[6],
                read_job(Weathered(small_weather(), plain, plain).path)
                    .buildings[0]
                    .weather.theta_e[6],
                0.01);
}

TEST(WeatherColumns, InFahrenheitAreRefusedWithTheirUnitAndReadByIt) {
    const std::string weather = weather_in(1.8, 32, true);
    const std::string plain = "outdoor_temperature = \"T_out_C\"";
    const std::string message = message_of(Weathered(weather, plain, plain).path);
    EXPECT_NE(message.find("Write unit = \"degF\""), std::string::npos) << message;
    const Weathered said(weather, plain,
                         "outdoor_temperature = {column = \"T_out_C\", unit = \"degF\"}");
    const Folder folder;
    EXPECT_NEAR(read_job(said.path).buildings[0].weather.theta_e[30],
                read_job(write_small_office(folder)).buildings[0].weather.theta_e[30],
                1e-9);
    EXPECT_NE(message_of(Weathered(weather, plain,
                                   "outdoor_temperature = {column = \"T_out_C\", unit = "
                                   "\"kJ/m2\"}")
                             .path)
                  .find("is not a unit of this column"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
