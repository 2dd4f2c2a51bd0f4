/// Tables of stocks as spreadsheets leave them, and buildings that their columns
/// describe.
#include "description/stock_readings.hpp"
#include "job/small_office.hpp"
#include "job/stock.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::parse_time;

constexpr const char* head =
    "name,floor_area,latitude,longitude,utc_offset,weather,outdoor_temperature,"
    "direct_normal,diffuse_horizontal,gas,gas_column";
constexpr const char* place = "1500,23.13,113.32,8,w.csv,T_out_C,DNI,DHI";

/// Gas of the hours, days or months of 2021, stamped at their begin.
std::string readings(int n, const std::function<std::string(int)>& row) {
    std::string text = "time;kwh\n";
    for (int k = 0; k < n; ++k) text += row(k) + "\n";
    return text;
}

std::string hourly(int k) {
    const auto time = parse_time("2021-01-01") + std::chrono::hours(k);
    return fmt::format("{};{}", physics::format_time(time), 50 + k % 24);
}

class StockTable {
  public:
    StockTable(const std::string& columns, const std::string& cells,
               const std::string& gas = readings(8760, hourly))
        : StockTable(
              fmt::format("{}{}\none,{},gas.csv,kwh{}\n", head, columns, place, cells),
              gas, 0) {}
    StockTable(const std::string& table, const std::string& gas, int) {
        folder_.write("w.csv", small_weather(8760));
        folder_.write("gas.csv", gas);
        folder_.write("stock.csv", table);
        folder_.write("job.toml",
                      "[stock]\ntable = \"stock.csv\"\n[[study]]\nkind = "
                      "\"screening\"\n");
    }
    Job job() const { return read_job(folder_ / "job.toml"); }
    study::Case building() const {
        const Job stock = job();
        input::InputFiles files;
        return read_stock_building(stock, stock.stock->lines.at(0), files).buildings[0];
    }
    std::string complaint() const {
        try {
            building();
        } catch (const UserError& error) {
            return error.what();
        }
        return "no complaint";
    }
    const Folder& folder() const { return folder_; }

  private:
    Folder folder_;
};

std::string ends_of(const study::Case& building, std::size_t period) {
    const study::Period& is = building.periods.at(period);
    return physics::format_date(is.from) + " " + physics::format_date(is.to);
}

TEST(StockTable, ReadingsInItsPlaceAreRefused) {
    const Folder folder;
    folder.write("gas.csv", "time,gas_kwh\n2021-01-01 00:00,5\n2021-01-01 01:00,6\n");
    folder.write("job.toml",
                 "[stock]\ntable = \"gas.csv\"\n[[study]]\nkind = \"screening\"\n");
    try {
        read_job(folder / "job.toml");
        FAIL() << "readings were taken for a table of buildings";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        EXPECT_NE(std::string(error.what())
                      .find("gas.csv: has no column name or id, as a table of buildings "
                            "has, but time, gas_kwh; readings and weather go into a job"),
                  std::string::npos)
            << error.what();
    }
}

TEST(StockTables, HaveNoBuildingsInBlankRows) {
    const StockTable stock(
        fmt::format("{}\n,,,,\none,{},gas.csv,kwh\n\n,,,,,,,,,,\n\"\",,,\n", head, place),
        "", 0);
    ASSERT_EQ(stock.job().stock->lines.size(), 1U);
    EXPECT_EQ(stock.job().stock->lines[0].line, 3);
}

TEST(StockTables, MayHaveAColumnTwiceThatNobodyAsksFor) {
    EXPECT_EQ(StockTable(",note,note", ",a,b").complaint(), "no complaint");
    EXPECT_NE(StockTable(",class,class", ",heavy,light")
                  .complaint()
                  .find("line 2: column \"class\" stands there twice; rename one"),
              std::string::npos);
}

TEST(StockTables, OfHoursEndWithTheLastWholeDay) {
    const study::Case building = StockTable("", "").building();
    EXPECT_EQ(ends_of(building, 0), "2021-01-01 2021-12-04");
    EXPECT_EQ(ends_of(building, 1), "2021-12-04 2022-01-01");
}

