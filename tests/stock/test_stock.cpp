/// What a stock's lines become, and what a night knows of them.
#include "base/error.hpp"
#include "calibration/screening.hpp"
#include "description/stock_readings.hpp"
#include "input/input_files.hpp"
#include "job/small_office.hpp"
#include "job/stock.hpp"
#include "stock/drift.hpp"
#include "stock/record.hpp"
#include "stock/shared.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

stock::StockRecord some_record() {
    stock::StockRecord record;
    record.name = "house";
    record.status = "calibrated";
    record.cause = "data: a file with a long name.csv";
    record.line_hash = "0123456789abcdef";
    record.age = 3;
    record.files = {{"meter.csv", "aa"}, {"gone.csv", ""}};
    record.fits = {{"gas", "kWh", "training", 1000, 100, 0.5, 0.2, -0.01},
                   {"gas", "kWh", "recent", 100, 10, 0.6, 0.3, 0.02}};
    record.values = {{"leaks", "1/h", 0, 1, 0.5, 0.4, 0.6, 0}};
    record.told = "ended: wind, on 2022-03-04";
    record.adopted = "structure = [\"surfaces\"]\n";
    record.known_to = 7;
    record.effects = {{"wind", "1/h", "ended", "[[effect]]\n", 0.1, 0.05, 0.2, 19055}};
    record.changes = {{"wind", 19055, -1}};
    record.findings = {{"gas", "zeros", "masked"}};
    record.daily = {1, 2, 3};
    return record;
}

void expect_same(const stock::StockRecord& one, const stock::StockRecord& other) {
    EXPECT_EQ(stock::pack(one), stock::pack(other));
}

TEST(StockRecord, ComesBackFromItsNumbers) {
    auto packed = stock::pack(some_record());
    const std::size_t n = packed.size();
    packed.push_back(7);
    std::size_t used = 0;
    expect_same(stock::unpack_record(packed, used), some_record());
    EXPECT_EQ(used, n);
    EXPECT_ANY_THROW(stock::unpack_record(std::span(packed).first(n - 4), used));
}

TEST(StockRecord, ComesBackFromDatasetsAmongOthers) {
    stock::StockRecord bare;
    bare.name = "bare";
    bare.status = "failed";
    const std::vector<stock::StockRecord> records{bare, some_record(), bare};
    const auto again = stock::records_in(
        stock::datasets_of(records.size(), [&](std::size_t k) { return records[k]; }));
    ASSERT_EQ(again.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) expect_same(again[k], records[k]);
    EXPECT_TRUE(stock::records_in({}).empty());
}

TEST(StockDrift, IsAMoveOverAShareOfTheRangeOutOfTheIntervalBefore) {
    const stock::StockRecord before = some_record();
    stock::StockRecord now = before;
    now.values[0].value = 0.65;
    stock::find_drift({}, before, now);
    EXPECT_EQ(now.drift, "");
    EXPECT_NEAR(now.values[0].moved, 0.15, 1e-12);
    now.values[0].value = 0.75;
    stock::find_drift({}, before, now);
    EXPECT_EQ(now.drift, "leaks from 0.5 to 0.75 1/h");
    stock::StockRecord wide = before;
    wide.values[0].high = 0.8;
    now.drift = "";
    stock::find_drift({}, wide, now);
    EXPECT_EQ(now.drift, "");
}

TEST(StockDrift, OfTheErrorIsTheRecentRmseOverThatOfTraining) {
    stock::StockRecord now = some_record();  // both means are 10: 3 kWh against 2 kWh
    stock::find_error_drift({}, nullptr, now);
    EXPECT_EQ(now.drift, "");
    now.fits[1].cv_rmse = 0.31;
    stock::find_error_drift({}, nullptr, now);
    EXPECT_EQ(now.drift, "error of gas: RMSE 3.1 kWh in the last days, 2 in training");
    now.drift = "";
    now.fits[1].measured *= 3;  // a winter's days: a larger error of a larger mean
    now.fits[1].cv_rmse = 0.25;
    stock::find_error_drift({}, nullptr, now);
    EXPECT_EQ(now.drift, "");
}

std::vector<float> some_days(double factor, int first) {
    std::vector<float> days(180);
    for (int k = 0; k < 180; ++k) {
        const double day = k + first;
        days[static_cast<std::size_t>(k)] = static_cast<float>(
            factor * (100 + 60 * std::cos(day / 58) + 25 * std::sin(day * day)));
    }
    return days;
}

