/// Whole jobs: what the sample becomes, and how sections, files and defaults meet.
#include "job/job.hpp"
#include "job/small_office.hpp"
#include "job/stages.hpp"
#include "plan/plan.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

TEST(Job, SampleBecomesABuildingWithItsNumbers) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder));
    EXPECT_EQ(job.name, "small_office");
    EXPECT_EQ(job.seed, 7U);
    ASSERT_EQ(job.buildings.size(), 1U);
    const study::Case& office = job.buildings[0];
    ASSERT_EQ(office.building.zones.size(), 1U);
    const physics::Zone& zone = office.building.zones[0];
    EXPECT_EQ(zone.heat_capacity, 260000);  // class heavy
    EXPECT_EQ(zone.mass_area_ratio, 3.0);
    ASSERT_EQ(zone.surfaces.size(), 4U);
    EXPECT_EQ(zone.surfaces[2].name, "surface_3");
    EXPECT_EQ(zone.surfaces[3].boundary, 0);
    EXPECT_FALSE(zone.surfaces[3].in_sun);
    EXPECT_EQ(office.building.planes.size(), 3U);  // south, north, roof
    EXPECT_EQ(zone.thermostat.heating_set_point.value, 20);
    EXPECT_EQ(zone.thermostat.heating_set_point.low, 15);
    EXPECT_EQ(zone.thermostat.heating_set_point.profile, 1);
    EXPECT_EQ(zone.loads[1].carrier, physics::Carrier::electricity);
    EXPECT_EQ(zone.windows[0].shading.value, 0.9);
    EXPECT_EQ(office.periods[0].name, "training");
    EXPECT_EQ(physics::format_time(office.periods[0].to), "2021-02-01 00:00:00");
    EXPECT_EQ(office.warm_up_hours, 14 * 24);
    EXPECT_NEAR(office.weather.wind_speed[0],
                (8 + 4 * std::cos(2 * M_PI * 14 / 24)) / 3.6, 0.02);
}

TEST(Job, EveryFileReadIsThereWithAHashOfItsContent) {
    const Folder folder;
    const auto file = write_small_office(folder);
    const Job first = read_job(file);
    ASSERT_EQ(first.inputs.size(), 3U);
    EXPECT_EQ(first.inputs[0].path, file);
    folder.write("measured.csv", replaced(small_readings(), ",2", ",3"));
    const Job second = read_job(file);
    EXPECT_EQ(first.inputs[1].hash, second.inputs[1].hash);
    EXPECT_NE(first.inputs[2].hash, second.inputs[2].hash);
}

TEST(Job, ReadingsStandAtTheBeginOfTheirHourAndMaskedDaysAreMissing) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder));
    const study::Meter& meter = job.buildings[0].meters[0];
    EXPECT_EQ(physics::format_time(meter.axis.start), "2021-01-01 00:00:00");
    EXPECT_NEAR(meter.values[1], 12 + 6 * std::sin(1 / 3.8), 0.005);
    for (int day = 1; day <= 59; ++day)
        EXPECT_EQ(std::isnan(meter.values[static_cast<std::size_t>(24 * (day - 1) + 5)]),
                  day == 20 || day == 21)
            << day;
}

TEST(Job, ParametersKnowUnitRangeAndNominal) {
    const Folder folder;
    const auto parameters = read_job(write_small_office(folder)).buildings[0].parameters;
    ASSERT_EQ(parameters.size(), 3U);
    EXPECT_EQ(parameters[0].unit, "1/h");
    EXPECT_EQ(parameters[0].nominal, 0.4);
    EXPECT_EQ(parameters[1].targets.size(), 2U);
    EXPECT_EQ(parameters[1].nominal, 1);
    EXPECT_EQ(parameters[2].nominal, 0);
}

/// The sample with its readings of electricity changed at will.
study::Case with_meter(const std::string& keys,
                       const std::string& readings = small_readings()) {
    const Folder folder;
    const auto file = write_small_office(
        folder,
        replaced(small_office_text(), "mask = [\"2021-01-20/2021-01-21\"]", keys));
    folder.write("measured.csv", readings);
    return read_job(file).buildings[0];
}

TEST(Job, UnitsPowersAndFactorsBecomeKilowattHours) {
    const double kwh = with_meter("factor = 1").meters[0].values[5];
    const std::string from = "unit = \"kWh\"";
    const auto as = [&](const std::string& to) {
        const Folder folder;
        const auto file =
            write_small_office(folder, replaced(small_office_text(), from, to));
        return read_job(file).buildings[0].meters[0].values[5];
    };
    EXPECT_NEAR(as("unit = \"MJ\""), kwh / 3.6, 1e-12);
    EXPECT_NEAR(as("unit = \"W\""), kwh / 1000, 1e-12);
    EXPECT_NEAR(as("unit = \"m3\"\nfactor = 2"), kwh * 2 * 39.5 * 1.02264 / 3.6, 1e-9);
}

TEST(Job, DailyIntervalsSumWholeDaysOnly) {
    const study::Case hourly = with_meter("factor = 1");
    const study::Case daily = with_meter("interval = \"daily\"");
    double sum = 0;
    for (std::size_t hour = 24; hour < 48; ++hour) sum += hourly.meters[0].values[hour];
    EXPECT_NEAR(daily.meters[0].values[24], sum, 1e-9);
    EXPECT_TRUE(std::isnan(daily.meters[0].values[25]));
}