TEST(StockTables, MaySayHowAMetersFileIsToBeRead) {
    const auto german = [](int k) {
        const physics::CalendarStep step =
            physics::calendar_step(parse_time("2021-01-01") + std::chrono::hours(k));
        return fmt::format("{:02}.{:02}.{} {:02}:00;1.{:03},5", step.day, step.month,
                           step.year, step.hour, 50 + k % 24);
    };
    const study::Case building = StockTable(",gas_time_format,gas_thousands",
                                            ",%d.%m.%Y %H:%M,.", readings(8760, german))
                                     .building();
    EXPECT_EQ(ends_of(building, 0), "2021-01-01 2021-12-04");
    EXPECT_EQ(building.meters[0].values.at(3), 1053.5);
}

TEST(StockTables, MaySayInWhichCountryABuildingStands) {
    const auto is_off = [](const study::Case& building, const char* date) {
        const physics::CalendarStep day = physics::calendar_step(parse_time(date));
        return std::ranges::any_of(
            building.profiles.at(0).schedule.holidays,
            [&](const physics::DateRange& days) { return days.contains(day); });
    };
    const study::Case building =
        StockTable(",holidays_country,holidays_state", ",DE,BY").building();
    EXPECT_TRUE(is_off(building, "2021-06-03"));
    EXPECT_FALSE(is_off(building, "2021-06-04"));
    EXPECT_FALSE(is_off(StockTable("", "").building(), "2021-06-03"));
    EXPECT_NE(StockTable(",holidays_country", ",GER")
                  .complaint()
                  .find("holidays.country = \"GER\": expected one of AT, AU"),
              std::string::npos);
}

TEST(StockTables, MayLeaveHoursToBeLearned) {
    const study::Case learned = StockTable(",hours,use", ",learn,school").building();
    ASSERT_EQ(learned.unknown_hours.size(), 2U);  // of plant and use
    EXPECT_EQ(learned.unknown_hours[0].usual, physics::usual_hours("school"));
    EXPECT_EQ(StockTable(",hours", ",learn").building().unknown_hours[0].use, "office");
    EXPECT_TRUE(StockTable("", "").building().unknown_hours.empty());
    const auto says = [](const std::string& columns, const std::string& cells,
                         const std::string& what) {
        const std::string said = StockTable(columns, cells).complaint();
        EXPECT_NE(said.find(what), std::string::npos) << said;
    };
    says(",hours", ",guess",
         "stock.csv:2: hours: \"guess\" is no way to say hours; expected learn");
    says(
        ",hours,use", ",learn,hospital",
        "stock.csv:2: use: \"hospital\" is no use that has usual hours; expected office");
    says(",use", ",school", "stock.csv:2: use: has no effect without the column hours");
}

TEST(StockTables, MayHaveReadingsByTheMonth) {
    const auto month = [](int k) {
        return fmt::format("2021-{:02}-01;{}", k + 1, 100 * k);
    };
    const study::Case building =
        StockTable(",interval", ",monthly", readings(12, month)).building();
    EXPECT_EQ(building.meters[0].interval, physics::Interval::monthly);
    EXPECT_EQ(ends_of(building, 0), "2021-01-01 2021-12-01");
    EXPECT_EQ(building.meters[0].values.at(31 * 24), 100);
}

TEST(StockTables, OfHoursByTheMonthKeepTheLastMonth) {
    const study::Case building = StockTable(",interval", ",monthly").building();
    EXPECT_EQ(ends_of(building, 0), "2021-01-01 2021-12-01");
    EXPECT_EQ(ends_of(building, 1), "2021-12-01 2022-01-01");
}

/// The most that steady loads may be, which follows from what electricity shows [W/m2].
double most_steady(const StockTable& stock) {
    const study::Case building = stock.building();
    return std::ranges::find(building.parameters, "steady_gains",
                             &physics::Parameter::name)
        ->most;
}

/// A table whose meter `gas.csv` is of electricity, with such keys.
StockTable with_electricity(const std::string& keys, const std::string& cells,
                            const std::string& rows) {
    std::string columns = head;
    columns.replace(columns.find("gas,gas_column"), 14, "electricity,electricity_column");
    return {fmt::format("{}{}\none,{},gas.csv,kwh{}\n", columns, keys, place, cells),
            rows, 0};
}

