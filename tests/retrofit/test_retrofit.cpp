#include "base/nan.hpp"
#include "job/small_office.hpp"
#include "retrofit/retrofit.hpp"
#include "study/find.hpp"
#include "study/sampled_shapes.hpp"
#include "study/small_case.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using physics::Quantity;

retrofit::ScenarioChange change(const Case& building, const char* path,
                                retrofit::ChangeBy by, double amount) {
    return {physics::resolve(building.building, path), by, amount};
}

/// A room without sun, gains and sky in a constant cold, always heated: its heating
/// follows from its conductances alone.
Case steady_case() {
    Case made = test::small_case();
    for (double& theta : made.weather.theta_e) theta = 2;
    for (auto* sun : {&made.weather.direct_normal, &made.weather.diffuse_horizontal,
                      &made.weather.global_horizontal})
        std::ranges::fill(*sun, 0.0);
    physics::Zone& zone = made.building.zones[0];
    zone.loads.clear();
    zone.sky_temperature_difference = 0;
    zone.thermostat.heating_set_point = {20, 0, -1};
    made.building.plant.heating_efficiency = {0.8, 0, -1};
    made.parameters = {
        test::parameter(made.building, "zone.office.flow.air.air_change", 0.3, 1.5, 0.8),
        test::parameter(made.building, "construction.wall.u_value", 0.2, 1.5, 0.6)};
    made.priors.clear();
    return made;
}

/// Steady heating of the 5R1C network [W]: H_tr,is in series with H_w + H_op, beside
/// H_ve (ISO 13790, Annex C; H_tr,em and H_tr,ms in series are H_op).
double steady_heating(const Case& building, double u_value, double air_change) {
    const physics::Zone& zone = building.building.zones[0];
    const double h_opaque = u_value * zone.surfaces[0].area;
    const double h_windows =
        building.building.glazings[0].u_value.value * zone.windows[0].area;
    const double h_is = zone.surface_film * zone.surface_area_ratio * zone.floor_area;
    const double h_air = 1200 * zone.volume * air_change / 3600;
    return (1 / (1 / h_is + 1 / (h_opaque + h_windows)) + h_air) * (20 - 2);
}

/// What the stage "house/fit" found. \param rows  [points][parameters]
Summary points(std::vector<std::string> parameters,
               const std::vector<std::vector<double>>& rows) {
    Summary found;
    found.study = "house/fit";
    found.points.rows = Matrix(0, parameters.size());
    found.points.parameters = std::move(parameters);
    for (const auto& row : rows) {
        ++found.points.rows.rows;
        found.points.rows.values.insert(found.points.rows.values.end(), row.begin(),
                                        row.end());
    }
    return found;
}

/// A posterior's draws.
std::vector<Summary> draws(const std::vector<double>& air_change,
                           const std::vector<double>& u_value) {
    std::vector<std::vector<double>> rows;
    for (std::size_t r = 0; r < air_change.size(); ++r)
        rows.push_back({air_change[r], u_value[r]});
    return {
        points({"zone.office.flow.air.air_change", "construction.wall.u_value"}, rows)};
}

std::vector<Dataset> results_of(const Case& building,
                                const retrofit::RetrofitOptions& options,
                                const std::vector<Summary>& found) {
    const auto stage =
        retrofit::make_retrofit("retrofit", building, building.periods[0], options);
    stage->see(found);
    std::vector<ItemAnswer> answers;
    for (int k = 0; k < stage->n_items(); ++k) answers.push_back(stage->run(k));
    while (const auto round = stage->next_round(answers)) {
        const auto first = static_cast<int>(answers.size());
        stage->begin_round(first, *round);
        for (int k = 0; k < round->n_items; ++k) answers.push_back(stage->run(first + k));
    }
    EXPECT_EQ(stage->shortfall(answers), "");
    return stage->conclude(answers).datasets;
}

retrofit::RetrofitOptions options_of(std::vector<retrofit::Scenario> scenarios) {
    retrofit::RetrofitOptions options;
    options.scenarios = std::move(scenarios);
    options.of = "house/fit";
    return options;
}

constexpr std::size_t n_outputs = 7;
enum Column { heating, cooling, electricity, gas, district, too_cold, too_warm };

