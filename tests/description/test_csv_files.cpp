/// CSV files as people have them, read through a job: the same readings in another form
/// give the same meter, series or weather.
#include "job/small_office.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char* file_key = "file = \"measured.csv\"\n";

std::string one_meter_text() {
    std::string text = small_office_text();
    const std::size_t second = text.find("[[meter]]", text.find("[[meter]]") + 1);
    return text.erase(second, text.find("[[parameter]]") - second);
}

/// The sample with one meter, its readings changed, and keys added to it.
class Form {
  public:
    explicit Form(const std::string& readings, const std::string& keys = "",
                  const std::string& weather = small_weather(),
                  const std::string& weather_keys = "") {
        std::string text = replaced(one_meter_text(), file_key, file_key + keys);
        text = replaced(text, "files = [\"weather.csv\"]\n",
                        "files = [\"weather.csv\"]\n" + weather_keys);
        path_ = write_small_office(folder_, text);
        folder_.write("measured.csv", readings);
        folder_.write("weather.csv", weather);
    }
    study::Case read() const { return read_job(path_).buildings[0]; }
    std::string message() const { return message_of(path_); }

  private:
    Folder folder_;
    std::filesystem::path path_;
};

bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, [](double x, double y) {
        return x == y || (std::isnan(x) && std::isnan(y));
    });
}

study::Case plain() {
    return Form(small_readings()).read();
}

bool has_decision(const study::Case& building, const std::string& finding) {
    return std::ranges::any_of(building.decisions, [&](const auto& decision) {
        return decision.finding.find(finding) != std::string::npos;
    });
}

void expect_same_readings(const std::string& readings, const std::string& keys = "") {
    const study::Case building = Form(readings, keys).read();
    EXPECT_TRUE(same(building.meters[0].values, plain().meters[0].values))
        << readings.substr(0, 200);
}

/// Every line changed, the names too.
std::string each_line(const std::string& text,
                      const std::function<std::string(const std::string&)>& change) {
    std::istringstream lines(text);
    std::string line, made;
    while (std::getline(lines, line)) made += change(line) + "\n";
    return made;
}

std::string semicolons(std::string text) {
    std::ranges::replace(text, ',', ';');
    return text;
}

TEST(CsvFiles, WithLinesAroundTheTableAreReadAndStated) {
    const std::string readings = small_readings();
    expect_same_readings("sep=;\n" + semicolons(readings));
    const study::Case building =
        Form("Owner,A,B\nStreet,1,2\n\n" + readings + "Total,1,2\n").read();
    EXPECT_TRUE(same(building.meters[0].values, plain().meters[0].values));
    EXPECT_TRUE(
        has_decision(building, "the names stand in line 4; 2 lines before it left out"));
    EXPECT_TRUE(has_decision(building,
                             "1 line behind the last row left out: line 1421, "
                             "\"Total,1,2\""));
}

TEST(CsvFiles, AreReadFromTheLineOfNamesThatTheJobSays) {
    const std::string readings = "time,elec_kWh,T_air_C\n1999-01-01 00:00,5,5\n" +
                                 small_readings() + "2021-02-31,later,more\n";
    expect_same_readings(readings, "header_line = 3\nskip = [\"2021-02-31\"]\n");
    expect_same_readings(readings, "header_line = 3\nskip = 1420\n");
}

TEST(CsvFiles, WithLinesBetweenTheRowsSayHowToSkipThem) {
    const std::string readings =
        replaced(small_readings(), "T_air_C\n", "T_air_C\nTotal 2021,1,2\n");
    EXPECT_NE(
        Form(readings).message().find(
            "measured.csv:2:time: \"Total 2021\" is not a time; expected one like "
            "2021-03-05 14:00, or its form as time_format; name lines that are no rows in skip, and the line of "
            "names in header_line"),
        std::string::npos);
    expect_same_readings(readings, "skip = \"Total\"\n");
}

