/// Irradiance on planes against published points and a year of pvlib at Denver.
#include "physics/sky.hpp"
#include "support/csv_table.hpp"
#include "support/epw_files.hpp"
#include "support/measured.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double deg = std::numbers::pi / 180;

struct PerezPoint {
    double tilt, zenith, azimuth, direct, diffuse, extraterrestrial,
        air_mass;  // [deg], [W/m2]
    double expected;
    double tolerance;  // relative
};

// pvlib tests/test_irradiance.py: test_perez, test_perez_scalar,
// test_perez_negative_horizon, planes facing south. The first and third are there with 2
// digits only.
const PerezPoint perez_points[] = {
    {40, 82.85457044, 66.71410338, 316.1949056, 40.46149818, 1321.1655834833, 7.58831596,
     31.46046871, 2e-4},
    {40, 10.56413562, 144.76567754, 939.95469881, 118.45831879, 1321.1655834833,
     1.01688136, 109.084332, 1e-6},
    {40, 72.41687122, 287.04104128, 646.22886049, 62.03376265, 1321.1655834833,
     3.27930443, 45.45539877, 2e-4},
    {34, 57.746951, 171.003315, 158, 249, 1414, 1.869315, 281.410185, 1e-6},
    {34, 57.564205, 187.346924, 19, 165, 1414, 1.859981, 152.20879, 1e-6},
    {34, 60.813841, 202.974357, 1, 136, 1414, 2.044429, 123.867898, 1e-6},
    {34, 66.989435, 216.725599, 0, 93, 1414, 2.544943, 82.836412, 1e-6},
    {34, 75.353368, 228.317233, 0, 50, 1414, 3.900136, 43.517015, 1e-6},
};

TEST(Perez, PublishedPoints) {
    double most = 0;
    for (const PerezPoint& p : perez_points) {
        const SunPosition sun{p.zenith * deg, p.azimuth * deg, p.extraterrestrial};
        const double sky = perez_sky(
            p.tilt * deg, cos_incidence(sun, p.tilt * deg, 180 * deg), p.zenith * deg,
            p.direct, p.diffuse, p.extraterrestrial, p.air_mass);
        EXPECT_NEAR(sky, p.expected, p.tolerance * p.expected);
        if (p.tolerance == 1e-6) most = std::max(most, std::abs(sky / p.expected - 1));
    }
    test::print_measured("Perez's sky, EnergyPlus's points, largest relative error", most,
                         "-", "1e-6");
}

TEST(Perez, HorizontalPlaneSeesTheWholeSky) {
    // With the sun above 5 deg the circumsolar part returns whole.
    for (double zenith : {0.0, 30.0, 60.0, 84.0}) {
        const double z = zenith * deg;
        EXPECT_NEAR(perez_sky(0, std::cos(z), z, 500, 100, 1367, air_mass(z)), 100,
                    1e-10);
    }
}

TEST(Perez, NoDiffuseNoSky) {
    EXPECT_EQ(perez_sky(1, 1, 1, 800, 0, 1367, 1.5), 0);
}

// Duffie and Beckman, Solar Engineering of Thermal Processes, example 2.16.1 (an hour in
// February on 60 degrees at latitude 40, in MJ/m2): of 0.244 of beam, 0.796 of diffuse
// and an anisotropy index of 0.104, 0.558 arrives as beam and from around the sun with
// R_b = 1.71. The rest of the sky is isotropic (their factor for the horizon is not Hay
// and Davies').
TEST(HayDavies, LightAroundTheSunOfDuffieAndBeckman) {
    constexpr double beam = 0.244, diffuse = 0.796, index = 0.104, R_b = 1.71;
    const double zenith = 60 * deg, cos_theta = R_b * std::cos(zenith);
    const double sky =
        hay_davies_sky(60 * deg, cos_theta, zenith, index * 1367, diffuse, 1367);
    const double isotropic = (1 - index) * diffuse * 0.75;
    EXPECT_NEAR(beam * R_b + sky - isotropic, 0.558, 0.001);
}

