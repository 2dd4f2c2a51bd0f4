#include "retrofit/simulator_retrofit.hpp"
#include "study/find.hpp"
#include "study/simulated_hours.hpp"
#include "study/small_case.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using retrofit::ChangeBy;
using retrofit::SimulatorChange;
using retrofit::SimulatorRetrofitOptions;

constexpr const char* u_name = "u";
enum Number : std::size_t { u, set_point };

/// A program of a room: it is heated to its set-point, and is as cold as that lets it.
class Program : public HourlySimulator {
  public:
    explicit Program(const Case& building, bool takes_periods = false)
        : building_(building), takes_periods_(takes_periods) {
        add(u_name, "W/(m2 K)", 0.5, 2, 1);
        add("set_point", "degC", 18, 23, 20);
    }
    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<std::string>& meters() const override { return meters_; }
    bool takes_periods() const override { return takes_periods_; }

    SimulatedHours hours(std::span<const double> point,
                         std::span<const GivenEffect> effects,
                         std::span<const Period> periods) const override {
        SimulatedHours simulated;
        {
            const std::scoped_lock lock(mutex_);
            asked.push_back(static_cast<int>(periods.size()));
        }
        if (point[u] == 1.75) {
            simulated.failure = "it was told to fail";
            return simulated;
        }
        std::vector<double> heat, room;
        for (const Period& period : periods) {
            const auto from =
                static_cast<std::size_t>((period.from - test::day(0)).count() / 3600);
            for (std::size_t k = 0; k < static_cast<std::size_t>(hours_of(period)); ++k) {
                double air = 0;
                for (const GivenEffect& effect : effects)
                    air += effect.at[0].values[heat.size()];
                heat.push_back((0.2 * point[u] + air) *
                               (point[set_point] - building_.weather.theta_e[from + k]));
                room.push_back(point[set_point] - (k % 24 < 8 ? 1.5 : 0));
            }
        }
        simulated.meters = {heat, room};
        return simulated;
    }

    mutable std::vector<int> asked;  ///< periods of each run

  private:
    void add(const char* name, const char* unit, double least, double most,
             double nominal) {
        physics::Parameter& parameter = parameters_.emplace_back();
        parameter.name = name;
        parameter.unit = unit;
        parameter.least = least;
        parameter.most = most;
        parameter.nominal = nominal;
    }

    Case building_;
    bool takes_periods_;
    mutable std::mutex mutex_;
    std::vector<physics::Parameter> parameters_;
    std::vector<std::string> meters_{"heat", "room"};
};

Case house() {
    Case made = test::small_case();
    for (const auto& [name, quantity] :
         {std::pair{"heat", physics::Quantity::heating},
          std::pair{"room", physics::Quantity::air_temperature}}) {
        Meter& meter = made.meters.emplace_back();
        meter.name = name;
        meter.quantity = quantity;
        meter.interval = physics::Interval::hourly;
    }
    return made;
}

/// What the stage "house/fit" found.
Summary found(const std::vector<std::vector<double>>& rows,
              std::vector<GivenEffect> given = {}) {
    Summary summary;
    summary.study = "house/fit";
    summary.points.parameters = {"set_point", u_name};
    for (const auto& row : rows)
        summary.points.rows.add_row(std::vector{row[set_point], row[u]});
    summary.given = std::move(given);
    return summary;
}

/// More air in every other hour of all periods.
GivenEffect effect(const Case& building, const char* name, double size) {
    std::vector<double> hours(hours_of_periods(building));
    for (std::size_t h = 0; h < hours.size(); h += 2) hours[h] = size;
    return {name, {{"infiltration", "1/h", false, "", "", hours}}};
}

SimulatorRetrofitOptions options_of(std::vector<retrofit::SimulatorScenario> scenarios) {
    SimulatorRetrofitOptions options;
    options.scenarios = std::move(scenarios);
    options.of = "house/fit";
    options.limits = {{0.1, 2}, {18, 23}};
    return options;
}

const SimulatorChange insulated{u, "", ChangeBy::resistance, 2};
const SimulatorChange cooler{set_point, "", ChangeBy::offset, -1};

struct Made {
    std::vector<Dataset> datasets;
    std::shared_ptr<const Program> program;
    const std::vector<double>& numbers(const char* leaf) const {
        return test::find(datasets, leaf).values;
    }
    const std::vector<std::string>& texts(const char* leaf) const {
        return test::find(datasets, leaf).texts;
    }
};