TEST(Retrofit, SavesWhatTheConductancesSay) {
    const Case house = steady_case();
    const retrofit::Scenario scenario{"insulated and tight",
                                      {change(house, "construction.wall.u_value",
                                              retrofit::ChangeBy::resistance, 0.1 / 0.04),
                                       change(house, "zone.office.flow.air.air_change",
                                              retrofit::ChangeBy::factor, 0.5)},
                                      {}};
    const std::vector<double> air{0.4, 0.8, 1.2}, u{0.5, 0.7, 1.0};
    const auto results = results_of(house, options_of({scenario}), draws(air, u));
    const auto &before = test::find(results, "before").values,
               &after = test::find(results, "after").values;
    const double hours =
        static_cast<double>((house.periods[0].to - house.periods[0].from).count()) /
        3.6e6;
    for (std::size_t r = 0; r < air.size(); ++r) {
        const double was = steady_heating(house, u[r], air[r]) * hours;
        const double is =
            steady_heating(house, 1 / (1 / u[r] + 0.1 / 0.04), air[r] / 2) * hours;
        EXPECT_NEAR(before[r * n_outputs + heating], was, 1e-4 * was);
        EXPECT_NEAR(after[r * n_outputs + heating], is, 1e-4 * is);
        EXPECT_NEAR(before[r * n_outputs + gas], was / 0.8, 1e-4 * was);
    }
    const auto& saving = test::find(results, "saving_quantile").values;
    EXPECT_NEAR(saving[n_outputs + heating],
                before[n_outputs + heating] - after[n_outputs + heating], 1e-9);
}

TEST(Retrofit, AScenarioWithoutChangesSavesExactlyNothing) {
    Case office = test::small_case();
    office.priors.clear();
    std::vector<std::string> names;
    for (const auto& parameter : office.parameters) names.push_back(parameter.name);
    std::vector<std::vector<double>> rows(70);
    for (int r = 0; r < 70; ++r)
        for (const auto& parameter : office.parameters)
            rows[static_cast<std::size_t>(r)].push_back(
                parameter.least + (parameter.most - parameter.least) * r / 70.0);
    const auto results =
        results_of(office, options_of({{"nothing", {}, {}}}), {points(names, rows)});
    const auto &before = test::find(results, "before").values,
               &after = test::find(results, "after").values;
    ASSERT_EQ(before.size(), 70 * n_outputs);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(before[k], after[k]);
    EXPECT_GT(before[electricity], 0);
    for (const double saved : test::find(results, "saving_quantile").values)
        EXPECT_EQ(saved, 0);
    for (const double saved : test::find(results, "saving_share_quantile").values)
        EXPECT_EQ(saved, 0);
}

/// Of the first point, before and after half of an effect.
std::vector<double> halved(const Case& building, const std::string& effect,
                           const std::vector<Summary>& found) {
    const retrofit::Scenario half{
        "half", {change(building, effect.c_str(), retrofit::ChangeBy::factor, 0.5)}, {}};
    const auto results = results_of(building, options_of({half}), found);
    std::vector<double> both;
    for (const char* name : {"before", "after"}) {
        const auto& values = test::find(results, name).values;
        both.insert(both.end(), values.begin(), values.begin() + n_outputs);
    }
    return both;
}

void expect_alike(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_NEAR(found[k], expected[k], 1e-9 * (1 + expected[k])) << k;
    EXPECT_GT(std::abs(expected[cooling] - expected[n_outputs + cooling]), 1);
}

/// Names of parameters that stay are of no point.
const std::vector<Summary> as_described{points({"none"}, {{0}})};

/// A draw's function, and half of it, are those that are declared so.
TEST(Retrofit, AFunctionThatWasSampledIsScaledAsAWhole) {
    const auto office = [](const std::vector<double>& values, double spread) {
        return job::small_office_with(job::effect_that_follows("gains", values, spread));
    };
    std::vector<double> values{1, 0, 2, 1};
    const Case made = office(values, 0.5);
    std::vector<SampledFunction> functions;
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    const std::string name = functions.at(0).name;
    for (std::size_t p = 0; p < values.size(); ++p)
        values[p] += 1.5 * functions[0].columns(p, 0) - 0.5 * functions[0].columns(p, 1);
    expect_alike(halved(sampled, "effect.use",
                        {points({name + " 1", name + " 2"}, {{1.5, -0.5}})}),
                 halved(office(values, 0), "effect.use", as_described));
}

/// A step that began two days after the one declared brings nothing on them.
TEST(Retrofit, AStepWhoseDayWasSampledIsScaledAsAWhole) {
    const auto office = [](const char* since, const char* within) {
        return job::small_office_with(fmt::format(
            "[[effect]]\nname = \"tenant\"\nhook = \"gains\"\ndriver = \"time "
            "elapsed\"\nsince = \"{}\"\ncoefficient = 8\n{}",
            since, within));
    };
    const Case made = office("2021-01-12", "since_within = 2\n");
    std::vector<SampledFunction> functions;
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    expect_alike(halved(sampled, "effect.tenant",
                        {points({"tenant: day 0", "tenant: day 1"}, {{0, 0}})}),
                 halved(office("2021-01-14", ""), "effect.tenant", as_described));
}