TEST(HayDavies, IsTheSkyOnTheGroundAndIsotropicWithoutBeam) {
    for (double z : {0.1, 0.7, 1.2})
        EXPECT_NEAR(hay_davies_sky(0, std::cos(z), z, 500, 100, 1367), 100, 1e-10);
    EXPECT_NEAR(hay_davies_sky(90 * deg, 0.5, 1, 0, 100, 1367), 50, 1e-10);
    EXPECT_EQ(hay_davies_sky(1, 1, 1, 800, 0, 1367), 0);
}

TEST(AirMass, KastenAndYoung) {
    // From the formula by hand: 1 / (0.5 + 0.50572 36.07995^-1.6364) at 60 deg.
    EXPECT_NEAR(air_mass(0), 0.99971, 1e-5);
    EXPECT_NEAR(air_mass(60 * deg), 1.99429, 1e-4);
    EXPECT_NEAR(air_mass(90 * deg), 37.92, 0.01);
    EXPECT_EQ(air_mass(100 * deg), air_mass(90 * deg));
}

TEST(PlaneIrradiance, GroundPartOfPvlib) {
    // pvlib tests/test_irradiance.py: test_get_ground_diffuse_simple_float
    const PlaneIrradiance at =
        irradiance_on({40 * deg, 0, {}}, {1, 0, 1367}, 0, 0, 900, 0.25);
    EXPECT_NEAR(at.ground, 26.32000014911496, 1e-6);
}

TEST(PlaneIrradiance, NothingBeamsFromBelowTheHorizonOrBehindThePlane) {
    const Plane south{90 * deg, 180 * deg, {}};
    EXPECT_EQ(irradiance_on(south, {91 * deg, 180 * deg, 1367}, 100, 10, 10, 0.2).beam,
              0);
    EXPECT_NEAR(irradiance_on(south, {91 * deg, 180 * deg, 1367}, 100, 10, 10, 0.2).sky,
                5, 1e-9);
    EXPECT_EQ(irradiance_on(south, {60 * deg, 0, 1367}, 500, 100, 350, 0.2).beam, 0);
}

TEST(PlaneIrradiance, ModifierActsOnTheBeamOnly) {
    const SunPosition sun{60 * deg, 180 * deg, 1367};
    const PlaneIrradiance plain =
        irradiance_on({90 * deg, 180 * deg, {}}, sun, 500, 100, 350, 0.2);
    const PlaneIrradiance half =
        irradiance_on({90 * deg, 180 * deg, {1, 0, -1}}, sun, 500, 100, 350, 0.2);
    EXPECT_NEAR(half.beam, plain.beam * (1 - std::pow(30 * deg, 2)), 1e-9);
    EXPECT_EQ(half.sky, plain.sky);
    EXPECT_EQ(half.ground, plain.ground);
}

TEST(PlaneIrradiance, LightFromAllSidesHasAModifierOfItsOwn) {
    const SunPosition sun{60 * deg, 180 * deg, 1367};
    Plane plane{90 * deg, 180 * deg, {}};
    for (const SkyModel model :
         {SkyModel::perez, SkyModel::isotropic, SkyModel::hay_davies}) {
        plane.diffuse_modifier = 1;
        const PlaneIrradiance all = irradiance_on(plane, sun, 500, 100, 350, 0.2, model);
        plane.diffuse_modifier = 0.8;
        const PlaneIrradiance less = irradiance_on(plane, sun, 500, 100, 350, 0.2, model);
        EXPECT_EQ(less.beam, all.beam);
        EXPECT_NEAR(less.sky, 0.8 * all.sky, 1e-12);
        EXPECT_NEAR(less.ground, 0.8 * all.ground, 1e-12);
    }
}

TEST(PlaneIrradiance, APlaneMayHaveASkyOfItsOwn) {
    const SunPosition sun{60 * deg, 180 * deg, 1367};
    Plane plane{90 * deg, 180 * deg, {}};
    const auto sky = [&](SkyModel model) {
        return irradiance_on(plane, sun, 500, 100, 350, 0.2, model).sky;
    };
    const double perez = sky(SkyModel::perez), own = sky(SkyModel::hay_davies);
    EXPECT_NE(perez, own);
    plane.sky = SkyModel::hay_davies;
    EXPECT_EQ(sky(SkyModel::perez), own);
}

