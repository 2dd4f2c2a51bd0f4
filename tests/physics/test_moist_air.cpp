/// Saturation against the published tables, humidity ratio and enthalpy by hand.
#include "physics/moist_air.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

struct Point {
    double theta, value;
};

/// ASHRAE Handbook Fundamentals 2017, chapter 1, table 3: pressure at saturation [Pa].
constexpr Point table_3[] = {
    {-20, 103.24}, {-5, 401.74}, {5, 872.6}, {25, 3169.7}, {50, 12351.3}};

}  // namespace

TEST(MoistAir, SaturationIsThatOfTheHandbooksTable) {
    double worst = 0;
    for (const auto& [theta, p] : table_3)
        worst = std::max(worst, std::fabs(saturation_pressure(theta) / p - 1));
    test::print_measured("saturation pressure off the table, relative", worst, "-",
                         "1e-4");
    EXPECT_LT(worst, 1e-4);
}

// IAPWS-IF97, table 35; IAPWS R14-08, check value at 230 K.
TEST(MoistAir, SaturationHasTheCheckValuesOfItsFormulas) {
    EXPECT_NEAR(saturation_pressure(300 - 273.15) / 3536.58941, 1, 1e-8);
    EXPECT_NEAR(saturation_pressure(500 - 273.15) / 2.63889776e6, 1, 1e-8);
    EXPECT_NEAR(saturation_pressure(230 - 273.15) / 8.94735, 1, 1e-6);
}

TEST(MoistAir, IceAndWaterMeetAtTheTriplePoint) {
    EXPECT_NEAR(saturation_pressure(0.0099999), saturation_pressure(0.01), 1e-3);
}

TEST(MoistAir, SaturatedAirGrowsAsItSays) {
    for (const double theta : {-12.0, 3.0, 12.0, 31.0}) {
        const double h = 1e-4;
        const double slope =
            (saturated_air(theta + h, 101325).w - saturated_air(theta - h, 101325).w) /
            (2 * h);
        EXPECT_NEAR(saturated_air(theta, 101325).per_kelvin / slope, 1, 1e-6) << theta;
    }
}

// The handbook's example 1: 40 degC and a humidity ratio of 0.0065 give 56.7 kJ/kg by eq.
// 30; at 101.325 kPa its vapour pressure is 1.0480 kPa by eq. 20.
TEST(MoistAir, EnthalpyAndHumidityRatioFollowTheirEquations) {
    EXPECT_NEAR(enthalpy(40, 0.0065), 1006 * 40 + 0.0065 * (2501e3 + 1860 * 40), 1e-9);
    EXPECT_NEAR(humidity_ratio(1048.0, 101325), 0.0065, 1e-5);
}

TEST(MoistAir, AtmosphereIsThatOfIso2533) {
    EXPECT_NEAR(standard_pressure(0), 101325, 1e-9);
    EXPECT_NEAR(standard_pressure(2000), 79495, 10);
}

}  // namespace bemcal::physics