TEST(CsvFiles, OfManyFormsGiveTheSameReadings) {
    const std::string readings = small_readings();
    expect_same_readings(
        each_line(readings, [](const std::string& line) { return line + ","; }));
    expect_same_readings(
        each_line(readings, [](const std::string& line) { return line + "\r"; }));
    std::string alone = readings;
    std::ranges::replace(alone, '\n', '\r');
    expect_same_readings(alone);
    expect_same_readings(
        each_line(readings, [](const std::string& line) { return line + "\n,,\n"; }));
    expect_same_readings("#" + readings);
    expect_same_readings(each_line(readings, [](const std::string& line) {
        return line + (line.starts_with("time") ? ",x,x" : ",2,3");
    }));
}

TEST(CsvFiles, OfWindowsLettersHaveColumnsNamedInUtf8) {
    const std::string text =
        replaced(one_meter_text(), "column = \"elec_kWh\"", "column = \"Z\xC3\xA4hler\"");
    const Folder folder;
    const auto path = write_small_office(folder, text);
    folder.write("measured.csv",
                 replaced(small_readings(), "elec_kWh", std::string("Z\xE4hler")));
    EXPECT_TRUE(
        same(read_job(path).buildings[0].meters[0].values, plain().meters[0].values));
}

TEST(CsvFiles, HaveThousandsByTheirMark) {
    const auto thousands = [](const std::string& mark) {
        return each_line(small_readings(), [&](const std::string& line) {
            if (line.starts_with("time")) return semicolons(line);
            const std::size_t comma = line.find(',');
            const std::size_t next = line.find(',', comma + 1);
            const double kwh = std::stod(line.substr(comma + 1)) * 100;
            std::string number = fmt::format("{:.0f}", kwh);
            if (number.size() > 3) number.insert(number.size() - 3, mark);
            return line.substr(0, comma) + ";" + number + ";" + line.substr(next + 1);
        });
    };
    const study::Case whole = Form(thousands(""), "factor = 0.01\n").read();
    for (const char* mark : {",", ".", "'", " "}) {
        const Form form(thousands(mark),
                        fmt::format("factor = 0.01\nthousands = \"{}\"\n", mark));
        EXPECT_TRUE(same(form.read().meters[0].values, whole.meters[0].values)) << mark;
        EXPECT_NE(Form(thousands(mark)).message().find("set thousands = \""),
                  std::string::npos)
            << mark;
    }
    EXPECT_NE(Form(thousands(","), "decimal = \",\"\n").message().find("may be 1"),
              std::string::npos);
    EXPECT_NE(Form(small_readings(), "thousands = \",\"\ndecimal = \",\"\n")
                  .message()
                  .find("meter.thousands = \",\": is the decimal mark, too; "
                        "set decimal to another"),
              std::string::npos);
}

TEST(CsvFiles, HaveWordsAndCodesForMissing) {
    const auto with = [](const std::string& reading) {
        return each_line(small_readings(), [&](const std::string& line) {
            const std::string stamp = "2021-01-03 05:00:00,";
            if (!line.starts_with(stamp)) return line;
            return stamp + reading + line.substr(line.find(',', stamp.size()));
        });
    };
    for (const char* word : {"none", "missing", "#N/A", "-"}) {
        const study::Case building = Form(with(word)).read();
        EXPECT_TRUE(std::isnan(building.meters[0].values[52])) << word;
    }
    const Form said(with("out of order"), "missing = [\"out of order\", -999]\n");
    EXPECT_TRUE(std::isnan(said.read().meters[0].values[52]));
    EXPECT_FALSE(std::isnan(said.read().meters[0].values[53]));
    EXPECT_TRUE(
        std::isnan(Form(with("-999.0"), "missing = -999\n").read().meters[0].values[52]));
}

/// A column of global irradiance beside the sample's weather.
std::string weather_with(const std::function<double(int)>& global) {
    int k = -1;
    return each_line(small_weather(), [&](const std::string& line) {
        return ++k == 0 ? line + ",GHI" : fmt::format("{},{:.1f}", line, global(k - 1));
    });
}

std::string with_global(const std::string& text) {
    return replaced(text, "direct_normal = \"DNI\"\ndiffuse_horizontal = \"DHI\"\n",
                    "global_horizontal = \"GHI\"\n");
}

