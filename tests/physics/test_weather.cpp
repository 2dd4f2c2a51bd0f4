/// Irradiance that was not measured: decomposition, clear sky, clouds.
#include "physics/decomposition.hpp"
#include "physics/sun.hpp"
#include "physics/weather.hpp"
#include "support/csv_table.hpp"
#include "support/epw_files.hpp"
#include "support/measured.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double deg = std::numbers::pi / 180;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Series = std::vector<double>;

double sum(const Series& series) {
    double total = 0;
    for (double v : series) total += v;
    return total;
}

double rmse(const Series& a, const Series& b) {
    double square = 0;
    for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(square / static_cast<double>(a.size()));
}

TEST(HourMeans, OfValuesAtTheHoursEnds) {
    EXPECT_EQ(hour_means({10, 12, 20}), (Series{10, 11, 16}));
    EXPECT_EQ(hour_means({}), Series{});
}

/// Three days of an hour's sun each.
Weather three_days(double global, double direct, double diffuse) {
    Weather weather;
    weather.site = {50, 10, 1, 100, 0.2};
    weather.axis = {parse_time("2021-06-01"), 3600, 72};
    for (auto [series, noon] : {std::pair{&Weather::global_horizontal, global},
                                {&Weather::direct_normal, direct},
                                {&Weather::diffuse_horizontal, diffuse}}) {
        (weather.*series).assign(72, 0);
        for (const int day : {0, 1, 2})
            (weather.*series)[static_cast<std::size_t>(24 * day + 12)] =
                day == 1 ? noon : 90;
    }
    return weather;
}

// Of the second day: the others have all parts.
TEST(AbsentParts, AreThoseThatCannotBeZero) {
    Weather both = three_days(500, 0, 0);
    EXPECT_EQ(drop_absent_parts(both), std::vector<Seconds>{parse_time("2021-06-02")});
    EXPECT_TRUE(std::isnan(both.direct_normal[36]) &&
                std::isnan(both.diffuse_horizontal[36]));
    EXPECT_EQ(both.direct_normal[12], 90);

    Weather direct = three_days(500, 0, 449);  // 0.9 of the global is overcast
    EXPECT_EQ(drop_absent_parts(direct).size(), 1U);
    EXPECT_TRUE(std::isnan(direct.direct_normal[36]));
    EXPECT_EQ(direct.diffuse_horizontal[36], 449);
    Weather overcast = three_days(500, 0, 451);
    EXPECT_TRUE(drop_absent_parts(overcast).empty());

    Weather diffuse = three_days(500, 400, 0);
    EXPECT_EQ(drop_absent_parts(diffuse).size(), 1U);
    EXPECT_TRUE(std::isnan(diffuse.diffuse_horizontal[36]));
    // Known at night alone, where it is 0.
    Weather unknown = three_days(500, 400, nan);
    EXPECT_TRUE(drop_absent_parts(unknown).empty());
    Weather global = three_days(0, 400, 100);
    EXPECT_EQ(drop_absent_parts(global).size(), 1U);
    EXPECT_TRUE(std::isnan(global.global_horizontal[36]));
    Weather dark = three_days(0, 0, 0);
    EXPECT_TRUE(drop_absent_parts(dark).empty());
}

TEST(ClearSky, ValueOfPvlib) {
    // pvlib tests/test_clearsky.py, test_ineichen_scalar_input: zenith 10, air mass 1,
    // turbidity 3, extraterrestrial irradiance 1364 (its default), sea level.
    EXPECT_NEAR(clear_sky_global(10 * deg, 1364, 1, 0), 1038.159219, 1e-4);
    EXPECT_EQ(clear_sky_global(95 * deg, 1364, 38, 0), 0);
}

TEST(CloudySky, KastenAndCzeplak) {
    EXPECT_EQ(cloudy_sky_global(800, 0), 800);
    EXPECT_NEAR(cloudy_sky_global(800, 1), 200, 1e-12);
    EXPECT_NEAR(cloudy_sky_global(800, 0.5), 800 * (1 - 0.75 * std::pow(0.5, 3.4)),
                1e-12);
}

