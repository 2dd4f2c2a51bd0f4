/// Meters as published, where they are at hand: what the checks find in them, printed as
/// a table.
#include "checks/series.hpp"
#include "checks/values.hpp"
#include "input/csv_numbers.hpp"
#include "input/input_files.hpp"
#include "input/stamps.hpp"
#include "job/small_office.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::Quantity;

const std::filesystem::path data = BEMCAL_ROOT "/../shared/data";
const std::filesystem::path cases = BEMCAL_ROOT "/../shared/cases/dev";

/// Columns of one file as meters of one building, checked.
class Checked {
  public:
    Checked(const std::filesystem::path& file, physics::Site site, bool at_end = false) {
        building.name = file.stem().string();
        building.weather.site = site;
        csv_ = &files_.csv(file);
        input::StampRules rules;
        rules.at_end = at_end;
        rules.clock = input::Clock::standard;
        rules.site_offset_h = rules.file_offset_h = site.utc_offset_h;
        stamps_ = input::stamps_in(*csv_, 0, rules);
    }
    void add(const std::string& column, Quantity quantity) {
        input::RegularSeries series =
            input::lay(*csv_, stamps_, input::numbers_in(*csv_, csv_->column(column)));
        for (const checks::Finding& found : checks::check_series(series, quantity, {}))
            building.decisions.push_back({column, found.finding, found.action});
        building.meters.push_back(
            {column, quantity, physics::Interval::hourly, series.axis, series.values});
    }
    void add_all(Quantity quantity) {
        for (std::size_t k = 1; k < csv_->columns.size(); ++k)
            add(csv_->columns[k], quantity);
    }
    int count(const std::string& series, const std::string& words) const {
        return static_cast<int>(std::ranges::count_if(
            building.decisions, [&](const study::DataDecision& decision) {
                return (series.empty() || decision.series == series) &&
                       (decision.finding + decision.action).find(words) !=
                           std::string::npos;
            }));
    }
    void print() const {
        for (const auto& decision : building.decisions)
            fmt::print("{} | {} | {} | {}\n", building.name, decision.series,
                       decision.finding, decision.action);
    }

    study::Case building;

  private:
    input::InputFiles files_;
    const input::Csv* csv_;
    input::Stamps stamps_;
};

bool is_here(const std::filesystem::path& path) {
    return std::filesystem::exists(path);
}

/// What is said of the values of a column, by its own steps and by days.
int doubts_in(const input::RegularSeries& series, Quantity quantity) {
    int n = 0;
    for (const int step_s : {series.axis.step_s, physics::day_s}) {
        input::RegularSeries rows = input::coarsened(series, step_s, input::Fold::sum);
        std::optional<checks::Question> question;
        n += static_cast<int>(checks::mask_codes(rows, quantity).size());
        n += checks::doubt_of_register(rows, quantity) ? 1 : 0;
        n += static_cast<int>(
            checks::check_negative(rows, quantity, checks::Handling::check, question)
                .size());
        n += static_cast<int>(checks::mask_spikes(rows, quantity).size());
        n += question ? 1 : 0;
    }
    return n;
}

constexpr struct {
    const char *file, *columns;
} real_meters[] = {{"data/cambridge/gas_as_published.csv.gz", "*"},
                   {"data/cambridge/electricity_kwh.csv.gz", "*"},
                   {"data/tartu/b10045.csv.gz", "heat_kW"},
                   {"data/tartu/b11491.csv.gz", "heat_kW"},
                   {"data/building_1298/hourly.csv.gz",
                    "elec_kWh chilledwater_kWh steam_kWh hotwater_kWh"},
                   {"data/phoenix_office/office_abigail.csv.gz", "elec_kWh"},
                   {"data/uk_home/gas.csv.gz", "gas_kWh"},
                   {"data/uk_home/electricity.csv.gz", "electricity_kWh"},
                   {"meters/cambridge_gas.csv.gz", "*"},
                   {"meters/hong_kong_cooling.csv.gz", "*"},
                   {"meters/orlando_hannah.csv.gz", "*"},
                   {"meters/tartu_bPr01_heat.csv.gz", "*"}};

TEST(RealMeters, HaveNoCodesSpikesNegativesAndAreNoRegisters) {
    int n_meters = 0;
    for (const auto& [name, columns] : real_meters) {
        const auto file = data.parent_path() / name;
        if (!is_here(file)) GTEST_SKIP() << file << " is not here";
        input::InputFiles files;
        const input::Csv& csv = files.csv(file);
        input::StampRules rules;
        rules.clock = input::Clock::standard;
        const input::Stamps stamps = input::stamps_in(csv, 0, rules);
        for (std::size_t k = 1; k < csv.columns.size(); ++k) {
            if (std::string(columns) != "*" &&
                std::string(columns).find(csv.columns[k]) == std::string::npos)
                continue;
            const auto series = input::lay(csv, stamps, input::numbers_in(csv, k));
            EXPECT_EQ(doubts_in(series, Quantity::district), 0)
                << name << " " << csv.columns[k];
            ++n_meters;
        }
    }
    fmt::print("{} meters, by their steps and by days\n", n_meters);
}