TEST(Job, RunsOfZerosAreReportedAndMaskedOnlyWhenAsked) {
    std::string zeros = "time,elec_kWh,T_air_C\n";
    for (int k = 0; k < 59 * 24; ++k) {  // zeros in hours 100 to 149
        const auto time = physics::parse_time("2021-01-01") + std::chrono::hours(k + 1);
        zeros += fmt::format("{},{},{}\n", physics::format_time(time),
                             k >= 100 && k < 150 ? 0.0 : 5.0 + k % 7, 20 + k % 3);
    }
    const study::Case kept = with_meter("zeros = \"keep\"", zeros);
    EXPECT_EQ(kept.meters[0].values[120], 0);
    const auto finding = [](const study::Case& c) {
        for (const auto& decision : c.decisions)
            if (decision.finding.find("zeros") != std::string::npos) return decision;
        return study::DataDecision{};
    };
    EXPECT_EQ(finding(kept).finding,
              "1 run of zeros over 24 h, 50 h in all; the longest: 50 h from "
              "2021-01-05 04:00:00");
    const study::Case masked = with_meter("zeros = \"missing\"", zeros);
    EXPECT_TRUE(std::isnan(masked.meters[0].values[120]));
    EXPECT_EQ(finding(masked).action, "masked");
}

TEST(Job, ScaleMultipliesReadingsFromItsDay) {
    const study::Case plain = with_meter("factor = 1");
    const study::Case scaled = with_meter(
        "[[meter.scale]]\nfrom = 2021-01-10\nto = \"2021-01-10\"\nfactor = 11.2");
    EXPECT_EQ(scaled.meters[0].values[9 * 24 - 1], plain.meters[0].values[9 * 24 - 1]);
    EXPECT_NEAR(scaled.meters[0].values[9 * 24], 11.2 * plain.meters[0].values[9 * 24],
                1e-9);
    EXPECT_EQ(scaled.meters[0].values[10 * 24], plain.meters[0].values[10 * 24]);
}

TEST(Job, BuildingsTakeFromTheJobWhatTheyLeaveOut) {
    const Folder folder;
    const std::string text = small_office_text();
    write_small_office(folder);
    folder.write("a.toml", "name = \"a\"\n");
    folder.write("b.toml", "[periods]\ntraining = [2021-01-03, 2021-01-20]\n");
    const auto file = folder.write("stock.toml", replaced(text, "seed = 7",
                                                          "seed = 7\nbuildings = "
                                                          "[\"a.toml\", \"b.toml\"]"));
    const Job job = read_job(file);
    ASSERT_EQ(job.buildings.size(), 2U);
    EXPECT_EQ(job.buildings[0].name, "a");
    EXPECT_EQ(job.buildings[0].periods.size(), 2U);
    EXPECT_EQ(job.buildings[1].name, "b");
    EXPECT_EQ(job.buildings[1].periods.size(), 1U);
    EXPECT_EQ(job.buildings[1].building.zones.size(), 1U);
}

TEST(Job, OfficeHoursNeedNoBuildingAndHaveOneStageForEachCase) {
    const Folder folder;
    const auto file =
        folder.write("paper.toml",
                     "name = \"paper\"\n[[study]]\n"
                     "kind = \"office_hour_sensitivity\"\nname = \"second\"\n"
                     "n_base = 16\n[study.fixed]\nGFA = [10000, 20000]\n"
                     "theta_prev = [20, 25]\n");
    const auto plan = make_plan(read_job(file));
    ASSERT_EQ(plan.size(), 2U);
    EXPECT_EQ(plan[1]->name(), "second/case_02");
    EXPECT_EQ(plan[1]->n_simulations(), 16 * (17 + 2));
}

TEST(Plan, HasAStageForEachStudyWithANameOfItsOwn) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder));
    const auto plan = make_plan(job);
    ASSERT_EQ(plan.size(), 2U);
    EXPECT_EQ(plan[0]->name(), "small_office/sensitivity");
    EXPECT_EQ(plan[0]->n_simulations(), 64 * (3 + 2));
    const std::string text = plan::plan_text(job, 2);
    for (const char* part : {"small_office/screening", "training: 2021-01-01",
                             "memory:", "output:", "on 2 cores", "the job's mask"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Parameters, AShiftOfATemperatureIsInKelvin) {
    const Folder folder;
    const std::string shift =
        "\n[[parameter]]\nname = \"shift\"\ntarget = \"zone.office.heating_set_point\"\n"
        "mode = \"offset\"\nmin = -0.5\nmax = 0.5\n";
    const auto file = write_small_office(folder, small_office_text() + shift);
    EXPECT_EQ(read_job(file).buildings[0].parameters.back().unit, "K");
}

TEST(Plan, OfAJobWithoutStudiesSaysWhatIsMissing) {
    Job job;
    job.file = "office.toml";
    for (const bool is_check : {true, false}) {
        try {
            is_check ? void(plan::plan_text(job, 2)) : void(make_plan(job));
            FAIL() << "nothing was refused";
        } catch (const UserError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::config);
            EXPECT_NE(std::string(error.what()).find("[[study]]"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace bemcal::job