/// Two that show one meter, and a third under the same weather; worked on this night.
std::vector<stock::StockRecord> three_buildings() {
    std::vector<stock::StockRecord> records(3, some_record());
    for (stock::StockRecord& record : records) {
        record.findings.clear();
        record.age = 0;
    }
    records[0].daily = some_days(1, 0);
    records[1].daily = some_days(0.2, 40);
    records[1].name = "annex";
    records[1].daily_start = 40;
    records[2].name = "neighbour";
    records[2].daily = some_days(1, 0);
    for (std::size_t k = 0; k < 180; ++k)
        records[2].daily[k] *= 1 + 0.2F * std::sin(3.0F * static_cast<float>(k));
    return records;
}

TEST(StockShared, FindsOneMeterBehindTwoBuildingsOfDifferentPeriods) {
    auto records = three_buildings();
    for (int night = 0; night < 2; ++night) stock::find_shared_meters(records);
    ASSERT_EQ(records[0].findings.size(), 1U);
    EXPECT_EQ(records[0].findings[0].finding,
              "shared with annex: 5 times its daily sums, over 140 days");
    EXPECT_EQ(records[1].findings.size(), 1U);
    EXPECT_TRUE(records[2].findings.empty());
}

TEST(StockShared, KeepsWhatWasFoundOfTwoThatNothingWasDoneWith) {
    auto records = three_buildings();
    stock::find_shared_meters(records);
    records[0].age = records[1].age = 1;
    records[0].daily.clear();  // it is not looked at
    stock::find_shared_meters(records);
    ASSERT_EQ(records[0].findings.size(), 1U);
    ASSERT_EQ(records[1].findings.size(), 1U);
    EXPECT_EQ(records[1].findings[0].finding,
              "shared with house: 0.2 times its daily sums, over 140 days");
}

TEST(StockShared, LooksAnewWhereOneOfTwoWasWorkedOnOrIsGone) {
    auto records = three_buildings();
    stock::find_shared_meters(records);
    records[0].age = 1;
    for (float& day : records[1].daily) day *= 2;
    stock::find_shared_meters(records);
    ASSERT_EQ(records[0].findings.size(), 1U);
    EXPECT_EQ(records[0].findings[0].finding,
              "shared with annex: 2.5 times its daily sums, over 140 days");
    records[1].daily = records[2].daily;  // a meter of its own
    stock::find_shared_meters(records);
    EXPECT_TRUE(records[0].findings.empty());

    auto others = three_buildings();
    stock::find_shared_meters(others);
    others.erase(others.begin() + 1);
    for (stock::StockRecord& record : others) record.age = 1;
    stock::find_shared_meters(others);
    EXPECT_TRUE(others[0].findings.empty());
}

/// As many that show one meter, behind others of their own.
std::vector<stock::StockRecord> many_buildings(std::size_t n_alike,
                                               std::size_t n_others) {
    std::vector<stock::StockRecord> records(n_alike + n_others, some_record());
    for (std::size_t k = 0; k < records.size(); ++k) {
        records[k].findings.clear();
        records[k].age = 0;
        records[k].name = "house " + std::to_string(k);
        records[k].daily = some_days(1 + 0.5 * static_cast<double>(k), 0);
        for (std::size_t day = 0; day < 180 && k >= n_alike; ++day)
            records[k].daily[day] *=
                1 + 0.4F * std::sin(static_cast<float>((k + 3) * (day + 5) * day % 977));
    }
    return records;
}

TEST(StockShared, ALargeGroupIsToldOnceToEachMember) {
    auto records = many_buildings(12, 3);
    for (int night = 0; night < 2; ++night) {
        stock::find_shared_meters(records);
        for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(records[k].findings.size(), 1U);
        EXPECT_EQ(records[0].findings[0].finding,
                  "shared with house 1 and 10 more (house 2, house 3, house 4, house 5, "
                  "...): 0.6667 times its daily sums, over 180 days");
        EXPECT_EQ(records[11].findings[0].finding,
                  "shared with house 0 and 10 more (house 1, house 2, house 3, house 4, "
                  "...): 6.5 times its daily sums, over 180 days");
        for (std::size_t k = 12; k < 15; ++k) EXPECT_TRUE(records[k].findings.empty());
        for (stock::StockRecord& record : records) record.age = 1;
    }
    records.resize(10);  // a small one now
    stock::find_shared_meters(records);
    EXPECT_EQ(records[3].findings.size(), 9U);
    EXPECT_EQ(records[3].findings[8].finding,
              "shared with house 9: 0.4545 times its daily sums, over 180 days");
}

