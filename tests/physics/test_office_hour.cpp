#include "physics/office_hour.hpp"
#include "physics/simulate.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

using Inputs = std::vector<double>;

std::size_t number_of(const std::string& name) {
    const auto inputs = office_hour_inputs();
    for (std::size_t k = 0; k < inputs.size(); ++k)
        if (inputs[k].name == name) return k;
    throw std::out_of_range(name);
}

Inputs middle() {
    Inputs values;
    for (const auto& input : office_hour_inputs())
        values.push_back((input.least + input.most) / 2);
    return values;
}

Inputs with(Inputs values, const std::string& name, double value) {
    values[number_of(name)] = value;
    return values;
}

TEST(OfficeHour, HasTheNineteenInputsOfTable2) {
    const auto inputs = office_hour_inputs();
    ASSERT_EQ(inputs.size(), 19U);
    EXPECT_STREQ(inputs[0].name, "GFA");
    EXPECT_STREQ(inputs[13].name, "theta_prev");
    for (const auto& input : inputs) EXPECT_LT(input.least, input.most) << input.name;
    EXPECT_EQ(inputs[15].most, 26.7);  // printed "267"
    EXPECT_EQ(inputs[13].least, 12);   // printed with its ends exchanged
}

/// The same office described in words, for the general model.
Building office_in_words(const Inputs& v) {
    const double deg = std::numbers::pi / 180, storeys = v[0] / (v[1] * v[2]);
    Building building;
    building.constructions = {{"wall", {v[7], 0, -1}}, {"roof", {v[8], 0, -1}}};
    building.glazings.resize(1);
    building.glazings[0].u_value.value = v[6];
    building.glazings[0].solar_transmittance.value = 0.75;
    Zone zone;
    zone.floor_area = v[0];
    zone.volume = v[0] * v[3];
    for (int side = 0; side < 4; ++side) {
        const double area = (side % 2 == 0 ? v[1] : v[2]) * v[3] * storeys;
        const int plane =
            building.plane_index({90 * deg, (180 + v[5] + 90 * side) * deg, {}});
        zone.surfaces.push_back(
            {"", 0, (1 - v[4]) * area, outdoors, 1, true, plane, {1, 0, -1}});
        zone.windows.push_back({"", 0, v[4] * area, plane, {1, 0, -1}});
    }
    const int roof = building.plane_index({0, 0, {}});
    zone.surfaces.push_back({"", 1, v[1] * v[2], outdoors, 1, true, roof, {1, 0, -1}});
    zone.flows = {{"ventilation", {v[9], 0, -1}, {0.6, 0, -1}, outdoors}};
    zone.loads = {{"gains", {v[18], 0, -1}}};
    zone.thermostat.heating_set_point.value = v[14];
    zone.thermostat.cooling_set_point.value = v[15];
    building.zones = {zone};
    return building;
}

Weather hour_of_weather(const Inputs& v) {
    using namespace std::chrono;
    Weather weather;
    weather.site = {23.13, 113.3, 8, 20, 0.2};
    weather.axis = {sys_days{year{2021} / January / 1} +
                        days(static_cast<int>(v[16]) - 1) +
                        hours(static_cast<int>(v[17])),
                    3600, 1};
    const double zenith =
        sun_position(weather.site, weather.axis.start + minutes(30)).zenith;
    weather.theta_e = {v[12]};
    weather.direct_normal = {v[11]};
    weather.diffuse_horizontal = {v[10]};
    weather.global_horizontal = {v[10] + v[11] * std::cos(zenith)};
    return weather;
}

// One noon each in winter, spring and summer: the same network, sun and sky as a
// building's.
TEST(OfficeHour, IsOneStepOfTheGeneralModel) {
    for (const double day : {21.0, 110.0, 202.0}) {
        Inputs v = with(with(middle(), "DayNum", day), "HourNum", 11);
        v = with(with(v, "theta_ext", day > 100 ? 34 : 8), "theta_prev",
                 day > 100 ? 30 : 15);
        const Building building = office_in_words(v);
        const Weather weather = hour_of_weather(v);
        Drive drive = make_drive(weather, building, {}, weather.axis.start,
                                 weather.axis.end(), 3600, 0, SkyModel::isotropic);
        drive.theta_start = v[number_of("theta_prev")];
        const Trajectory trajectory = simulate(building, drive);
        const double expected =
            (trajectory.zones[0].heating[0] + trajectory.zones[0].cooling[0]) / 1000;
        ASSERT_GT(expected, 0);
        EXPECT_NEAR(office_hour_energy(v) / expected, 1, 1e-9) << "day " << day;
    }
}

TEST(OfficeHour, HasNoBeamAtNight) {
    const Inputs night = with(middle(), "HourNum", 1);
    EXPECT_EQ(office_hour_energy(with(night, "DNI", 0)),
              office_hour_energy(with(night, "DNI", 795)));
    const Inputs noon = with(with(middle(), "HourNum", 12), "theta_prev", 30);
    EXPECT_LT(office_hour_energy(with(noon, "DNI", 0)),
              office_hour_energy(with(noon, "DNI", 795)));
}

// Twice the storeys on the same plan: twice the walls, floor and gains, the same roof.
// Diffuse irradiance as high as the inputs allow while the sun is at the horizon: the
// gain through the windows stays below what falls on them.
TEST(OfficeHour, StaysInProportionWithTheSunAtTheHorizon) {
    const Inputs v = with(with(middle(), "DHI", 581), "theta_prev", 30);
    const double noon = office_hour_energy(with(v, "HourNum", 11.5));
    for (double hour = 4; hour < 8; hour += 0.05)
        EXPECT_LT(office_hour_energy(with(v, "HourNum", hour)), 1.2 * noon) << hour;
}

TEST(OfficeHour, GrowsWithTheStoreys) {
    Inputs v = with(with(middle(), "theta_prev", 34), "U_roof", 1e-9);
    v = with(with(v, "HourNum", 1), "DHI", 0);  // nor sun on the roof
    EXPECT_NEAR(office_hour_energy(with(v, "GFA", 100000)),
                2 * office_hour_energy(with(v, "GFA", 50000)), 1e-4);
}

TEST(OfficeHour, NeedsNoEnergyBetweenTheSetPoints) {
    Inputs v = with(with(middle(), "theta_prev", 22), "theta_ext", 22);
    v = with(with(with(v, "DHI", 0), "DNI", 0), "phi_int", 5);
    v = with(with(v, "theta_H_set", 18), "theta_C_set", 26);
    EXPECT_EQ(office_hour_energy(v), 0);
}

TEST(OfficeHour, IsUnknownForLessThanOneStorey) {
    EXPECT_TRUE(std::isnan(office_hour_energy(with(middle(), "GFA", 2000))));
}

}  // namespace
}  // namespace bemcal::physics
