/// [[effect]]: what a job says of effects that its building has, in every study.
#include "effects/catalogue.hpp"
#include "effects/job_section.hpp"
#include "effects/loads.hpp"
#include "effects/make_surroundings.hpp"
#include "job/small_office.hpp"
#include "physics/numbers.hpp"
#include "physics/parameters.hpp"

#include <algorithm>
#include <span>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// The sample with more of it before its parameters.
study::Case office_with(const std::string& sections) {
    const Folder folder;
    const std::string text =
        replaced(small_office_text(), "[[parameter]]", sections + "\n[[parameter]]");
    return read_job(write_small_office(folder, text)).buildings.at(0);
}

double mean_of_row(const physics::Drive& drive, std::size_t row) {
    double sum = 0;
    for (const double value : drive.profiles.row(row)) sum += value;
    return sum / drive.n_steps();
}

TEST(DeclaredEffects, AreARowOfTheCatalogue) {
    const study::Case office = office_with(
        "[[effect]]\nname = \"wind infiltration\"\ncoefficient = 0.02\n"
        "[[parameter]]\nname = \"by_wind\"\ntarget = \"effect.wind infiltration\"\n"
        "min = 0\nmax = 0.1\nprior = {kind = \"normal\", mean = 0.03, sd = 0.01}\n");
    ASSERT_EQ(office.building.effects.size(), 1U);
    EXPECT_EQ(office.building.effects[0].unit, "1/h per m/s");
    EXPECT_EQ(office.parameters[0].name, "by_wind");
    EXPECT_EQ(office.parameters[0].unit, "1/h per m/s");
    EXPECT_EQ(office.parameters[0].nominal, 0.02);
    // What it follows, in each period: 8 km/h on the mean of whole days.
    ASSERT_NE(office.declared_effects, nullptr);
    EXPECT_EQ(office.declared_effects->n_rows, 1U);
    for (const study::Period& period : office.periods)
        EXPECT_NEAR(mean_of_row(study::drive_of(office, period),
                                office.declared_effects->first_row),
                    8 * 0.277778, 0.01);
}

TEST(DeclaredEffects, AreSaidByHookDriverFormAndGate) {
    const study::Case office = office_with(
        "[[effect]]\nname = \"warm nights\"\nhook = \"heating set-point\"\n"
        "gate = \"night\"\nweekday = \"friday\"\nhours = [19, 23]\n"
        "coefficient = 2\n"
        "[[effect]]\nname = \"sauna\"\nhook = \"meter addition\"\n"
        "meter = \"electricity\"\ndays = [\"2021-01-10/2021-01-12\"]\n"
        "coefficient = 1\n"
        "[[effect]]\nname = \"blind\"\nhook = \"aperture\"\nfacade = \"south\"\n"
        "driver = \"outdoor temperature\"\nform = \"above\"\nat = 18\n"
        "coefficient = -0.05\n");
    const auto& effects = office.declared_effects->effects;
    EXPECT_EQ(sentence_of(effects[0]), "constant, at night, on Fridays, from 19 to 23 h");
    EXPECT_EQ(sentence_of(effects[1]),
              "constant, 2021-01-10 to 2021-01-12, electricity meter");
    EXPECT_EQ(sentence_of(effects[2]), "outdoor temperature above 18 degC, south facade");
    const physics::Drive drive = study::drive_of(office, office.periods[0]);
    const auto gate = drive.profiles.row(office.declared_effects->first_row);
    int n_open = 0;
    for (const double value : gate) n_open += value == 1 ? 1 : 0;
    // Two weeks of warm-up, 31 days: every Friday has four such hours.
    EXPECT_EQ(n_open % 4, 0);
    EXPECT_GE(n_open, 5 * 4);
}