TEST(PlaneIrradiance, IsotropicSkyDependsOnTiltOnly) {
    const SunPosition sun{60 * deg, 180 * deg, 1367};
    for (double azimuth : {0.0, 90.0, 180.0})
        EXPECT_NEAR(irradiance_on({90 * deg, azimuth * deg, {}}, sun, 500, 100, 350, 0.2,
                                  SkyModel::isotropic)
                        .sky,
                    50, 1e-12);
}

TEST(IrradianceSeries, AsksForCompleteWeather) {
    Weather weather;
    weather.axis = {parse_time("2021-01-01"), 3600, 2};
    weather.direct_normal = {1, 2};
    EXPECT_THROW(irradiance_series(weather, Plane{}), std::invalid_argument);
}

// A wall whose heat comes later: as much in all, its centre by the lag; two exponential
// stores in steps of an hour have it half a step each earlier.
TEST(IrradianceSeries, LaggedPlanesShowTheSameSunLater) {
    constexpr std::size_t n = 96, noon = 36;
    Weather weather;
    weather.axis = {parse_time("2021-06-01"), 3600, n};
    weather.direct_normal.assign(n, 0);
    weather.diffuse_horizontal.assign(n, 0);
    weather.global_horizontal.assign(n, 0);
    weather.theta_e.assign(n, 10);
    weather.diffuse_horizontal[noon] = weather.global_horizontal[noon] = 100;
    const Plane roof{0, 0, {}}, behind_roof{0, 0, {}, 8};
    const auto at_once = irradiance_series(weather, roof, SkyModel::isotropic),
               later = irradiance_series(weather, behind_roof, SkyModel::isotropic);
    double sum = 0, moment = 0;
    for (std::size_t k = 0; k < n; ++k) {
        sum += later[k];
        moment += later[k] * static_cast<double>(k);
    }
    EXPECT_NEAR(sum, at_once[noon], 1e-3 * at_once[noon]);
    EXPECT_NEAR(moment / sum - noon, 8 - 1, 0.1);
    EXPECT_EQ(later[noon - 1], 0);
}

TEST(IrradianceSeries, MissingWeatherStaysMissing) {
    Weather weather;
    weather.axis = {parse_time("2021-06-21 12:00"), 3600, 2};
    weather.direct_normal = weather.global_horizontal = {500, 500};
    weather.diffuse_horizontal = {100, std::numeric_limits<double>::quiet_NaN()};
    const std::vector<double> series = irradiance_series(weather, {90 * deg, 0, {}});
    EXPECT_FALSE(std::isnan(series[0]));
    EXPECT_TRUE(std::isnan(series[1]));
}

struct Facade {
    const char* name;  // as in the reference file
    double tilt, azimuth;
    double annual_tolerance;
};
constexpr Facade facades[] = {{"H_0", 0, 180, 0.005},   {"S_90", 90, 180, 0.005},
                              {"E_90", 90, 90, 0.005},  {"N_90", 90, 0, 0.01},
                              {"W_90", 90, 270, 0.005}, {"S_30", 30, 180, 0.005}};

struct Difference {
    double rmse = 0, most = 0, annual = 0;  // [W/m2], [W/m2], relative
};

/// A year of pvlib (SPA, Perez 1990) on the same weather; its sun stands at the hours'
/// middles.
class YearOfPvlib : public testing::Test {
  protected:
    void SetUp() override {
        const auto weather_file = test::shared_file("weather/725650TYCST.epw");
        const auto table_file = test::shared_file("thermal/solar_pvlib_denver_8760.csv");
        if (test::is_absent(weather_file)) GTEST_SKIP() << weather_file;
        if (test::is_absent(table_file)) GTEST_SKIP() << table_file;
        input::EpwOptions options;
        options.year = 2001;  // of that run
        weather = test::read_epw(weather_file, options).weather;
        table = test::CsvTable(table_file);
        ASSERT_EQ(table.n_rows(), 8760U);
    }