/// A boiler's part load after a measure is that of the building after it.
TEST(Retrofit, LoadsThatAnEffectFollowsAreThoseOfEachSide) {
    Case made = job::small_office_with(
        "[[effect]]\nname = \"part-load efficiency of heating\"\nfull_load = 30\n"
        "form = \"linear\"\ncoefficient = 0.8\n");
    std::erase_if(made.parameters,
                  [](const auto& one) { return one.name == "infiltration"; });
    made.priors.clear();
    const char* leaks = "zone.office.flow.infiltration.air_change";
    const retrofit::ScenarioChange tight =
        change(made, leaks, retrofit::ChangeBy::value, 0.3);
    const auto results =
        results_of(made, options_of({{"tight", {tight}, {}}}), as_described);
    Case after = made;
    physics::number_at(after.building, tight.targets.at(0)) = 0.3;
    const auto of_after =
        results_of(after, options_of({{"nothing", {}, {}}}), as_described);
    const auto &found = test::find(results, "after").values,
               &expected = test::find(of_after, "before").values;
    for (std::size_t k = 0; k < n_outputs; ++k)
        EXPECT_NEAR(found[k], expected[k], 1e-9 * (1 + expected[k])) << k;
    const auto& before = test::find(results, "before").values;
    EXPECT_GT(before[heating], 1.1 * found[heating]);
    EXPECT_LT(found[heating] / found[gas], 0.99 * before[heating] / before[gas]);
}

TEST(Retrofit, AHeatPumpMovesHeatingToAnotherMeter) {
    const Case house = steady_case();
    retrofit::Scenario pump{
        "heat pump",
        {change(house, "plant.heating_efficiency", retrofit::ChangeBy::value, 3)},
        physics::Carrier::electricity};
    const auto results = results_of(house, options_of({pump}), draws({0.5}, {0.6}));
    const auto& after = test::find(results, "after").values;
    EXPECT_EQ(after[gas], 0);
    EXPECT_NEAR(after[electricity], after[heating] / 3, 1e-9 * after[heating]);
}

TEST(Retrofit, CountsOccupiedHoursOutsideTheLimits) {
    Case house = steady_case();
    const retrofit::Scenario colder{
        "colder",
        {change(house, "zone.office.heating_set_point", retrofit::ChangeBy::offset, -2)},
        {}};
    retrofit::RetrofitOptions options = options_of({colder});
    options.too_cold = 19;
    const double hours =
        static_cast<double>((house.periods[0].to - house.periods[0].from).count()) / 3600;
    auto results = results_of(house, options, draws({0.5}, {0.6}));
    EXPECT_EQ(test::find(results, "before").values[too_cold], 0);
    EXPECT_EQ(test::find(results, "after").values[too_cold], hours);
    options.too_cold = 18;  // held but for rounding
    options.too_warm = 17;
    results = results_of(house, options, draws({0.5}, {0.6}));
    EXPECT_EQ(test::find(results, "after").values[too_cold], 0);
    EXPECT_EQ(test::find(results, "after").values[too_warm], hours);
    options.occupied_profile = 0;  // ten hours of weekdays
    results = results_of(house, options, draws({0.5}, {0.6}));
    const double occupied = test::find(results, "after").values[too_warm];
    EXPECT_GT(occupied, 0.2 * hours);
    EXPECT_LT(occupied, 0.45 * hours);
}

TEST(Retrofit, APointBeyondTheMethodFailsWithItsReason) {
    const Case house = steady_case();
    const retrofit::Scenario scenario{
        "tripled",
        {change(house, "construction.wall.u_value", retrofit::ChangeBy::factor, 10)},
        {}};
    const auto results =
        results_of(house, options_of({scenario}), draws({0.5, 0.5}, {0.6, 1.2}));
    EXPECT_EQ(test::find(results, "n_failed").values[0], 1);
    EXPECT_EQ(test::find(results, "failed_reason").texts[0],
              "tripled: u_value would be 12; expected 0 to 10 W/(m2 K)");
    EXPECT_FALSE(std::isnan(test::find(results, "before").values[n_outputs]))
        << "other scenarios keep the point";
    EXPECT_TRUE(std::isnan(test::find(results, "after").values[n_outputs]));
}