TEST(RealMeters, AHeatMetersRegisterIsKnown) {
    const auto file = data / "tartu" / "b10045.csv.gz";
    if (!is_here(file)) GTEST_SKIP() << file << " is not here";
    input::InputFiles files;
    const input::Csv& csv = files.csv(file);
    input::StampRules rules;
    rules.clock = input::Clock::standard;
    const auto series = input::lay(csv, input::stamps_in(csv, 0, rules),
                                   input::numbers_in(csv, csv.column("energy_cum_kWh")));
    EXPECT_TRUE(checks::doubt_of_register(series, Quantity::district).has_value());
}

TEST(RealMeters, CambridgesGasHasItsZeroFillsMasked) {
    const auto file = data / "cambridge" / "gas_as_published.csv.gz";
    if (!is_here(file)) GTEST_SKIP() << file << " is not here";
    Checked gas(file, {52.2, 0.12, 0});
    gas.add_all(Quantity::gas);
    checks::check_clocks(gas.building);
    std::vector<study::Case> buildings{gas.building};
    checks::check_shared_meters(buildings);
    gas.building = buildings[0];
    gas.print();
    EXPECT_GE(gas.count("", "masked"), 8);
    EXPECT_EQ(gas.count("", "a step by"), 0);  // the seasons are none
}

TEST(RealMeters, CambridgesElectricityHasFillsAndZerosMasked) {
    const auto file = data / "cambridge" / "electricity_kwh.csv.gz";
    if (!is_here(file)) GTEST_SKIP() << file << " is not here";
    Checked power(file, {52.2, 0.12, 0});
    for (const char* name : {"b0", "b13", "b20", "b24", "b29", "b35", "b47", "b61", "b74",
                             "b77", "b82", "b96"})
        power.add(name, Quantity::electricity);
    checks::check_clocks(power.building);
    power.print();
    EXPECT_EQ(power.count("b74", "masked"), 2);
    EXPECT_EQ(power.count("b24", "masked"), 0);
    EXPECT_EQ(power.count("b24", "begin an hour earlier"), 1);
    EXPECT_EQ(power.count("", "a step by"), 0);
}

TEST(RealMeters, TartusHeatStandsWhereItsPeopleMove) {
    for (const char* name : {"b10045", "b11491"}) {
        const auto file = data / "tartu" / (std::string(name) + ".csv.gz");
        if (!is_here(file)) GTEST_SKIP() << file << " is not here";
        Checked heat(file, {58.38, 26.72, 2});
        heat.add("heat_kW", Quantity::district);
        heat.building.profiles.emplace_back().schedule.summer_time = "eu";
        checks::check_clocks(heat.building);
        heat.print();
        EXPECT_EQ(heat.count("", "a step by"), 0) << name;
        if (std::string_view(name) == "b11491") {
            EXPECT_EQ(heat.count("", "do not move with summer time"), 1);
        }
    }
}

TEST(RealMeters, ThreeOthersShowWhatIsKnownOfThem) {
    const auto file = data / "building_1298" / "hourly.csv.gz";
    if (!is_here(file)) GTEST_SKIP() << file << " is not here";
    Checked research(file, {40, -75, -5});
    research.add("elec_kWh", Quantity::electricity);
    research.add("chilledwater_kWh", Quantity::cooling);
    research.print();
    EXPECT_EQ(research.count("elec_kWh", "masked"), 2);  // dropouts are zeros there
    Checked office(data / "phoenix_office" / "office_abigail.csv.gz", {33.4, -112.1, -7});
    office.add("elec_kWh", Quantity::electricity);
    checks::check_clocks(office.building);
    office.print();
    EXPECT_TRUE(office.building.decisions.empty());
    Checked home(data / "uk_home" / "gas.csv.gz", {52, 0, 0});
    home.add("gas_kWh", Quantity::gas);
    checks::check_clocks(home.building);
    home.print();
    EXPECT_EQ(home.count("", "begin an hour earlier"), 1);
    EXPECT_EQ(home.count("", "masked"), 0);
}

// Made readings with noise and gaps, a scale step of a quarter in one of them: there is
// nothing to correct.
TEST(MadeCases, HaveNothingToCorrect) {
    if (!is_here(cases)) GTEST_SKIP() << cases << " is not here";
    int n_cases = 0;
    for (const auto& folder : std::filesystem::directory_iterator(cases)) {
        Checked made(folder.path() / "measured.csv", {45, 10, 1}, true);
        ++n_cases;
        input::InputFiles files;
        for (const std::string& column :
             files.csv(folder.path() / "measured.csv").columns) {
            if (column == "T_air_C") made.add(column, Quantity::air_temperature);
            if (column == "heat_kWh") made.add(column, Quantity::heating);
            if (column == "cool_kWh") made.add(column, Quantity::cooling);
            if (column == "elec_kWh") made.add(column, Quantity::electricity);
            if (column == "gas_kWh") made.add(column, Quantity::gas);
        }
        checks::check_clocks(made.building);
        for (const auto& decision : made.building.decisions)
            EXPECT_NE(decision.finding.find(" over 24 h"), std::string::npos)
                << folder.path() << " " << decision.series << ": " << decision.finding;
    }
    EXPECT_EQ(n_cases, 10);
}

}  // namespace
}  // namespace bemcal::job