Made made(const Case& building, const SimulatorRetrofitOptions& options,
          const Summary& of, bool takes_periods = false,
          const std::string& shortfall = "") {
    const auto program = std::make_shared<const Program>(building, takes_periods);
    const auto stage = retrofit::make_simulator_retrofit(
        "small/retrofit", building, program, building.periods[1], options);
    stage->see({of});
    const auto answers = test::answers_of(*stage);
    EXPECT_EQ(stage->shortfall(answers), shortfall);
    return {stage->conclude(answers).datasets, program};
}

/// Heat over the second period, by a run of the program itself.
double plain_heat(const Case& building, const std::vector<double>& point,
                  const std::vector<GivenEffect>& effects = {}) {
    const Program program(building);
    const auto heat = hours_in(building, building.periods[1],
                               program.hours(point, effects, building.periods).meters[0]);
    return std::accumulate(heat.begin(), heat.end(), 0.0);
}

constexpr std::size_t n_outputs = 3;  ///< heat, too cold, too warm
const std::vector<std::vector<double>> draws{{0.8, 19}, {1.2, 20}, {1.6, 21}};

TEST(SimulatorRetrofit, BeforeAndAfterAreTheProgramsOwnRuns) {
    const Case building = house();
    const Made result = made(
        building, options_of({{"insulated", {insulated}}, {"both", {insulated, cooler}}}),
        found(draws));
    EXPECT_EQ(result.texts("output"),
              (std::vector<std::string>{"heat", "too_cold", "too_warm"}));
    std::vector<double> saved;
    for (std::size_t r = 0; r < draws.size(); ++r) {
        const double before = plain_heat(building, draws[r]),
                     u_after = 1 / (1 / draws[r][u] + 2);
        EXPECT_EQ(result.numbers("before")[r * n_outputs], before);
        EXPECT_NEAR(result.numbers("after")[r * n_outputs],
                    plain_heat(building, {u_after, draws[r][set_point]}), 1e-9 * before);
        EXPECT_NEAR(result.numbers("after")[(draws.size() + r) * n_outputs],
                    plain_heat(building, {u_after, draws[r][set_point] - 1}),
                    1e-9 * before);
        saved.push_back(before - result.numbers("after")[r * n_outputs]);
    }
    std::ranges::sort(saved);
    EXPECT_EQ(result.numbers("saving_quantile")[n_outputs], saved[1]);  // the median
    EXPECT_EQ(result.numbers("described")[0], plain_heat(building, {1, 20}));
    EXPECT_EQ(result.texts("simulator_run").size(), 3 * (1 + draws.size()));
}

TEST(SimulatorRetrofit, IsRunForItsPeriodAlone) {
    const Case building = house();
    const auto options = options_of({{"insulated", {insulated}}});
    const Made all = made(building, options, found(draws)),
               one = made(building, options, found(draws), true);
    EXPECT_EQ(one.numbers("before"), all.numbers("before"));
    EXPECT_EQ(one.numbers("after"), all.numbers("after"));
    EXPECT_EQ(one.program->asked, std::vector<int>(8, 1));
    EXPECT_EQ(all.program->asked, std::vector<int>(8, 2));
}

TEST(SimulatorRetrofit, EffectsThatALoopFoundAreKeptStruckAndScaled) {
    const Case building = house();
    const std::vector<GivenEffect> given{effect(building, "leaks", 0.05),
                                         effect(building, "windows", 0.02)};
    const std::vector<double> at{1.2, 20};
    const Made result =
        made(building,
             options_of({{"sealed", {{0, "leaks", ChangeBy::value, 0}}},
                         {"half", {{0, "leaks", ChangeBy::factor, 0.5}}}}),
             found({at}, given));
    EXPECT_EQ(result.numbers("before")[0], plain_heat(building, at, given));
    EXPECT_EQ(result.numbers("after")[0], plain_heat(building, at, {given[1]}));
    EXPECT_EQ(result.numbers("after")[n_outputs],
              plain_heat(building, at, {effect(building, "leaks", 0.025), given[1]}));
    EXPECT_EQ(result.numbers("described")[0], plain_heat(building, {1, 20}));
    EXPECT_EQ(result.texts("simulator_given"),
              (std::vector<std::string>{"leaks", "windows"}));
}

