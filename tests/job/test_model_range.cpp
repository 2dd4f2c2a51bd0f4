#include "job/model_range.hpp"
#include "job/small_office.hpp"
#include "study/datasets.hpp"
#include "study/small_case.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// A floor of 200 m2 and one meter.
study::Case case_with(const char* unit, int row_s = 3600,
                      physics::Interval interval = physics::Interval::hourly) {
    study::Case made = test::small_case();
    made.meters.push_back({"gas", physics::Quantity::gas, interval, {}, {}, unit, row_s});
    return made;
}

/// What the model reaches from 20 to 66 MWh.
study::MeterRange metered(double kwh, double nominal = 41000) {
    return {0, 0, kwh, nominal, 20000, 66000, 71};
}

TEST(ModelRange, NothingIsSaidOfAMeterWithinIt) {
    EXPECT_EQ(words_of_range(case_with("kWh"), metered(41000)), "");
    EXPECT_EQ(words_of_range(case_with("kWh"), metered(73000)), "");  // less 10 %: 65.7
}

TEST(ModelRange, NamesTheFactorAndTheUnitsThatWouldFit) {
    EXPECT_EQ(words_of_range(case_with("kWh"), metered(4.12e7)),
              "gas in training: metered 41.2 GWh, 624 times the most that the model "
              "reaches, 20 MWh to 66 MWh (71 points over the ranges of its parameters); "
              "its numbers were read as kWh, and would lie in this range as Wh 41.2 MWh "
              "(times 1/1000)");
    EXPECT_EQ(words_of_range(case_with("kWh"), metered(205)),
              "gas in training: metered 205 kWh, 1/97.6 of the least that the model "
              "reaches, 20 MWh to 66 MWh (71 points over the ranges of its parameters); "
              "its numbers were read as kWh, and would lie in this range as kWh/m2 41 "
              "MWh (times 200) or as GJ 56.9 MWh (times 277.8)");
}

TEST(ModelRange, LargeFactorsAreWrittenInFull) {
    const auto says = [](double kwh, const char* words) {
        const std::string said = words_of_range(case_with("kWh"), metered(kwh));
        EXPECT_NE(said.find(words), std::string::npos) << said;
    };
    says(6.6e8, " 10000 times the most that ");
    says(10, " 1/2000 of the least that ");
}

TEST(ModelRange, KnowsTheUnitThatWasDeclared) {
    // Numbers of kWh that the job calls Wh.
    const std::string said = words_of_range(case_with("Wh"), metered(41));
    EXPECT_NE(said.find("read as Wh, and would lie in this range as kWh 41 MWh (times "
                        "1000)"),
              std::string::npos)
        << said;
}

TEST(ModelRange, PowersOfQuarterAndHalfHoursAreFourAndTwoTimesTooMuch) {
    const auto said = [](int row_s, double kwh) {
        return words_of_range(case_with("kWh", row_s), metered(kwh, 40000));
    };
    EXPECT_NE(said(900, 160000).find("as kW 40 MWh (times 1/4)"), std::string::npos)
        << said(900, 160000);
    EXPECT_NE(said(1800, 80000).find("as kW 40 MWh (times 1/2)"), std::string::npos)
        << said(1800, 80000);
}

TEST(ModelRange, GasMayBeCubicMetresAndMonthsAreNoPowers) {
    const auto said = [](const char* unit, physics::Interval interval, double kwh,
                         double nominal) {
        return words_of_range(case_with(unit, 3600, interval), metered(kwh, nominal));
    };
    using enum physics::Interval;
    EXPECT_NE(said("kWh", monthly, 4000, 45000).find("as m3 44.9 MWh (times 11.22)"),
              std::string::npos)
        << said("kWh", monthly, 4000, 45000);
    EXPECT_NE(said("kWh", monthly, 1400, 41000).find("as therm 41 MWh (times 29.31)"),
              std::string::npos)
        << said("kWh", monthly, 1400, 41000);
    EXPECT_EQ(said("kWh", monthly, 41e6, 41000).find("as W "), std::string::npos);
}

TEST(ModelRange, AFactorOfNoUnitIsSaidWithoutOne) {
    // 41 MWh in km: no unit of the table lies there.
    const std::string said = words_of_range(case_with("kWh"), metered(3.5e6));
    EXPECT_EQ(said,
              "gas in training: metered 3.5 GWh, 53 times the most that the model "
              "reaches, 20 MWh to 66 MWh (71 points over the ranges of its parameters)");
}

TEST(ModelRange, AModelWithoutAnyIsSentToItsPlant) {
    EXPECT_EQ(words_of_range(case_with("kWh"), {0, 0, 167000, 0, 0, 0, 67}),
              "gas in training: metered 167 MWh, but the model has none at any of 67 "
              "points over the ranges of its parameters: see [plant] and the meter's "
              "quantity");
}

TEST(ModelRange, IsOfTheMetersAndPeriodsThatStudiesFit) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder));
    const study::Case& building = job.buildings.at(0);
    const auto ranges = fitted_ranges(job, building);
    ASSERT_EQ(ranges.size(), 1U);  // its other meter is a temperature
    EXPECT_EQ(ranges[0].range.period, 0U);
    const auto datasets = range_datasets(building, ranges);
    const auto* measured =
        study::find_dataset(datasets, building.name + "/data/range_measured");
    ASSERT_NE(measured, nullptr);
    EXPECT_EQ(measured->values, std::vector<double>{ranges[0].range.measured});
    EXPECT_EQ(study::find_dataset(datasets, building.name + "/data/shortfall") == nullptr,
              ranges[0].beyond.empty());
    Job none = job;
    none.studies.clear();
    EXPECT_TRUE(fitted_ranges(none, building).empty());
    EXPECT_TRUE(range_datasets(building, {}).empty());
}

}  // namespace
}  // namespace bemcal::job