TEST(StockTables, HaveTheSameLoadsWhateverTheUnitOfElectricity) {
    const auto times = [](double factor) {
        return readings(8760, [factor](int k) {
            const auto time = parse_time("2021-01-01") + std::chrono::hours(k);
            return fmt::format("{};{:.9g}", physics::format_time(time),
                               factor * (5 + k % 24));
        });
    };
    const double usual = most_steady(with_electricity("", "", times(1)));
    EXPECT_NEAR(usual, 1.4 * 1000 * 16.5 / 1500, 0.02);
    const auto is_usual = [&](const StockTable& stock) {
        EXPECT_NEAR(most_steady(stock), usual, 0.005 * usual);
    };
    is_usual(with_electricity(",electricity_unit", ",MWh", times(1e-3)));
    is_usual(with_electricity(",electricity_unit", ",Wh", times(1e3)));
    is_usual(with_electricity(",electricity_unit", ",kW", times(1)));
    is_usual(with_electricity(",electricity_factor", ",10", times(0.1)));
    double shown = 1000;
    is_usual(with_electricity(
        ",electricity_register", ",difference", readings(8760, [&shown](int k) {
            const auto time = parse_time("2021-01-01") + std::chrono::hours(k);
            const double before = std::exchange(shown, shown + 5 + k % 24);
            return fmt::format("{};{}", physics::format_time(time), before);
        })));
}

TEST(StockTables, RefuseNumbersThatNoBuildingHas) {
    const auto says = [](const std::string& columns, const std::string& cells,
                         const std::string& what) {
        const std::string said = StockTable(columns, cells).complaint();
        EXPECT_NE(said.find(what), std::string::npos) << said;
    };
    says(",glass_share", ",30",
         "stock.csv:2: glass_share: 30: expected 0 to 0.95 of the walls");
    says(",glass_share", ",0.951", "glass_share: 0.951: expected");
    EXPECT_EQ(StockTable(",glass_share", ",0.95").complaint(), "no complaint");
    says(",u_window", ",0.29", "u_window: 0.29: expected 0.3 to 10 W/(m2 K)");
    EXPECT_EQ(StockTable(",u_window", ",0.3").complaint(), "no complaint");
    std::string table = fmt::format("{}\none,{},gas.csv,kwh\n", head, place);
    table.replace(table.find("1500"), 4, "4.9");
    EXPECT_NE(StockTable(table, readings(8760, hourly), 0)
                  .complaint()
                  .find("floor_area: 4.9: expected 5 to 1e+07 m2"),
              std::string::npos);
    says(",floors", ",0", "floors: 0: expected 1 to 200");
    says(",floors", ",two",
         "floors: \"two\" is not a number; expected one such as 1200.5");
    // What is wrong with the text that was made of the line is told apart from its cells.
    says(",class", ",huge", "stock.csv:2, in its description:");
}

TEST(StockTables, RefuseAColumnThatIsNearlyOne) {
    const auto said = [](const std::string& column) {
        return StockTable("," + column, ",1").complaint();
    };
    EXPECT_NE(said("gas_units")
                  .find("stock.csv:1: column \"gas_units\" is not read; did you "
                        "mean \"gas_unit\"?"),
              std::string::npos)
        << said("gas_units");
    EXPECT_NE(said("U_Wall").find("did you mean \"u_wall\""), std::string::npos);
    EXPECT_NE(said("eficency").find("did you mean \"efficiency\""), std::string::npos);
    for (const char* own : {"year_built", "heat_source", "city", "gas_supplier", "area",
                            "no", "uid", "ID", "floor_area_ft2", "wather"})
        EXPECT_EQ(said(own), "no complaint") << own;
}