TEST(SimulatorRetrofit, AnEffectThatWasNotFoundFailsWithThoseThatWere) {
    const Case building = house();
    const Made result = made(building,
                             options_of({{"sealed", {{0, "doors", ChangeBy::value, 0}}},
                                         {"insulated", {insulated}}}),
                             found({{1.2, 20}}, {effect(building, "leaks", 0.05)}), false,
                             "the scenario \"sealed\" could be simulated at no point");
    EXPECT_EQ(result.numbers("n_failed")[0], 1);
    EXPECT_EQ(result.texts("failed_reason")[0],
              "sealed: effect.doors was not found; expected effect.leaks");
    EXPECT_TRUE(std::isnan(result.numbers("saving_quantile")[n_outputs]));
    EXPECT_FALSE(std::isnan(result.numbers("saving_quantile")[4 * n_outputs]));
}

TEST(SimulatorRetrofit, ANumberBeyondTheLimitsIsNotRun) {
    const Made result =
        made(house(), options_of({{"cold", {{set_point, "", ChangeBy::offset, -2}}}}),
             found({{0.8, 19}, {0.9, 20}, {1, 21}}));
    EXPECT_EQ(result.numbers("n_failed")[0], 1);
    EXPECT_EQ(result.texts("failed_reason")[0],
              "cold: set_point would be 17; expected 18 to 23 degC");
    EXPECT_EQ(result.numbers("failed_point")[0], 1);
    EXPECT_EQ(result.program->asked.size(), 7U);
    EXPECT_FALSE(std::isnan(result.numbers("before")[0]));
    EXPECT_TRUE(std::isnan(result.numbers("after")[0]));
    EXPECT_FALSE(std::isnan(result.numbers("saving_quantile")[0]));
}

TEST(SimulatorRetrofit, ARunThatFailsIsToldAndLeftOut) {
    const Made result =
        made(house(), options_of({{"insulated", {insulated}}, {"cooler", {cooler}}}),
             found({{1.75, 20}, {1.2, 20}}));
    EXPECT_EQ(result.numbers("n_failed")[0], 2);  // before, and when it is cooler
    EXPECT_EQ(result.texts("failed_reason")[0], "it was told to fail");
    EXPECT_EQ(result.texts("failed_reason")[1], "cooler: it was told to fail");
    const auto& saved = result.numbers("saving_quantile");
    EXPECT_EQ(saved[0], saved[2 * n_outputs]);  // of the only point that is left
}

TEST(SimulatorRetrofit, CountsOccupiedHoursThatAreTooCold) {
    const Case building = house();
    const double days = hours_of(building.periods[1]) / 24;
    SimulatorRetrofitOptions options = options_of({{"cooler", {cooler}}});
    Made result = made(building, options, found({{1, 20}}));
    EXPECT_EQ(result.numbers("before")[1], 8 * days);  // 18.5 degC at night
    EXPECT_EQ(result.numbers("after")[1], 8 * days);   // 19 degC is not too cold
    options.too_cold = 19.5;
    options.occupied_profile = 0;  // from 8 to 18 on weekdays
    result = made(building, options, found({{1, 20}}));
    EXPECT_EQ(result.numbers("before")[1], 0);
    EXPECT_EQ(result.numbers("after")[1], 10 * 5);  // of a week
}

TEST(SimulatorRetrofit, TakesAtMostSoManyPointsAndSaysWhereThereAreNone) {
    const Case building = house();
    SimulatorRetrofitOptions options = options_of({{"insulated", {insulated}}});
    options.n_points = 2;
    const auto program = std::make_shared<const Program>(building);
    const auto stage = retrofit::make_simulator_retrofit(
        "small/retrofit", building, program, building.periods[1], options);
    EXPECT_EQ(stage->n_simulations(), 2 * 3);
    const auto none = test::answers_of(*stage);
    EXPECT_EQ(stage->shortfall(none),
              "house/fit found no points to apply the scenarios to");
    EXPECT_NO_THROW(stage->conclude(none));
    EXPECT_EQ(made(building, options, found(draws)).program->asked.size(), 6U);
}

}  // namespace
}  // namespace bemcal::study