/// Two clear summer days at Denver with all parts in agreement.
Weather two_days() {
    Weather weather;
    weather.site = {39.83, -104.65, -7, 1650};
    weather.axis = {parse_time("2021-06-20"), 3600, 48};
    for (const StepSun& sun :
         step_suns(weather.site, weather.axis, SunOfStep::sunlit_part)) {
        const double height = std::cos(sun.position.zenith);
        weather.direct_normal.push_back(sun.sunlit > 0 ? 700 * height : 0);
        weather.diffuse_horizontal.push_back(sun.sunlit > 0 ? 100 * height : 0);
        weather.global_horizontal.push_back(weather.direct_normal.back() *
                                                std::max(height, 0.0) +
                                            weather.diffuse_horizontal.back());
    }
    return weather;
}

TEST(CompleteIrradiance, LeavesWhatIsThere) {
    const Weather before = two_days();
    Weather after = before;
    complete_irradiance(after);
    EXPECT_EQ(after.direct_normal, before.direct_normal);
    EXPECT_EQ(after.diffuse_horizontal, before.diffuse_horizontal);
    EXPECT_EQ(after.global_horizontal, before.global_horizontal);
}

TEST(CompleteIrradiance, TwoPartsGiveTheThird) {
    const Weather whole = two_days();
    for (auto part : {&Weather::global_horizontal, &Weather::diffuse_horizontal,
                      &Weather::direct_normal}) {
        Weather weather = whole;
        (weather.*part).clear();
        complete_irradiance(weather);
        for (std::size_t k = 0; k < 48; ++k)
            // A direct part is not derived from a sun below 5 deg.
            if (part != &Weather::direct_normal || whole.direct_normal[k] > 100) {
                EXPECT_NEAR((weather.*part)[k], (whole.*part)[k], 1e-9) << k;
            }
    }
}

TEST(CompleteIrradiance, PartsMakeUpTheWholeAndStayWithinBounds) {
    Weather weather = two_days();
    const Series global = weather.global_horizontal;
    weather.direct_normal.clear();
    weather.diffuse_horizontal.clear();
    // A reading at a low sun that no beam can explain.
    const auto suns = step_suns(weather.site, weather.axis, SunOfStep::sunlit_part);
    for (std::size_t k = 0; k < 48; ++k)
        if (suns[k].sunlit > 0 && suns[k].position.zenith > 80 * deg)
            weather.global_horizontal[k] = 300;
    complete_irradiance(weather);
    for (std::size_t k = 0; k < 48; ++k) {
        const double height = std::max(std::cos(suns[k].position.zenith), 0.0);
        EXPECT_NEAR(weather.direct_normal[k] * height + weather.diffuse_horizontal[k],
                    weather.global_horizontal[k], 1e-9)
            << k;
        EXPECT_GE(weather.direct_normal[k], 0);
        EXPECT_LE(weather.direct_normal[k], 1420);
        EXPECT_GE(weather.diffuse_horizontal[k], 0);
    }
}

TEST(CompleteIrradiance, CloudCoverAloneIsEnough) {
    Weather clear, overcast;
    clear.site = overcast.site = two_days().site;
    clear.axis = overcast.axis = two_days().axis;
    clear.cloud_cover.assign(48, 0);
    overcast.cloud_cover.assign(48, 1);
    complete_irradiance(clear);
    complete_irradiance(overcast);
    EXPECT_NEAR(sum(overcast.global_horizontal), 0.25 * sum(clear.global_horizontal),
                1e-6);
    EXPECT_GT(sum(clear.direct_normal), sum(clear.diffuse_horizontal));
    EXPECT_LT(sum(overcast.direct_normal), 0.2 * sum(overcast.diffuse_horizontal));
}

TEST(CompleteIrradiance, MissingAtNightIsZero) {
    Weather weather = two_days();
    weather.global_horizontal[0] = weather.direct_normal[1] =
        weather.diffuse_horizontal[2] = nan;
    complete_irradiance(weather);
    EXPECT_EQ(weather.global_horizontal[0], 0);
    EXPECT_EQ(weather.direct_normal[1], 0);
    EXPECT_EQ(weather.diffuse_horizontal[2], 0);
}