    /// Over all hours; `rmse` and `most` over those with `counts`.
    template <class Counts>
    Difference difference(const Facade& facade, const std::vector<double>& ours,
                          const std::string& sky, Counts counts) const {
        Difference d;
        double square = 0, sum = 0, expected = 0, n = 0;
        for (std::size_t k = 0; k < table.n_rows(); ++k) {
            const auto part = [&](const std::string& name) {
                return table.number(k, facade.name + name);
            };
            const double theirs = part("_beam") + part(sky) + part("_ground");
            sum += ours[k];
            expected += theirs;
            if (!counts(k)) continue;
            n += 1;
            square += std::pow(ours[k] - theirs, 2);
            d.most = std::max(d.most, std::abs(ours[k] - theirs));
        }
        d.rmse = std::sqrt(square / n);
        d.annual = sum / expected - 1;
        return d;
    }

    void compare(SunOfStep sun, SkyModel model, const std::string& sky, const char* what,
                 auto counts) const {
        const std::vector<StepSun> suns = step_suns(weather.site, weather.axis, sun);
        for (const Facade& facade : facades) {
            const Plane plane{facade.tilt * deg, facade.azimuth * deg, {}};
            const Difference d = difference(
                facade, irradiance_series(weather, suns, plane, model), sky, counts);
            const std::string plane_name = fmt::format("{}, {}", facade.name, what);
            test::print_measured("RMSE against pvlib, " + plane_name, d.rmse, "W/m2",
                                 "0.3");
            test::print_measured(
                "annual error against pvlib, " + plane_name, 100 * d.annual, "%",
                fmt::format("{}", 100 * facade.annual_tolerance).c_str());
            EXPECT_LE(d.rmse, 0.3) << facade.name;
            EXPECT_LE(std::abs(d.annual), facade.annual_tolerance) << facade.name;
        }
    }

    Weather weather;
    test::CsvTable table;
};

constexpr auto every_hour = [](std::size_t) { return true; };

TEST_F(YearOfPvlib, Perez) {
    compare(SunOfStep::middle, SkyModel::perez, "_perez", "Perez, all 8760 h",
            every_hour);
}

TEST_F(YearOfPvlib, Isotropic) {
    compare(SunOfStep::middle, SkyModel::isotropic, "_iso", "isotropic, all 8760 h",
            every_hour);
}

TEST_F(YearOfPvlib, PerezOverTheSunlitPartDiffersAtSunriseAndSunsetOnly) {
    const auto suns = step_suns(weather.site, weather.axis, SunOfStep::sunlit_part);
    const auto whole = [&](std::size_t k) {
        return suns[k].sunlit == 0 || suns[k].sunlit == 1;
    };
    compare(SunOfStep::sunlit_part, SkyModel::perez, "_perez",
            "sunlit part, hours without rise or set", whole);
}

TEST(IrradianceSeries, OtherProgramsAtDenver) {
    // ASHRAE 140 case 600, annual incident [kWh/m2]: EnergyPlus, ESP-r, TRNSYS
    const auto file = test::shared_file("weather/725650TYCST.epw");
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const Weather weather = test::read_epw(file).weather;
    const struct {
        double azimuth, mean;
    } expected[] = {{0, (438 + 432 + 440) / 3.0},
                    {90, (1062 + 1054 + 1068) / 3.0},
                    {180, (1370 + 1363 + 1384) / 3.0},
                    {270, (967 + 961 + 974) / 3.0}};
    for (const auto& [azimuth, mean] : expected) {
        double sum = 0;
        for (double v : irradiance_series(weather, {90 * deg, azimuth * deg, {}}))
            sum += v;
        EXPECT_NEAR(sum / 1000, mean, 0.03 * mean) << azimuth;
    }
}

}  // namespace
}  // namespace bemcal::physics