TEST(StockShared, FindingsGrowWithTheBuildingsNotWithTheirPairs) {
    auto records = many_buildings(600, 50);
    stock::find_shared_meters(records);
    std::size_t n_findings = 0;
    for (const stock::StockRecord& record : records) n_findings += record.findings.size();
    EXPECT_EQ(n_findings, 600U);
}

TEST(StockReadings, AreASharesPulsesWhereTheyAreMultiplesOfNoRoundNumber) {
    std::vector<double> shares, litres, plain;
    for (int k = 0; k < 4000; ++k) {
        const int pulses = 1 + (k * 7919) % 37;
        shares.push_back(std::round(10 * 6.748 * pulses) / 10);
        litres.push_back(5.0 * pulses + (k % 400 == 0 ? 0.1 : 0));
        plain.push_back(std::round(1000 * std::abs(std::sin(k))) / 10);
    }
    const description::ReadingsLook found = description::look_for_quantum(shares);
    EXPECT_NEAR(found.quantum, 6.748, 0.01);
    EXPECT_GT(found.quantum_share, 0.9);
    EXPECT_EQ(description::look_for_quantum(litres).quantum, 0);
    EXPECT_EQ(description::look_for_quantum(plain).quantum, 0);
    EXPECT_EQ(description::look_for_quantum({}).quantum, 0);
}

/// A stock of the small office, with places.
class StockJob {
  public:
    explicit StockJob(const std::string& table) {
        std::string text = small_office_text();
        text = text.substr(0, text.find("[[study]]"));
        text = replaced(text, "name = \"small_office\"\nseed = 7\n", "");
        text = replaced(text, "floor_area = 1500", "floor_area = @area@");
        write_small_office(folder_, small_office_text());
        folder_.write("building.toml", text);
        folder_.write("stock.csv", table);
        folder_.write("job.toml",
                      "seed = 3\n[stock]\ntable = \"stock.csv\"\ntemplate = "
                      "\"building.toml\"\n[[study]]\nkind = \"screening\"\n");
        job_ = read_job(folder_ / "job.toml");
    }