TEST(StockTables, HaveOneBrokenBuildingWhereOneRowIsShort) {
    const StockTable stock(
        fmt::format("{0}\none,{1},gas.csv,kwh\ntwo,700\nthree,{1},gas.csv,kwh,1,2\n",
                    head, place),
        readings(8760, hourly), 0);
    const Job job = stock.job();
    const auto& lines = job.stock->lines;
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].complaint, "");
    EXPECT_EQ(lines[1].complaint, "has 2 cells; expected 11 as in the first line");
    EXPECT_EQ(lines[1].name, "two");
    EXPECT_EQ(lines[2].complaint, "has 13 cells; expected 11 as in the first line");
    // A comma at the end of the names alone says nothing.
    const Job comma =
        StockTable(fmt::format("{},\none,{},gas.csv,kwh\n", head, place), "", 0).job();
    EXPECT_EQ(comma.stock->lines.at(0).complaint, "");
}

TEST(StockTables, TellOfAMeterThatEndsBeforeAnother) {
    const auto decisions_with = [](int n_days) {
        const StockTable stock(
            fmt::format(
                "{},electricity,electricity_column\none,{},gas.csv,kwh,e.csv,kwh\n", head,
                place),
            readings(8760, hourly), 0);
        stock.folder().write("e.csv", readings(24 * n_days, hourly));
        const auto decisions = stock.building().decisions;
        return std::ranges::count_if(decisions, [](const auto& decision) {
            return decision.finding.starts_with("its readings end on ");
        });
    };
    EXPECT_EQ(decisions_with(365 - 14), 0);
    EXPECT_EQ(decisions_with(365 - 15), 1);
}

/// An EPW file whose rows come from 1987, of the hours of any year.
std::string typical_year() {
    std::string text =
        "LOCATION,Here,-,XXX,made,0,23.13,113.32,8,20\nDATA "
        "PERIODS,1,1,a,Sunday,1/1,12/31\n";
    for (int k = 0; k < 8760; ++k) {
        const physics::CalendarStep step =
            physics::calendar_step(parse_time("2021-01-01") + std::chrono::hours(k));
        text +=
            fmt::format("1987,{},{},{},0,x,{},0,50,0,0,0,0,{},0,100\n", step.month,
                        step.day, step.hour + 1, step.month, step.hour == 12 ? 500 : 100);
    }
    return text;
}

TEST(StockTables, MayHaveATypicalYearsWeather) {
    const auto later = [](int k) { return hourly(k + 100 * 24); };
    const std::string columns = "name,floor_area,weather,gas,gas_column,year\n";
    const StockTable stock(columns + "one,1500,w.epw,gas.csv,kwh,2021\n",
                           readings(8760, later), 0);
    stock.folder().write("w.epw", typical_year());
    const study::Case building = stock.building();
    EXPECT_EQ(ends_of(building, 0), "2021-04-11 2022-03-14");
    const auto at = [&](const char* time) {
        const int step = building.weather.axis.step_of(parse_time(time));
        return building.weather.theta_e.at(static_cast<std::size_t>(step));
    };
    EXPECT_EQ(at("2021-05-10 12:00"), 5);
    EXPECT_EQ(at("2022-02-10 12:00"), 2);
    const StockTable unsaid(
        "name,floor_area,weather,gas,gas_column\n"
        "one,1500,w.epw,gas.csv,kwh\n",
        readings(8760, later), 0);
    unsaid.folder().write("w.epw", typical_year());
    EXPECT_NE(unsaid.complaint().find("say by year which one a typical year stands for"),
              std::string::npos)
        << unsaid.complaint();
}

TEST(StockReadings, KnowTheirHoursAndWholeDays) {
    input::Stamps stamps;
    stamps.step_s = 900;
    std::vector<double> values;
    for (int k = 0; k < 4 * 24 * 3 - 2; ++k) {
        stamps.begins.push_back(parse_time("2021-03-01") + std::chrono::minutes(15 * k));
        values.push_back(k == 0 ? std::nan("") : 1);
    }
    const std::string text = "time,kwh\n2021-03-01,1\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    const input::StampRules rules;
    const description::ReadingsLook look =
        description::look_at({csv, stamps, rules, values}, {});
    EXPECT_EQ(look.hours, (4 * 24 * 3 - 3) / 4.0);
    EXPECT_EQ(look.first_day, "2021-03-01");
    EXPECT_EQ(look.last_day, "2021-03-02") << "the third day lacks half an hour";
}

}  // namespace
}  // namespace bemcal::job