study::Case read_global(const std::function<double(int)>& global, std::string* message) {
    const Folder folder;
    const auto path = write_small_office(folder, with_global(small_office_text()));
    folder.write("weather.csv", weather_with(global));
    if (message != nullptr) *message = message_of(path);
    return message != nullptr ? study::Case{} : read_job(path).buildings[0];
}

bool is_noon(int k) {
    return k % 24 >= 10 && k % 24 < 14;
}

TEST(CsvWeather, APyranometersOffsetAtNightIsNoSun) {
    const study::Case dark =
        read_global([](int k) { return is_noon(k) ? 400 : 0; }, nullptr);
    const study::Case offset = read_global(
        [](int k) { return is_noon(k)   ? 400
                           : k % 24 < 5 ? -45
                                        : -2; }, nullptr);
    EXPECT_EQ(dark.weather.global_horizontal, offset.weather.global_horizontal);
    EXPECT_TRUE(has_decision(offset, "weather.csv: 1180 readings from -45 to 0 W/m2"));
    EXPECT_FALSE(has_decision(dark, "to 0 W/m2"));
}

TEST(CsvWeather, DirectAndDiffuseBelow0AtNightAreNoSun) {
    const std::string dark = small_weather();
    std::string offset = dark;
    for (std::size_t at = 0; (at = offset.find(",0.0,0.0,", at)) != std::string::npos;)
        offset.replace(at, 9, ",-3.0,-1.5,");
    const study::Case building = Form(small_readings(), "", offset).read();
    EXPECT_EQ(building.weather.direct_normal, plain().weather.direct_normal);
    EXPECT_EQ(building.weather.diffuse_horizontal, plain().weather.diffuse_horizontal);
    EXPECT_TRUE(has_decision(building, "readings from -3 to 0 W/m2"));
    EXPECT_TRUE(has_decision(building, "readings from -1.5 to 0 W/m2"));
}

TEST(CsvWeather, IrradianceFarBelow0ByDayIsAFault) {
    std::string message;
    read_global([](int k) { return k == 36 ? -45.0 : 100.0; }, &message);
    EXPECT_NE(message.find("weather.csv:38:GHI: -45: irradiance below -20 W/m2 while the "
                           "sun is up"),
              std::string::npos)
        << message;
}

TEST(CsvWeather, HoursOfTwoFilesAreTakenOnceWhereTheyAreAlike) {
    const std::string all = small_weather();
    const std::size_t first_row = all.find('\n') + 1;
    const auto from = [&](const std::string& stamp) {
        return all.find("\n" + stamp) + 1;
    };
    const Folder folder;
    const auto path = write_small_office(
        folder,
        replaced(small_office_text(), "[\"weather.csv\"]", "[\"a.csv\", \"b.csv\"]"));
    folder.write("a.csv", all.substr(0, from("2021-01-21")));
    folder.write("b.csv", all.substr(0, first_row) + all.substr(from("2021-01-20 22")));
    const study::Case building = read_job(path).buildings[0];
    EXPECT_EQ(building.weather.theta_e, plain().weather.theta_e);
    EXPECT_TRUE(has_decision(building, "b.csv: 2 h that the files before it have, too"));
    folder.write("b.csv",
                 all.substr(0, first_row) +
                     "2021-01-20 22:00:00,1,2,3,4\n2021-01-20 23:00:00,1,2,3,4\n" +
                     all.substr(from("2021-01-21")));
    const std::string message = message_of(path);
    EXPECT_NE(message.find("b.csv:2: outdoor_temperature is 1 here, but "),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("a.csv:480, for the same time (2021-01-20 22:00:00)"),
              std::string::npos)
        << message;
}

TEST(CsvWeather, AnImpossibleTimeZoneIsRefused) {
    const Folder folder;
    const std::string message = message_of(write_small_office(
        folder, replaced(small_office_text(), "utc_offset = 8", "utc_offset = -8")));
    EXPECT_NE(message.find("office.toml:10: site.utc_offset = -8: no place at longitude "
                           "113.32 has it"),
              std::string::npos)
        << message;
}

}  // namespace
}  // namespace bemcal::job