TEST(Retrofit, CostsAndEmitsWhatItsMetersSay) {
    Case house = steady_case();
    Meter gas{"gas", Quantity::gas, physics::Interval::hourly, {}, {}};
    gas.tariff = 0.1;
    gas.co2 = 0.2;
    Meter power{"power", Quantity::electricity, physics::Interval::hourly, {}, {}};
    power.tariff = 0.3;
    house.meters = {gas, power};
    const retrofit::Scenario halved{
        "halved",
        {change(house, "construction.wall.u_value", retrofit::ChangeBy::factor, 0.5)},
        {}};
    const auto results = results_of(house, options_of({halved}), draws({0.5}, {0.6}));
    EXPECT_EQ(test::find(results, "output").texts[n_outputs], "cost");
    EXPECT_EQ(test::find(results, "output").texts[n_outputs + 1], "CO2");
    const auto after = test::find(results, "after").values;
    ASSERT_EQ(after.size(), n_outputs + 2);
    EXPECT_GT(after[Column::gas], 0);
    EXPECT_DOUBLE_EQ(after[n_outputs],
                     0.1 * after[Column::gas] + 0.3 * after[electricity]);
    EXPECT_DOUBLE_EQ(after[n_outputs + 1], 0.2 * after[Column::gas]);
    Meter unpriced{"another", Quantity::gas, physics::Interval::hourly, {}, {}};
    house.meters = {unpriced, gas, power};
    EXPECT_EQ(
        test::find(results_of(house, options_of({halved}), draws({0.5}, {0.6})), "after")
            .values,
        after)
        << "whichever of its meters says it";
    house.meters = {gas, power};
    house.building.plant.heating_auxiliary = 0.02;
    EXPECT_EQ(
        test::find(results_of(house, options_of({halved}), draws({0.5}, {0.6})), "output")
            .texts[n_outputs + 1],
        "CO2 of gas alone")
        << "electricity is used, too";
    house.meters[0].tariff = house.meters[0].co2 = house.meters[1].tariff = nan;
    EXPECT_EQ(
        test::find(results_of(house, options_of({halved}), draws({0.5}, {0.6})), "after")
            .values.size(),
        n_outputs);
}

TEST(Retrofit, AScenarioThatFailsEverywhereLosesNoOther) {
    const Case house = steady_case();
    const auto by = [&](const char* name, double factor) {
        return retrofit::Scenario{name,
                                  {change(house, "construction.wall.u_value",
                                          retrofit::ChangeBy::factor, factor)},
                                  {}};
    };
    const auto stage =
        retrofit::make_retrofit("retrofit", house, house.periods[0],
                                options_of({by("lost", 100), by("halved", 0.5)}));
    stage->see(draws({0.5, 0.5}, {0.6, 1.2}));
    const auto answers = test::answers_of(*stage);
    EXPECT_EQ(stage->shortfall(answers),
              "the scenario \"lost\" could be simulated at no point");
    const auto after = test::find(stage->conclude(answers).datasets, "after").values;
    EXPECT_TRUE(std::isnan(after[heating]));
    EXPECT_GT(after[2 * n_outputs + heating], 0);
}

TEST(Retrofit, WithoutPointsItSaysSo) {
    const Case house = steady_case();
    const auto stage = retrofit::make_retrofit("retrofit", house, house.periods[0],
                                               options_of({{"nothing", {}, {}}}));
    stage->see({});
    const std::vector<ItemAnswer> answers{stage->run(0)};
    EXPECT_FALSE(stage->next_round(answers));
    EXPECT_EQ(stage->shortfall(answers),
              "house/fit found no points to apply the scenarios to");
    EXPECT_NO_THROW(stage->conclude(answers));
}

TEST(FoundPoints, OfAPartlyPooledPosteriorAreTheBuildingsOwn) {
    Case house = steady_case();
    house.name = "a";
    auto found = draws({0.5, 0.6}, {0.7, 0.8});
    found.push_back(draws({0.5, 0.6}, {0.9, 1.0})[0]);
    found.back().building = "a";
    EXPECT_EQ(retrofit::found_points(found, "house/fit", house).values,
              (std::vector<double>{0.5, 0.9, 0.6, 1.0}));
    house.name = "b";
    EXPECT_EQ(retrofit::found_points(found, "house/fit", house).values,
              (std::vector<double>{0.5, 0.7, 0.6, 0.8}));
}

TEST(FoundPoints, HaveTheNominalValueWhereAParameterWasNotVaried) {
    const Summary grid = points({"construction.wall.u_value"}, {{5}, {3}});
    EXPECT_EQ(retrofit::found_points({grid}, "house/fit", steady_case()).values,
              (std::vector<double>{0.8, 5, 0.8, 3}));
}

}  // namespace
}  // namespace bemcal::study