/// What can enter the sample, of the catalogue and of the grammar.
std::vector<effects::Effect> candidates() {
    const study::Case office = office_with("");
    const physics::Drive drive = study::drive_of(office, office.periods[0]);
    effects::Surroundings around = effects::make_surroundings(
        office.building, drive, office.weather, office.periods[0].from);
    around.model = effects::loads_of(office.building, drive);
    const std::vector<physics::Quantity> meters = {physics::Quantity::electricity};
    std::vector<effects::Effect> all = effects::named_candidates(around, meters);
    for (effects::Effect& effect : all)
        if (effects::follows_loads(effect.driver)) effect.full_load = 4500;
    const auto others = effects::generic_candidates(around, meters);
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

/// A loop writes them so that the job has the same effect.
TEST(DeclaredEffects, AreReadAsTheyAreWritten) {
    constexpr std::size_t every = 3;
    int n_of_loads = 0;
    const physics::Seconds from = physics::parse_time("2021-01-01");
    const std::vector<effects::Effect> all = candidates();
    ASSERT_GT(all.size(), 300U);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const effects::Effect& effect = all[k];
        const bool is_of_load = effects::follows_loads(effect.driver);
        if (k % every != 0 && !is_of_load) continue;
        n_of_loads += is_of_load ? 1 : 0;
        const double typical = std::abs(effect.typical) / 3;
        const std::string section =
            effects::job_section_of(effect, {typical, typical / 9, -1e9, 1e9}, from);
        if (section.empty()) continue;
        SCOPED_TRACE(section);
        const study::Case office = office_with(section);
        const effects::Effect& own = office.declared_effects->effects.at(0);
        EXPECT_EQ(sentence_of(own), sentence_of(effect));
        EXPECT_TRUE(own.driver == effects::Driver::elapsed || are_equal(own, effect));
        EXPECT_EQ(own.full_load, effect.full_load);
        EXPECT_EQ(office.declared_effects->coefficients[0], typical);
        EXPECT_EQ(office.parameters.at(0).targets.size(),
                  office.building.effects.at(0).targets.size());
        EXPECT_NEAR(office.parameters[0].nominal, typical, 1e-12);
    }
    EXPECT_GE(n_of_loads, 3);  // reheat, part load of heating and of cooling
}

/// A row of the catalogue may be found twice, with two thresholds.
TEST(DeclaredEffects, ATakenNameSaysTheShape) {
    const auto& rows = effects::catalogue();
    effects::Effect effect =
        std::ranges::find(rows, "part-load efficiency of heating", [](const auto& row) {
            return row.effect.name;
        })->effect;
    effect.shape.at = 0.5;
    effect.full_load = 4000;
    const std::vector<std::string> taken{effects::name_in_job(effect)};
    const std::string section =
        effects::job_section_of(effect, {-0.2, 0, -1, 1}, {}, taken);
    const study::Case office = office_with(section);
    const effects::Effect& own = office.declared_effects->effects.at(0);
    EXPECT_EQ(own.name, "part-load efficiency of heating: heating load below 0,5");
    EXPECT_TRUE(are_equal(own, effect));
    EXPECT_EQ(own.full_load, 4000);
}

TEST(DeclaredEffects, OtherHoursAreLinesOfTheirSchedule) {
    effects::OtherHours other;
    other.schedule = "plant";
    other.low = 0.5;
    other.declared = {{{6, 18}, {0, 0}, {0, 0}}};
    other.hours = {{{6, 18}, {7, 9}, {0, 0}}};
    EXPECT_EQ(effects::job_section_of(effects::with_hours(other), {1, 0, 1, 1}, {}),
              "# in the [[schedule]] \"plant\", in place of what it has:\n"
              "saturday = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1, 1, 0.5, 0.5, 0.5, 0.5, "
              "0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5]\n");
}

TEST(DeclaredEffects, BeginOnTheirDay) {
    const study::Case office = office_with(
        "[[effect]]\nname = \"less glass\"\nhook = \"aperture\"\ndriver = \"time elapsed\"\n"
        "since = \"2021-02-10\"\ncoefficient = -0.4\n");
    const std::size_t row = office.declared_effects->first_row;
    EXPECT_EQ(mean_of_row(study::drive_of(office, office.periods[0]), row), 0);
    const physics::Drive drive = study::drive_of(office, office.periods[1]);
    for (int step = drive.n_warm_up; step < drive.n_steps(); ++step) {
        const bool after = drive.axis.begin_of(step) >= physics::parse_time("2021-02-10");
        EXPECT_EQ(drive.profiles(row, static_cast<std::size_t>(step)), after ? 1 : 0);
    }
}