    Job building(std::size_t k) const {
        input::InputFiles files;
        return read_stock_building(job_, job_.stock->lines.at(k), files);
    }
    std::string complaint(std::size_t k) const {
        try {
            building(k);
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    }
    const Job& job() const { return job_; }

  private:
    Folder folder_;
    Job job_;
};

std::uint64_t seed_of(const Job& job) {
    return job.studies.at(0).as<calibration::ScreeningOptions>().seed;
}

TEST(StockJob, FillsTheTemplateByLineAndGivesEachItsOwnNumbers) {
    const StockJob stock("name,area\none,1200\ntwo,1300\n");
    const Job one = stock.building(0), two = stock.building(1);
    EXPECT_EQ(one.buildings.at(0).name, "one");
    EXPECT_EQ(one.buildings[0].building.floor_area(), 1200);
    EXPECT_EQ(two.buildings.at(0).building.floor_area(), 1300);
    EXPECT_NE(seed_of(one), seed_of(two));
    EXPECT_EQ(stock.job().stock->weathers->n_read(), 1);
    EXPECT_EQ(one.buildings[0].planes, two.buildings[0].planes);
}

TEST(StockJob, SaysWhatIsWrongWithALine) {
    const StockJob stock("name,area\n,1200\none,big\ntwo,-5\ntwo,1\na/b,1\n");
    EXPECT_NE(stock.complaint(0).find("stock.csv:2: has no name"), std::string::npos);
    EXPECT_NE(stock.complaint(1), "");
    EXPECT_NE(stock.complaint(2).find("floor_area = -5"), std::string::npos)
        << stock.complaint(2);
    EXPECT_NE(stock.complaint(3).find("another line has the name \"two\""),
              std::string::npos);
    EXPECT_NE(stock.complaint(4), "");
    EXPECT_NE(stock.complaint(2).find("stock.csv:4: "), std::string::npos);
    const StockJob other("name,size\none,1200\n");
    EXPECT_NE(other.complaint(0).find("@area@: the table has no such column"),
              std::string::npos);
}

/// The building of a stock of one line that its columns describe.
study::Case described(const Folder& folder, const std::string& columns,
                      const std::string& cells) {
    folder.write("weather.csv", small_weather(8760));
    folder.write("stock.csv",
                 "name,floor_area," + columns + "\none,1200," + cells + "\n");
    folder.write("job.toml",
                 "[stock]\ntable = \"stock.csv\"\n[[study]]\nkind = \"screening\"\n");
    const Job job = read_job(folder / "job.toml");
    input::InputFiles files;
    return read_stock_building(job, job.stock->lines.at(0), files).buildings.at(0);
}

const std::string weather_columns =
    "weather,outdoor_temperature,direct_normal,diffuse_horizontal,latitude,longitude,"
    "utc_offset";
const std::string weather_cells = "weather.csv,T_out_C,DNI,DHI,23.1,113.3,8";

std::string day_of(physics::Seconds time) {
    return physics::format_time(time).substr(0, 10);
}

std::size_t n_readings(const study::Case& building, std::size_t period) {
    const auto readings = study::readings_of(building, building.periods.at(period))[0];
    return static_cast<std::size_t>(std::ranges::count_if(
        readings.values, [](double value) { return !std::isnan(value); }));
}

TEST(StockLines, ByMonthKeepTheirLastMonth) {
    const Folder folder;
    std::string gas = "month,one\n";
    for (int month = 1; month <= 12; ++month)
        gas += fmt::format("2021-{:02}-01,{}\n", month, 1000 * month);
    folder.write("gas.csv", gas);
    const study::Case building = described(folder, weather_columns + ",gas,interval",
                                           weather_cells + ",gas.csv,monthly");
    EXPECT_EQ(day_of(building.periods[0].from), "2021-01-01");
    EXPECT_EQ(day_of(building.periods[0].to), "2021-12-01");
    EXPECT_EQ(day_of(building.periods[1].to), "2022-01-01");
    EXPECT_EQ(n_readings(building, 0), 11U);
    EXPECT_EQ(n_readings(building, 1), 1U);
}

TEST(StockLines, OfBillsEndTheirPeriodsWithABill) {
    const Folder folder;
    folder.write("gas.csv",
                 "from,to,one,how\n2021-01-04,2021-02-03,9,A\n2021-02-03,2021-03-05,8,E\n"
                 "2021-03-05,2021-04-06,7,A\n2021-04-06,2021-05-04,6,A\n");
    const study::Case building =
        described(folder, weather_columns + ",gas,interval,gas_from,gas_to,estimated",
                  weather_cells + ",gas.csv,monthly,from,to,how");
    EXPECT_EQ(day_of(building.periods[0].from), "2021-01-04");
    EXPECT_EQ(day_of(building.periods[0].to), "2021-04-06");
    EXPECT_EQ(n_readings(building, 0), 2U);  // the estimated one is part of the next
    EXPECT_EQ(n_readings(building, 1), 1U);
}

TEST(StockLines, MayHaveATypicalYearsWeather) {
    const std::filesystem::path weather =
        BEMCAL_ROOT "/../shared/reference/weather/ITA_Venezia-Tessera.161050_IGDG.epw";
    if (!std::filesystem::exists(weather)) GTEST_SKIP() << weather << " is not here";
    const Folder folder;
    std::string gas = "month,one\n";
    for (int month = 1; month <= 12; ++month)
        gas += fmt::format("2019-{:02}-01,{}\n", month, 1000);
    folder.write("gas.csv", gas);
    const study::Case building = described(folder, "weather,year,gas,interval",
                                           weather.string() + ",2019,gas.csv,monthly");
    EXPECT_EQ(day_of(building.weather.axis.start), "2019-01-01");
    EXPECT_EQ(n_readings(building, 0), 11U);
}

std::string refusal(const std::string& text) {
    const Folder folder;
    folder.write("stock.csv", "name,area\none,1\n");
    try {
        read_job(folder.write("job.toml", text));
    } catch (const UserError& error) {
        const std::string message = error.what();
        return message.substr(message.find("job.toml"));
    }
    return "";
}

TEST(StockJob, RefusesWhatAStockCannotDo) {
    const std::string stock = "[stock]\ntable = \"stock.csv\"\n";
    const std::string screening = "[[study]]\nkind = \"screening\"\n";
    EXPECT_EQ(refusal(stock + screening), "");
    EXPECT_EQ(refusal(stock),
              "job.toml:1: study: has 0 sections; a stock has one: screening, posterior "
              "or loop");
    EXPECT_EQ(refusal(stock + "[[study]]\nkind = \"sensitivity\"\n"),
              "job.toml:4: study.kind = \"sensitivity\": a stock has one study: "
              "screening, posterior or loop");
    EXPECT_EQ(refusal("[stock]\nhours = 1\n" + screening),
              "job.toml:1: stock.table: expected either table or folder");
    EXPECT_EQ(
        refusal(stock + screening + "[[zone]]\nname = \"z\"\n"),
        "job.toml:5: zone: has no place beside [stock]; a building's sections stand "
        "in its template or in the files that its table names");
}

}  // namespace
}  // namespace bemcal::job
