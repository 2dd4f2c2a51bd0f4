#include "base/nan.hpp"
#include "study/bias.hpp"
#include "study/small_case.hpp"

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

/// 240 hours of 10 kWh in training: 2.4 MWh.
Case case_of(physics::Quantity quantity, double reading = 10) {
    Case made = test::small_case();
    const physics::TimeAxis axis = axis_of(made, {"all", test::day(7), test::day(24)});
    made.meters.push_back(
        {"gas", quantity, physics::Interval::hourly, axis,
         std::vector<double>(static_cast<std::size_t>(axis.n_steps), reading)});
    return made;
}

std::string bias_of(const Case& building, double nmbe) {
    const FoundFit fit{0, 0, nan, 0.5, nmbe};
    return bias_beyond(building, 0, {&fit, 1});
}

TEST(Bias, EnergiesAreWrittenInTheUnitThatSuits) {
    EXPECT_EQ(words_of_energy(0), "0 kWh");
    EXPECT_EQ(words_of_energy(0.04), "40 Wh");
    EXPECT_EQ(words_of_energy(999), "999 kWh");
    EXPECT_EQ(words_of_energy(999.6), "1 MWh");
    EXPECT_EQ(words_of_energy(166900), "167 MWh");
    EXPECT_EQ(words_of_energy(4.12e7), "41.2 GWh");
    EXPECT_EQ(words_of_energy(3e12), "3e+03 TWh");
}

TEST(Bias, MonthsMayBeBiasedByFivePercentAndHoursByTen) {
    EXPECT_EQ(bias_limit(physics::Interval::step), 0.10);
    EXPECT_EQ(bias_limit(physics::Interval::daily), 0.10);
    EXPECT_EQ(bias_limit(physics::Interval::monthly), 0.05);
    EXPECT_EQ(bias_limit(physics::Interval::annual), 0.05);
}

TEST(Bias, BeyondTheLimitIsSaidWithItsFactor) {
    const Case building = case_of(physics::Quantity::gas);
    // With n - 1: 0.77 x 240 / 239 = 0.773; 2.4 MWh x 0.23 = 552 kWh; 1 / 0.23 = 4.35.
    EXPECT_EQ(bias_of(building, -0.77),
              "the bias of gas in training is -77.3 %, beyond the 10 % of Guideline 14 "
              "(metered 2.4 MWh, fitted 552 kWh: a factor of 4.35)");
    EXPECT_EQ(bias_of(building, 1.5),
              "the bias of gas in training is +151 %, beyond the 10 % of Guideline 14 "
              "(metered 2.4 MWh, fitted 6 MWh: a factor of 2.5)");
    EXPECT_EQ(bias_of(building, -1),
              "the bias of gas in training is -100 %, beyond the 10 % of Guideline 14 "
              "(metered 2.4 MWh, fitted 0 kWh)");
}

TEST(Bias, TheLimitIsThatOfTheGuidelineWithOneReadingLess) {
    const Case building = case_of(physics::Quantity::gas);
    EXPECT_EQ(bias_of(building, 0.099), "");   // 0.0994
    EXPECT_NE(bias_of(building, 0.0999), "");  // 0.1003
    EXPECT_EQ(bias_of(building, -0.099), "");
    EXPECT_EQ(bias_of(building, 0), "");
}

TEST(Bias, IsOfMetersWithATotalAndOfThePeriodOnly) {
    EXPECT_EQ(bias_of(case_of(physics::Quantity::air_temperature), 0.5), "");
    EXPECT_EQ(bias_of(case_of(physics::Quantity::gas, 0), 0.5), "");
    EXPECT_EQ(bias_of(case_of(physics::Quantity::gas, nan), 0.5), "");
    EXPECT_EQ(bias_of(case_of(physics::Quantity::gas), nan), "");
    const FoundFit held_out{1, 0, nan, 0.5, 0.5};
    EXPECT_EQ(bias_beyond(case_of(physics::Quantity::gas), 0, {&held_out, 1}), "");
}

TEST(Bias, AMeterThatShowsNextToNothingHasNone) {
    Case building = case_of(physics::Quantity::gas);
    building.meters.push_back(building.meters[0]);
    building.meters[1].name = "electricity";
    const auto said = [&](double reading, double nmbe) {
        building.meters[1].values.assign(building.meters[1].values.size(), reading);
        const FoundFit fits[] = {{0, 0, nan, 0.5, 0}, {0, 1, nan, 0.5, nmbe}};
        return bias_beyond(building, 0, fits);
    };
    EXPECT_EQ(said(0.01, 10), "");    // 2.4 and 26.4 kWh beside 2.4 MWh: 1.1 %
    EXPECT_NE(said(0.01, 20), "");    // 50.4 kWh: 2.1 %
    EXPECT_NE(said(0.21, -0.9), "");  // 50.4 kWh metered
}

TEST(Bias, SentencesAreJoinedWithoutEmptyOnes) {
    EXPECT_EQ(joined_sentences({}), "");
    EXPECT_EQ(joined_sentences({"", ""}), "");
    EXPECT_EQ(joined_sentences({"", "a", "", "b"}), "a; b");
}

}  // namespace
}  // namespace bemcal::study
