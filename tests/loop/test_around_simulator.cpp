#include "loop/around_simulator.hpp"
#include "loop/stored_loop.hpp"
#include "loop/stored_simulator.hpp"
#include "loop/windy_case.hpp"
#include "study/find.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

using study::Case;
using study::GivenEffect;
using study::SimulatedHours;

/// A simulator whose building is not the twin: lighter, with more film, in two
/// parameters. It can take infiltration and nothing else.
class OtherBuilding : public study::HourlySimulator {
  public:
    explicit OtherBuilding(const Case& twin, int fails_each = 0, bool is_deaf = false)
        : case_(twin), fails_each_(fails_each), is_deaf_(is_deaf) {
        physics::Zone& zone = case_.building.zones[0];
        zone.heat_capacity *= 0.7;
        zone.surface_film *= 1.2;
        for (const char* name : {"walls", "leaks"}) {
            physics::Parameter& parameter = parameters_.emplace_back();
            parameter.name = name;
            parameter.least = 0.5;
            parameter.most = 2;
            parameter.nominal = 1;
        }
    }
    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<std::string>& meters() const override { return meters_; }

    SimulatedHours hours(std::span<const double> point,
                         std::span<const GivenEffect> effects,
                         std::span<const study::Period> periods) const override {
        SimulatedHours simulated;
        const bool is_nominal = point[0] == 1 && point[1] == 1;
        if (fails_nominal_ && is_nominal) simulated.failure = "the model as it is fails";
        if (!simulated.failure.empty()) return simulated;
        if (fails_each_ > 0 && std::lround(1e6 * point[0]) % fails_each_ == 0) {
            simulated.failure = "it was told to fail";
            return simulated;
        }
        std::size_t n_hours = 0;
        for (const study::Period& period : periods) n_hours += count_of(period);
        std::vector<double> air(n_hours, 0.0);
        for (const GivenEffect& effect : effects)
            for (const effects::HookSeries& at : effect.at)
                if (at.hook == "infiltration" && !is_deaf_)
                    for (std::size_t h = 0; h < n_hours; ++h) air[h] += at.values[h];
                else
                    simulated.left_out.push_back(effect.name + " at " + at.hook);
        simulated.meters = {gas(point, air, periods)};
        return simulated;
    }

    /// [hours of the periods] \param air  more air from outdoors [1/h]
    std::vector<double> gas(std::span<const double> point, const std::vector<double>& air,
                            std::span<const study::Period> periods) const {
        std::vector<double> all;
        for (const study::Period& period : periods) {
            physics::Drive drive = study::drive_of(case_, period);
            physics::Building building = case_.building;
            building.constructions[0].u_value.value *= point[0];
            add_air(building, drive, point[1], air, all.size());
            const auto hours =
                physics::predict(building, drive, physics::simulate(building, drive),
                                 physics::Quantity::gas);
            all.insert(all.end(), hours.begin(), hours.end());
        }
        return all;
    }

    bool takes_periods() const override { return takes_periods_; }
    void take_periods() { takes_periods_ = true; }
    void fail_nominal() { fails_nominal_ = true; }

  private:
    static std::size_t count_of(const study::Period& period) {
        return static_cast<std::size_t>(study::hours_of(period));
    }
    static void add_air(physics::Building& building, physics::Drive& drive, double leaks,
                        const std::vector<double>& air, std::size_t first) {
        Matrix more(drive.profiles.rows + 1, static_cast<std::size_t>(drive.n_steps()));
        std::ranges::copy(drive.profiles.values, more.values.begin());
        const auto row = drive.profiles.rows;
        for (int step = drive.n_warm_up; step < drive.n_steps(); ++step)
            more(row, static_cast<std::size_t>(step)) =
                air[first + static_cast<std::size_t>(step - drive.n_warm_up)];
        drive.profiles = std::move(more);
        physics::Zone& zone = building.zones[0];
        zone.flows.push_back({"leaks", {0.3 * leaks, 0, -1}, {}, physics::outdoors});
        zone.flows.push_back(
            {"more", {1, 0, static_cast<int>(row)}, {}, physics::outdoors});
    }

    Case case_;
    int fails_each_;
    bool is_deaf_, takes_periods_ = false, fails_nominal_ = false;
    std::vector<physics::Parameter> parameters_;
    std::vector<std::string> meters_{"gas"};
};

