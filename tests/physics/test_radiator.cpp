#include "physics/radiator.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double kelvin = 273.15;

/// A power at other conditions than 60 K above the room.
struct NominalPoint {
    double power;                      ///< [W]
    double supply, flow_return, room;  ///< [degC]
};

double steady_return(const Radiator& radiator, const NominalPoint& point) {
    std::vector<double> elements(static_cast<std::size_t>(radiator.n_elements),
                                 point.room);
    advance(radiator, {point.supply, 1, point.room, point.room}, 1e5, elements);
    return elements.back();
}

/// The radiator that gives this power there in its steady state.
Radiator with_nominal_point(Radiator radiator, const NominalPoint& point) {
    radiator.most_flow = point.power / (4184 * (point.supply - point.flow_return));
    double low = 0, high = point.power * std::pow(60 / (point.flow_return - point.room),
                                                  radiator.exponent);
    for (int k = 0; k < 60; ++k) {
        radiator.power_60 = (low + high) / 2;
        (steady_return(radiator, point) > point.flow_return ? low : high) =
            radiator.power_60;
    }
    return radiator;
}

/// The example of modelica-buildings' RadiatorEN442_2: 500 W at 40/30/20 degC, 18.655
/// kJ/K, five elements.
Radiator example() {
    Radiator radiator;
    radiator.exponent = 1.24;
    radiator.radiative_fraction = 0.35;
    radiator.capacity = 18655;
    static const Radiator found = with_nominal_point(radiator, {500, 40, 30, 20});
    return found;
}

/// Steps of 108 s from 20 degC: supply at 40 degC, no flow after an hour.
class Warming {
  public:
    double heat_at(double seconds) {
        advance_to(seconds);
        const double ua = transmittance_of(radiator_) / 5;
        double sum = 0;
        for (const double element : elements_)
            sum += ua * std::pow(std::max(element - 20, 0.0), radiator_.exponent);
        return sum;
    }
    double return_temperature() const { return elements_.back(); }

  private:
    void advance_to(double seconds) {
        if (time_ < 3600 && seconds > 3600) advance_to(3600);
        advance(radiator_, {40, time_ < 3600 ? 1.0 : 0.0, 20, 20}, seconds - time_,
                elements_);
        time_ = seconds;
    }
    Radiator radiator_ = example();
    std::vector<double> elements_ = std::vector<double>(5, 20);
    double time_ = 0;
};

/// Dymola's results for that example, as published with the library.
TEST(Radiator, FollowsTheDynamicModelicaRadiator) {
    Warming radiator;
    const std::pair<double, double> published[] = {
        {108, 178.9},  {216, 328.6},  {324, 423.6}, {540, 490.0}, {1080, 500.0},
        {3780, 324.9}, {4320, 107.1}, {5400, 19.8}, {6480, 5.6}};
    for (const auto& [seconds, watts] : published)
        EXPECT_NEAR(radiator.heat_at(seconds), watts, 2) << seconds;
}

TEST(Radiator, FollowsEveryRowOfTheModelicaTrajectory) {
    const auto file = test::shared_file("thermal/radiator_modelica_step.csv");
    if (test::is_absent(file)) GTEST_SKIP() << file << " is absent";
    const test::CsvTable table(file);
    Warming radiator;
    double worst_heat = 0, worst_return = 0;
    for (std::size_t r = 0; r < table.n_rows(); ++r) {
        const double seconds = table.number(r, "time_s");
        const double heat = radiator.heat_at(seconds);
        worst_heat = std::max(worst_heat, std::abs(heat + table.number(r, "Q_flow_W")));
        if (seconds <= 3600)
            worst_return =
                std::max(worst_return, std::abs(radiator.return_temperature() + kelvin -
                                                table.number(r, "T_out_K")));
    }
    test::print_measured("radiator against Modelica, heat", worst_heat, "W", "2");
    test::print_measured("radiator against Modelica, return", worst_return, "K", "0.1");
    EXPECT_GT(table.n_rows(), 90U);
    EXPECT_LE(worst_heat, 2);
    EXPECT_LE(worst_return, 0.1);
}

TEST(Radiator, HasTheTransmittanceOfItsNominalPoint) {
    EXPECT_NEAR(transmittance_of(example()), 20.0367, 0.02);
}

TEST(Radiator, KeepsTheEnergyBalance) {
    Radiator radiator;
    std::vector<double> elements{30, 25, 22, 50, 18};
    const double before = 30 + 25 + 22 + 50 + 18;
    const RadiatorHeat heat = advance(radiator, {60, 0.4, 19, 17}, 600, elements);
    double after = 0;
    for (const double element : elements) after += element;
    const double stored = radiator.capacity / 5 * (after - before);
    EXPECT_NEAR(stored, 600 * (heat.from_water - heat.convective - heat.radiative),
                1e-6 * std::abs(stored));
    EXPECT_GT(heat.radiative, 0);
}

TEST(Radiator, GivesItsPowerAtSixtyKelvinWithMuchWater) {
    Radiator radiator;
    radiator.most_flow = 100;
    std::vector<double> elements(5, 20);
    advance(radiator, {80, 1, 20, 20}, 3600, elements);
    const RadiatorHeat heat = advance(radiator, {80, 1, 20, 20}, 60, elements);
    EXPECT_NEAR(heat.convective + heat.radiative, radiator.power_60, 5);
    EXPECT_NEAR(heat.radiative, 0.3 * radiator.power_60, 2);
}

TEST(Radiator, EndsTheSameInOneStepAndInMany) {
    const Radiator radiator;
    std::vector<double> one(5, 20), many(5, 20);
    advance(radiator, {55, 1, 20, 20}, 600, one);
    for (int k = 0; k < 60; ++k) advance(radiator, {55, 1, 20, 20}, 10, many);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(one[i], many[i], 0.02);
}

TEST(Radiator, StaysAtRoomTemperatureWithoutFlow) {
    std::vector<double> elements(5, 20);
    const RadiatorHeat heat = advance({}, {70, 0, 20, 20}, 3600, elements);
    EXPECT_EQ(elements, std::vector<double>(5, 20));
    EXPECT_EQ(heat.convective, 0);
}

TEST(Radiator, IsRefusedWithoutFlowPowerOrCapacity) {
    EXPECT_STREQ(complaint_about({}), "");
    EXPECT_STREQ(complaint_about({.most_flow = 0}),
                 "a radiator needs a positive maximum flow");
    EXPECT_STREQ(complaint_about({.power_60 = -1}),
                 "a radiator needs a positive nominal power");
    EXPECT_STREQ(complaint_about({.capacity = 0}),
                 "a radiator needs a positive capacity");
    EXPECT_STREQ(complaint_about({.n_elements = 0}), "a radiator needs an element");
}

/// Paper 2, eq. 10-12 with the calibrated values of Table 4.
TEST(HeatingCurve, IsThatOfPaper2) {
    HeatingCurve curve;
    curve.a = -1.238;
    curve.b = 48.077;
    curve.c = 35.336;
    curve.d = 20.7;
    EXPECT_DOUBLE_EQ(supply_temperature(curve, true, 0, 20).value(), 48.077);
    EXPECT_DOUBLE_EQ(supply_temperature(curve, true, -5, 20).value(), 48.077 + 5 * 1.238);
    EXPECT_DOUBLE_EQ(supply_temperature(curve, true, 12, 20).value(), 35.336);
    EXPECT_FALSE(supply_temperature(curve, false, 0, 14.5).has_value());
    EXPECT_DOUBLE_EQ(supply_temperature(curve, false, 0, 13.5).value(), 20.7);
}

}  // namespace
}  // namespace bemcal::physics
