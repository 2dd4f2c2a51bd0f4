/// Edges of the rules for codes, spikes, negative use and registers, and made meters
/// without a fault, in which nothing is found.
#include "checks/data_values.hpp"
#include "checks/made_meters.hpp"
#include "checks/values.hpp"
#include "physics/calendar.hpp"

#include <gtest/gtest.h>

namespace bemcal::checks {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// 1 to 20 in tenths, again and again; the highest reading is 20.
std::vector<double> meter(int n = 1000) {
    std::vector<double> values;
    for (int k = 0; k < n; ++k) values.push_back(1 + (k * 37 % 191) / 10.0);
    return values;
}

std::vector<double> with(std::vector<double> values, double value,
                         const std::vector<std::size_t>& at) {
    for (const std::size_t k : at) values[k] = value;
    return values;
}

DataSeries of(const std::vector<double>& values, Driver driver = Driver::people) {
    return {values, 24, 0, 0, driver};
}

std::vector<double> codes(const std::vector<double>& values,
                          Driver driver = Driver::people) {
    std::vector<double> found;
    for (const Code& code : codes_in(of(values, driver))) found.push_back(code.value);
    return found;
}

using Values = std::vector<double>;

TEST(Codes, AreKnownNumbersApartFromTheReadings) {
    EXPECT_EQ(codes(with(meter(), -9999, {5, 400})), Values{-9999});
    EXPECT_EQ(codes(with(meter(), -1, {5})), Values{-1});
    EXPECT_EQ(codes(with(with(meter(), -999, {7}), 65535, {8, 9})),
              (Values{-999, 65535}));
    EXPECT_EQ(codes(with(meter(), 9999, {7})), Values{9999});
    EXPECT_TRUE(codes(meter()).empty());
}

TEST(Codes, NameTheReadingsThatTheyStandIn) {
    const Values values = with(meter(), -999, {3, 40, 41});
    EXPECT_EQ(codes_in(of(values))[0].at, (std::vector<int>{3, 40, 41}));
}

TEST(Codes, ThatAreReadTwiceNeedHalfAsMuchAgainAndOnceThreefold) {
    const auto scaled = [](double factor) {
        Values values = meter();
        for (double& value : values) value *= factor;
        return values;
    };
    const double edge_twice = 999 / 1.5 / 20, edge_once = 999 / 3.0 / 20;
    EXPECT_EQ(codes(with(scaled(edge_twice * 0.999), 999, {5, 9})), Values{999});
    EXPECT_TRUE(codes(with(scaled(edge_twice * 1.001), 999, {5, 9})).empty());
    EXPECT_EQ(codes(with(scaled(edge_once * 0.999), 999, {5})), Values{999});
    EXPECT_TRUE(codes(with(scaled(edge_once * 1.001), 999, {5})).empty());
}

TEST(Codes, AreNotReadingsOfAMeterThatReachesThem) {
    Values values = meter();
    for (double& value : values) value = 60 * value;  // to 1,200
    EXPECT_TRUE(codes(with(values, 999, {1, 2, 3})).empty());
}

TEST(Codes, AreNotTheFeedInOfAMeterInWholeNumbers) {
    Values values;
    for (int k = 0; k < 1000; ++k) values.push_back(k % 10 - 4);  // -4 to 5
    EXPECT_TRUE(codes(values).empty());
}

TEST(Codes, UnknownToTheTableStandTwentyfoldAboveAndAreReadThrice) {
    EXPECT_EQ(codes(with(meter(), 20 * 20, {5, 60, 700})), Values{400});
    EXPECT_TRUE(codes(with(meter(), 20 * 20 - 1, {5, 60, 700})).empty());
    EXPECT_TRUE(codes(with(meter(), 400, {5, 60})).empty());
    EXPECT_EQ(codes(with(with(meter(), 12345, {5, 60, 700}), 54321, {1, 2, 3})),
              (Values{12345, 54321}));
}

TEST(Codes, UnknownToTheTableAreATenthOfTheReadingsAtMost) {
    Values values;  // rounding beside 0, then use in whole numbers
    for (int k = 0; k < 1000; ++k) values.push_back(k % 10 == 0 ? 1e-13 : 5 + k % 7);
    EXPECT_TRUE(codes(values).empty());
    std::vector<std::size_t> tenth;
    for (std::size_t k = 0; k < 100; ++k) tenth.push_back(10 * k);
    EXPECT_EQ(codes(with(meter(), 12345, tenth)), Values{12345});
    tenth.push_back(15);
    EXPECT_TRUE(codes(with(meter(), 12345, tenth)).empty());
}

TEST(Codes, OfTemperaturesStandApartByWhatTheySpan) {
    Values values;  // 18 to 24
    for (int k = 0; k < 1000; ++k) values.push_back(18 + k % 61 / 10.0);
    EXPECT_EQ(codes(with(values, -127, {5}), Driver::temperature), Values{-127});
    EXPECT_EQ(codes(with(values, 85, {5, 6}), Driver::temperature), Values{85});
    EXPECT_EQ(codes(with(values, 0, {5, 6}), Driver::temperature), Values{0});
    Values winter;  // -3 to 3, through 0
    for (int k = 0; k < 1000; ++k) winter.push_back(-3 + k % 61 / 10.0);
    EXPECT_TRUE(codes(winter, Driver::temperature).empty());
}

/// A week around 20 degC, in another unit.
std::string doubt_of_room_in(double factor, double offset, bool is_as_read = true) {
    input::RegularSeries series;
    series.axis = {physics::parse_time("2021-01-01"), 3600, 168};
    for (int k = 0; k < 168; ++k)
        series.values.push_back((20 + (k % 13 - 6) / 3.0) * factor + offset);
    series.values[2] = missing;
    const auto question = doubt_of_room(series, is_as_read);
    return question ? question->text : "";
}

TEST(Rooms, AreNotInTenthsNorInAnotherUnit) {
    EXPECT_EQ(doubt_of_room_in(1, 0), "");
    EXPECT_EQ(doubt_of_room_in(1, -45), "") << "a cold store";
    EXPECT_EQ(doubt_of_room_in(1, 25), "") << "a hot hall";
    EXPECT_EQ(doubt_of_room_in(10, 0),
              "half of its readings lie above 200 degC: no air of a room. Write factor = "
              "0.1");
    EXPECT_EQ(doubt_of_room_in(1.8, 32),
              "half of its readings lie above 68 degC: no air of a room. Write unit = "
              "\"degF\"");
    EXPECT_EQ(doubt_of_room_in(1, 273.15),
              "half of its readings lie above 293.1 degC: no air of a room. Write unit = "
              "\"K\", or factor = 0.1");
    EXPECT_EQ(
        doubt_of_room_in(1, -273.15, false),
        "half of its readings lie below -253.1 degC: no air of a room. See unit and "
        "factor");
}

TEST(Rooms, ThatWereNotReadAreNotDoubted) {
    EXPECT_EQ(doubt_of_room_in(missing, 0), "");
}

TEST(Spikes, AreHoursFarAboveAllOthers) {
    EXPECT_EQ(spikes_in(of(with(meter(), 1e6, {400}))), std::vector<int>{400});
    EXPECT_EQ(spikes_in(of(with(with(meter(), 1e6, {400}), 70, {7}))),
              (std::vector<int>{7, 400}));
    EXPECT_TRUE(spikes_in(of(meter())).empty());
}

TEST(Spikes, BeginAtThreeTimesTheHighestOtherReading) {
    EXPECT_EQ(spikes_in(of(with(meter(), 60, {400}))), std::vector<int>{400});
    EXPECT_TRUE(spikes_in(of(with(meter(), 59.9, {400}))).empty());
}

TEST(Spikes, AreNotThreeInARow) {
    EXPECT_EQ(spikes_in(of(with(meter(), 1e4, {400, 401}))),
              (std::vector<int>{400, 401}));
    EXPECT_TRUE(spikes_in(of(with(meter(), 1e4, {400, 401, 402}))).empty());
}

TEST(Spikes, AreFewUnlessTheyAreVeryFar) {
    const std::vector<std::size_t> four{100, 300, 500, 700},
        sixteen{50,  150, 250,  350,  450,  550,  650,  750,
                850, 950, 1050, 1150, 1250, 1350, 1450, 1550};
    EXPECT_TRUE(spikes_in(of(with(meter(), 70, four))).empty());
    EXPECT_EQ(spikes_in(of(with(meter(8000), 21'000, sixteen))).size(), 16U);
    EXPECT_TRUE(spikes_in(of(with(meter(8000), 700, sixteen))).empty());
}

TEST(Spikes, AreNotTheFewUnitsOfACoarseMeter) {
    Values values;
    for (int k = 0; k < 1000; ++k) values.push_back(k % 3 == 0 ? 1 : 0);
    EXPECT_TRUE(spikes_in(of(with(values, 3, {400}))).empty());
    EXPECT_EQ(spikes_in(of(with(values, 300, {400}))), std::vector<int>{400});
}

TEST(Spikes, OfTemperaturesLieOnEitherSide) {
    Values values;
    for (int k = 0; k < 3000; ++k) values.push_back(18 + k % 61 / 10.0);
    values = with(with(values, 60, {40}), -30, {900});
    EXPECT_EQ(spikes_in(of(values, Driver::temperature)), (std::vector<int>{40, 900}));
}

TEST(Negatives, AreFewUpToAHundredthOfTheReadings) {
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < 10; ++k) at.push_back(90 * k);
    EXPECT_TRUE(negatives_in(of(with(meter(), -5, at))).are_few);
    at.push_back(950);
    EXPECT_FALSE(negatives_in(of(with(meter(), -5, at))).are_few);
    EXPECT_TRUE(negatives_in(of(with(meter(40), -5, {3}))).are_few);
}

TEST(Negatives, WithinAHundredthOfTheReachAreOffsets) {
    const Negatives found = negatives_in(of(with(with(meter(), -0.19, {4}), -0.21, {9})));
    EXPECT_EQ(found.offsets, std::vector<int>{4});
    EXPECT_EQ(found.others, std::vector<int>{9});
    EXPECT_TRUE(
        negatives_in(of(with(meter(), -5, {4}), Driver::temperature)).others.empty());
}

Values register_of(const Values& use, double start = 1000) {
    Values counts{start};
    for (const double value : use) counts.push_back(counts.back() + value);
    return counts;
}

TEST(Registers, RiseOnAndMetersDoNot) {
    EXPECT_TRUE(is_register(course_of(register_of(meter(24)))));
    EXPECT_FALSE(is_register(course_of(register_of(meter(23)))));
    EXPECT_FALSE(is_register(course_of(meter())));
    Values saw;
    for (int k = 0; k < 1000; ++k) saw.push_back(5 + k % 100);  // falls, but not to 0
    EXPECT_TRUE(is_register(course_of(saw)));                   // 1 % of all changes
    for (int k = 0; k < 1000; ++k) saw[static_cast<std::size_t>(k)] = 5 + k % 20;
    EXPECT_FALSE(is_register(course_of(saw)));
}

TEST(Registers, OfTheDayStartAgainAtMidnight) {
    Values day;
    for (int k = 0; k < 480; ++k) day.push_back(k % 24 * 2.0);
    EXPECT_TRUE(is_register(course_of(day)));
    const Values use = differences_of(day);
    EXPECT_EQ(use[0], 2);
    EXPECT_TRUE(std::isnan(use[23]));  // from 46 to 0: what was used has gone
    EXPECT_EQ(use[24], 2);
}

TEST(Registers, GiveTheUseBetweenTwoReadings) {
    const Values use = differences_of(Values{100, 103, 103, missing, 110, 111});
    EXPECT_EQ(use.size(), 5U);
    EXPECT_EQ(use[0], 3);
    EXPECT_EQ(use[1], 0);
    EXPECT_TRUE(std::isnan(use[2]));
    EXPECT_TRUE(std::isnan(use[3]));
    EXPECT_EQ(use[4], 1);
}

TEST(Registers, GoOnPastTheirFullNumber) {
    EXPECT_EQ(differences_of(Values{99'990, 99'998, 7, 15}), (Values{8, 9, 8}));
}

TEST(Registers, OfTheMonthAreNotTakenForFullOnes) {
    // 95 to 1: five to 100 and one on would be six, but steps count 1 at most.
    Values counts;
    for (int k = 0; k < 190; ++k) counts.push_back(1 + k % 95);
    EXPECT_EQ(differences_of(counts)[94], 1);
}

TEST(Registers, OfBillsRiseNineTimesAndNeverFall) {
    EXPECT_TRUE(is_register_of_bills({9, 0}));
    EXPECT_FALSE(is_register_of_bills({8, 0}));
    EXPECT_FALSE(is_register_of_bills({11, 1}));
}

TEST(Registers, ThatWereReplacedCountFromTheirNewStart) {
    EXPECT_EQ(differences_of(Values{5000, 5004, 2, 6}), (Values{4, 2, 4}));
    EXPECT_TRUE(std::isnan(differences_of(Values{5000, 5004, 4990, 4995})[1]));
}

TEST(Registers, ThatDipForAReadingHaveNoUseBesideIt) {
    const Values use = differences_of(Values{5000, 5004, 0, 5010, 5012});
    EXPECT_EQ(use[0], 4);
    EXPECT_TRUE(std::isnan(use[1]));
    EXPECT_TRUE(std::isnan(use[2]));
    EXPECT_EQ(use[3], 2);
}

TEST(MadeMeters, WithoutAFaultHaveNoCodeSpikeOrNegativeAndAreNoRegister) {
    for (std::uint64_t seed = 0; seed < 50; ++seed)
        for (const auto& made :
             {stats::made_electricity(seed, 365), stats::made_heat(seed, 365)}) {
            const DataSeries series = made.series();
            EXPECT_TRUE(codes_in(series).empty()) << seed;
            EXPECT_TRUE(spikes_in(series).empty()) << seed;
            EXPECT_TRUE(negatives_in(series).others.empty()) << seed;
            EXPECT_FALSE(is_register(course_of(series.values))) << seed;
        }
}

}  // namespace
}  // namespace bemcal::checks