/// The twin with readings that the other building makes: leakier than nominal, and with
/// air that follows the wind by so much.
Case measured(double by_wind) {
    Case twin = test::windy_case();
    const OtherBuilding other(twin);
    std::vector<double> air;
    for (const study::Period& period : twin.periods) {
        const physics::Drive drive = study::drive_of(twin, period);
        const auto around = effects::make_surroundings(twin.building, drive, twin.weather,
                                                       twin.periods[0].from);
        const auto& wind = around.weather.at(effects::Driver::wind);
        for (int step = drive.n_warm_up; step < drive.n_steps(); ++step)
            air.push_back(by_wind * wind[static_cast<std::size_t>(step)]);
    }
    auto gas = other.gas(std::vector{1.2, 1.4}, air, twin.periods);
    double mean = 0;
    for (const double value : gas) mean += value / static_cast<double>(gas.size());
    Stream random(3, 0, 0);
    for (double& value : gas) value += 0.03 * mean * sampling::standard_normal(random);
    const study::Period all{"all", twin.periods.front().from, twin.periods.back().to};
    twin.meters = {{"gas", physics::Quantity::gas, physics::Interval::hourly,
                    study::axis_of(twin, all), gas}};
    return twin;
}

LoopOptions options() {
    LoopOptions options;
    options.block_days = 7;
    options.try_structures = false;
    options.generic = false;
    options.functions = false;
    options.simulator_runs = 36;
    return options;
}

struct AllRounds {
    study::Conclusion conclusion;
    std::size_t n_items = 0;
    std::string shortfall;

    StoredLoop loop() const { return stored_loop(conclusion.datasets, group()); }
    StoredSimulator simulator() const {
        return stored_simulator(conclusion.datasets, group());
    }
    /// In the period that was held out.
    double error(StoredLoop::Model model) const {
        return loop().fit.at({model, 1, StoredLoop::hourly, 0, StoredLoop::cv_rmse});
    }
    std::string group() const {
        const std::string& path = conclusion.datasets.at(0).path;
        return path.substr(0, path.rfind('/'));
    }
};

/// All rounds, as they would be run.
AllRounds run_of(const Case& twin,
                 std::shared_ptr<const study::HourlySimulator> simulator) {
    const auto stage = make_loop_around("loop", twin, std::move(simulator), options());
    std::vector<study::ItemAnswer> answers;
    const auto run = [&](int n) {
        for (int k = 0; k < n; ++k)
            answers.push_back(stage->run(static_cast<int>(answers.size())));
    };
    run(stage->n_items());
    while (const auto round = stage->next_round(answers)) {
        stage->begin_round(static_cast<int>(answers.size()), *round);
        run(round->n_items);
    }
    return {stage->conclude(answers), answers.size(), stage->shortfall(answers)};
}

TEST(LoopAroundSimulator, FindsAnEffectAndGivesItToTheSimulator) {
    const Case twin = measured(0.08);
    const AllRounds run = run_of(twin, std::make_shared<OtherBuilding>(twin));
    EXPECT_EQ(run.shortfall, "");
    EXPECT_LE(run.n_items, 37U);  // 36 runs and a search
    ASSERT_EQ(run.loop().effects.size(), 1U);
    EXPECT_EQ(run.loop().effects[0].name, "wind infiltration");
    const StoredSimulator simulator = run.simulator();
    ASSERT_EQ(simulator.given.size(), 1U);
    EXPECT_EQ(simulator.given[0].hooks, "infiltration");
    EXPECT_NEAR(simulator.given[0].scale * run.loop().effects[0].coefficient, 0.08, 0.02);
    // Its own runs: as good as the readings allow.
    EXPECT_GT(run.error(StoredLoop::plain), run.error(StoredLoop::before));
    EXPECT_LT(run.error(StoredLoop::after), 0.6 * run.error(StoredLoop::before));
    EXPECT_LT(run.error(StoredLoop::after), 4.5);
    ASSERT_EQ(simulator.parameters.size(), 2U);
    EXPECT_NEAR(simulator.parameters[0].after, 1.2, 0.15);
    ASSERT_EQ(simulator.channels.size(), 1U);
    EXPECT_LT(simulator.channels[0].emulator_error, 3);
}