TEST(DeclaredEffects, FollowFunctionsAsTheyAreWritten) {
    effects::Effect at;
    at.name = "gains";
    at.hook = effects::Hook::gains;
    using Kind = functions::Points::Kind;
    const std::vector<effects::DriverFunction> all = {
        {"one", {}, {1.5}},
        {"hour of the week", {Kind::hours}, std::vector<double>(72, 0.25)},
        {"wind", {Kind::knots, {1, 2.5, 9}}, {0, 1.0 / 3, -1}},
        {"time", {Kind::fortnights, {}, 3}, {0, 2, 4}},
        {"hour of the week from a day on",
         {Kind::hours_from, {0.5}},
         std::vector<double>(72, 100)}};
    const study::Case office = office_with(effects::job_section_of(at, all));
    const effects::DeclaredEffects& declared = *office.declared_effects;
    EXPECT_EQ(declared.coefficients, std::vector<double>{1});
    EXPECT_TRUE(declared.effects[0].is_smooth);
    const auto& read = declared.functions.at(0).functions;
    ASSERT_EQ(read.size(), 5U);
    for (std::size_t k = 0; k < read.size(); ++k) {
        const effects::DriverFunction& written = all[k];
        EXPECT_EQ(read[k].driver, written.driver);
        EXPECT_EQ(read[k].values, written.values);
        EXPECT_EQ(read[k].points.knots, written.points.knots);
        EXPECT_EQ(read[k].points.kind, written.points.kind);
    }
    // January's second half is the second fortnight: 2 W/m2 of time, 1.5 always.
    const physics::Drive drive = study::drive_of(office, office.periods[0]);
    const int step = drive.axis.step_of(physics::parse_time("2021-01-20T12:00"));
    const auto wind = declared.functions[0].functions[2];
    const double sum = drive.profiles(declared.first_row, static_cast<std::size_t>(step));
    const double by_wind = sum - 2 - 1.5 - 0.25;
    EXPECT_GE(by_wind, -1);
    EXPECT_LE(by_wind, 1.0 / 3);
}

/// In kW of the nominal building: a parameter's value moves them.
TEST(DeclaredEffects, FollowTheLoadOfTheNominalBuilding) {
    effects::Effect at;
    at.name = "heating efficiency";
    at.hook = effects::Hook::heating_efficiency;
    const effects::DriverFunction by_load{
        "heating load", {functions::Points::Kind::knots, {0, 20}}, {-0.2, 0.2}};
    const std::string section = effects::job_section_of(at, {by_load});
    const auto row_of = [&](const std::string& sections) {
        const study::Case office = office_with(section + sections);
        const physics::Drive drive = study::drive_of(office, office.periods[0]);
        const auto row = drive.profiles.row(office.declared_effects->first_row);
        const effects::ModelSeries loads = effects::loads_of(office.building, drive);
        for (std::size_t k = 0; k < row.size(); ++k)
            EXPECT_NEAR(row[k], -0.2 + 0.02 * std::min(loads.heating[k] / 1000, 20.0),
                        1e-12);
        return std::vector<double>(row.begin(), row.end());
    };
    EXPECT_NE(row_of(""), row_of("[[parameter]]\nname = \"air\"\n"
                                 "target = \"zone.office.sky_temperature_difference\"\n"
                                 "min = 0\nmax = 20\nvalue = 15\n"));
}

study::Case office_of(const std::string& structure, const std::string& sections = "") {
    const Folder folder;
    std::string text = replaced(small_office_text(), "[site]", structure + "\n[site]");
    text = replaced(text, "[[parameter]]", sections + "\n[[parameter]]");
    return read_job(write_small_office(folder, text)).buildings.at(0);
}

const physics::Parameter& parameter_named(const study::Case& building,
                                          const std::string& name) {
    return *std::ranges::find(building.parameters, name, &physics::Parameter::name);
}

TEST(DeclaredStructure, HasItsNumbersAsParameters) {
    const study::Case office = office_of("structure = [\"surfaces\", \"wind in leaks\"]");
    EXPECT_EQ(office.structure.size(), 2U);
    const physics::Parameter& ratio = parameter_named(office, "mass_area_ratio");
    EXPECT_EQ(ratio.nominal, 2.5);
    EXPECT_EQ(physics::number_at(office.building, ratio.targets[0]), 2.5);
    const physics::Parameter& share =
        parameter_named(office, "share of infiltration by wind");
    EXPECT_EQ(share.nominal, 0.3);
    EXPECT_EQ(share.least, 0.3 - 2.5 * 0.1);
    ASSERT_EQ(office.building.effects.size(), 1U);
    ASSERT_EQ(office.priors.size(), office.parameters.size());
    EXPECT_EQ(office.priors.back().prior.kind, stats::PriorKind::normal);
    EXPECT_EQ(office.priors.back().prior.a, 0.3);
}