TEST(CompleteIrradiance, NamesTheFirstStepItCannotFill) {
    Weather weather = two_days();
    weather.diffuse_horizontal.clear();
    weather.global_horizontal[36] = nan;
    EXPECT_EQ(unknown_irradiance(weather), std::vector<int>{36});
    try {
        complete_irradiance(weather);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("2021-06-21 12:00:00"),
                  std::string::npos);
    }
}

TEST(Decomposition, FractionsOfErbs) {
    // Erbs, Klein and Duffie 1982, eq. 1, at clearness indices 0.1, 0.5 and 0.9
    const StepSun sun{{60 * deg, 0, 1400}, 1};
    EXPECT_NEAR(diffuse_from_global(70, sun), 70 * 0.991, 1e-9);
    EXPECT_NEAR(diffuse_from_global(350, sun), 350 * 0.65915, 1e-3);
    EXPECT_NEAR(diffuse_from_global(630, sun), 630 * 0.165, 1e-9);
    EXPECT_EQ(diffuse_from_global(10, {{95 * deg, 0, 1400}, 0}), 10);
}

struct Decomposed {
    double diffuse, direct;  // annual, relative to the file's
};

struct Limits {
    const char *diffuse, *direct;  // [%] as printed
};

/// A file's year with nothing but its global irradiance.
Decomposed decompose(const std::filesystem::path& file, const Limits& limits) {
    const Weather whole = test::read_epw(file).weather;
    Weather weather = whole;
    weather.direct_normal.clear();
    weather.diffuse_horizontal.clear();
    complete_irradiance(weather);
    const Decomposed d{
        sum(weather.diffuse_horizontal) / sum(whole.diffuse_horizontal) - 1,
        sum(weather.direct_normal) / sum(whole.direct_normal) - 1};
    const std::string of = " from global irradiance, " + file.filename().string();
    test::print_measured("annual diffuse" + of, 100 * d.diffuse, "%", limits.diffuse);
    test::print_measured("annual direct" + of, 100 * d.direct, "%", limits.direct);
    test::print_measured("RMSE of diffuse" + of,
                         rmse(weather.diffuse_horizontal, whole.diffuse_horizontal),
                         "W/m2", "");
    return d;
}

TEST(Decomposition, GoldenMeasuredIn2012) {
    const auto file = test::shared_file("weather/Golden_CO_2012_AMY.epw");
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const Decomposed d = decompose(file, {"5", "10"});
    EXPECT_LE(std::abs(d.diffuse), 0.05);
    EXPECT_LE(std::abs(d.direct), 0.10);
}

TEST(Decomposition, TypicalYears) {
    // Their irradiance comes from models itself: a plausibility check.
    for (const char* name : {"USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw",
                             "GBR_Birmingham.035340_IWEC.epw", "725650TYCST.epw"}) {
        const auto file = test::shared_file(std::string("weather/") + name);
        if (test::is_absent(file)) GTEST_SKIP() << file;
        EXPECT_LE(std::abs(decompose(file, {"10", ""}).diffuse), 0.10) << name;
    }
}

TEST(CloudySky, YearsOfMeasuredAndTypicalWeather) {
    for (const char* name : {"Golden_CO_2012_AMY.epw", "725650TYCST.epw",
                             "USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw",
                             "GBR_Birmingham.035340_IWEC.epw"}) {
        const auto file = test::shared_file(std::string("weather/") + name);
        if (test::is_absent(file)) GTEST_SKIP() << file;
        const Weather measured = test::read_epw(file).weather;
        Weather weather = measured;
        weather.direct_normal.clear();
        weather.diffuse_horizontal.clear();
        weather.global_horizontal.clear();
        complete_irradiance(weather);
        const double annual =
            sum(weather.global_horizontal) / sum(measured.global_horizontal) - 1;
        test::print_measured(std::string("annual global from cloud cover, ") + name,
                             100 * annual, "%", "20");
        EXPECT_LE(std::abs(annual), 0.2) << name;
    }
}

}  // namespace
}  // namespace bemcal::physics