// Runs of training alone decide the same; the reported ones then get the other period.
TEST(LoopAroundSimulator, RunsOnlyTrainingWhereThatIsEnough) {
    const Case twin = measured(0.08);
    const auto other = std::make_shared<OtherBuilding>(twin);
    const AllRounds whole = run_of(twin, other);
    const auto short_runs = std::make_shared<OtherBuilding>(twin);
    short_runs->take_periods();
    const AllRounds run = run_of(twin, short_runs);
    EXPECT_EQ(run.shortfall, "");
    ASSERT_EQ(run.loop().effects.size(), 1U);
    for (const auto model : {StoredLoop::plain, StoredLoop::before, StoredLoop::after})
        EXPECT_EQ(run.error(model), whole.error(model));
    const auto years = [](const AllRounds& of) {
        double sum = 0;
        for (const auto& each : of.simulator().runs) sum += each.years;
        return sum;
    };
    EXPECT_EQ(run.n_items, whole.n_items + 3);
    EXPECT_EQ(run.simulator().runs.back().of, "held out");
    EXPECT_LT(years(run), 0.8 * years(whole));
}

TEST(LoopAroundSimulator, FindsNothingWhereNothingIs) {
    const Case twin = measured(0);
    const AllRounds run = run_of(twin, std::make_shared<OtherBuilding>(twin));
    EXPECT_EQ(run.loop().effects.size(), 0U);
    EXPECT_EQ(run.simulator().given.size(), 0U);
    EXPECT_EQ(run.error(StoredLoop::after), run.error(StoredLoop::before));
    EXPECT_LT(run.error(StoredLoop::after), 4.5);
}

// What the program cannot take, or is no nearer to the readings with, is no finding.
TEST(LoopAroundSimulator, LeavesWhatTheSimulatorIsNoBetterWith) {
    const Case twin = measured(0.08);
    const AllRounds run = run_of(twin, std::make_shared<OtherBuilding>(twin, 0, true));
    const StoredLoop loop = run.loop();
    EXPECT_EQ(loop.effects.size(), 0U);
    EXPECT_TRUE(loop.effect_values.empty());
    ASSERT_FALSE(loop.steps.empty());
    EXPECT_EQ(loop.steps.back().effect, "wind infiltration");
    EXPECT_EQ(loop.steps.back().verdict,
              "taken out: the program's own runs are no nearer to the readings with it");
    ASSERT_EQ(run.simulator().left_out.size(), 1U);
    EXPECT_EQ(run.simulator().left_out[0].why, "wind infiltration at infiltration");
    EXPECT_EQ(run.error(StoredLoop::after), run.error(StoredLoop::before));
}

TEST(LoopAroundSimulator, RunsThatFailAreToldAndLeftOut) {
    const Case twin = measured(0.08);
    const AllRounds run = run_of(twin, std::make_shared<OtherBuilding>(twin, 7));
    const auto runs = run.simulator().runs;
    const auto n_failed =
        std::ranges::count(runs, "it was told to fail", &StoredSimulator::Run::failure);
    EXPECT_GT(n_failed, 0);
    ASSERT_EQ(run.loop().effects.size(), 1U);
    EXPECT_EQ(run.loop().effects[0].name, "wind infiltration");
}

// The model as it is has no errors then; another run's would be taken for them.
TEST(LoopAroundSimulator, HasNoPlainWhereTheNominalRunFails) {
    const Case twin = measured(0);
    const auto simulator = std::make_shared<OtherBuilding>(twin);
    simulator->fail_nominal();
    const AllRounds run = run_of(twin, simulator);
    EXPECT_EQ(run.loop().fit.at(
                  {StoredLoop::plain, 1, StoredLoop::hourly, 0, StoredLoop::n_readings}),
              0);
    EXPECT_GT(run.error(StoredLoop::before), 0);
    EXPECT_EQ(run.simulator().parameters.at(0).plain, 1);
    EXPECT_NE(run.simulator().parameters.at(0).before, 1);
}

TEST(LoopAroundSimulator, SaysWhereTooFewRunsSucceed) {
    const Case twin = measured(0.08);
    const AllRounds run = run_of(twin, std::make_shared<OtherBuilding>(twin, 1));
    EXPECT_NE(run.shortfall.find("too few runs"), std::string::npos);
    EXPECT_NE(run.shortfall.find("the first that failed: it was told to fail"),
              std::string::npos)
        << run.shortfall;
    EXPECT_FALSE(run.conclusion.datasets.empty());
}

TEST(LoopAroundSimulator, AsksForHoursOfEveryMeter) {
    Case twin = measured(0.08);
    twin.meters[0].name = "another";
    LoopOptions asked = options();
    asked.meters = {"another"};
    EXPECT_THROW(
        make_loop_around("loop", twin, std::make_shared<OtherBuilding>(twin), asked),
        std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::loop