// Until a parameter leads to it.
TEST(DeclaredStructure, LeavesWhatTheJobWrites) {
    const Folder folder;
    std::string text =
        replaced(small_office_text(), "[site]",
                 "structure = [\"air and thermostat\", \"wind in leaks\"]\n[site]");
    text = replaced(text, "[[zone]]", "[[zone]]\nair_capacity = 40000");
    text = replaced(text, "[[parameter]]",
                    "[[effect]]\nname = \"share of infiltration by wind\"\n"
                    "hook = \"leakage\"\ndriver = \"wind about its mean\"\n"
                    "coefficient = 0.2\n[[parameter]]");
    const study::Case office = read_job(write_small_office(folder, text)).buildings.at(0);
    EXPECT_EQ(office.declared_effects->coefficients, std::vector<double>{0.2});
    EXPECT_EQ(office.building.zones[0].structure.air_capacity, 40000);
    EXPECT_EQ(parameter_named(office, "thermostat_band").nominal, 0.8);
    for (const physics::Parameter& parameter : office.parameters) {
        EXPECT_NE(parameter.name, "share of infiltration by wind");
        EXPECT_NE(parameter.name, "air_capacity");
    }
}

TEST(DeclaredStructure, BringsAirSystemsThatNoSectionHas) {
    EXPECT_EQ(office_of("structure = [\"coil that dries\"]").building.air_systems.size(),
              1U);
    const study::Case office = office_of(
        "structure = [\"terminals with reheat\"]",
        "[[parameter]]\nname = \"fans\"\nmode = \"factor\"\n"
        "target = \"zone.*.flow.ventilation.air_change\"\nmin = 0.5\nmax = 2\n");
    ASSERT_EQ(office.building.air_systems.size(), 1U);
    EXPECT_EQ(office.building.air_systems[0].outdoor_air_change.value, 1);
    const physics::Parameter& fans = parameter_named(office, "fans");
    EXPECT_EQ(physics::number_at(office.building, fans.targets.at(0)), 1);
    EXPECT_EQ(fans.targets[0].part, physics::Part::air_system);
}

TEST(DeclaredStructure, LeavesTheJobsOwnParametersAlone) {
    const study::Case office = office_of(
        "structure = [\"surfaces\", \"wind in leaks\"]",
        "[[effect]]\nname = \"share of infiltration by wind\"\nhook = \"leakage\"\n"
        "driver = \"wind about its mean\"\ncoefficient = 0.2\n"
        "[[parameter]]\nname = \"mine\"\ntarget = \"zone.*.mass_area_ratio\"\n"
        "min = 2\nmax = 4\nvalue = 3\n"
        "[[parameter]]\nname = \"wind\"\n"
        "target = \"effect.share of infiltration by wind\"\nmin = 0\nmax = 0.4\n");
    EXPECT_EQ(parameter_named(office, "mine").nominal, 3);
    EXPECT_EQ(parameter_named(office, "wind").nominal, 0.2);
    EXPECT_EQ(office.building.effects.size(), 1U);
    for (const physics::Parameter& parameter : office.parameters) {
        EXPECT_NE(parameter.name, "mass_area_ratio");
        EXPECT_NE(parameter.name, "share of infiltration by wind");
    }
}

// A study that does not vary it has it, too; a factor is of what was described.
TEST(DeclaredValue, IsTheBuildingsNumber) {
    const study::Case
        described = office_with(""),
        office = office_with(
            "[[parameter]]\nname = \"cop\"\ntarget = \"plant.cooling_cop\"\n"
            "mode = \"factor\"\nmin = 0.5\nmax = 2\nvalue = 1.25\n");
    const physics::Parameter& cop = parameter_named(office, "cop");
    EXPECT_EQ(cop.nominal, 1.25);
    const double before = described.building.plant.cooling_cop.value;
    EXPECT_DOUBLE_EQ(office.building.plant.cooling_cop.value, 1.25 * before);
    physics::Building at_one = office.building;
    physics::apply(office.building, std::span(&cop, 1), std::vector<double>{1}, at_one);
    EXPECT_DOUBLE_EQ(at_one.plant.cooling_cop.value, before);
}

}  // namespace
}  // namespace bemcal::job
