#include "loop/simulator_readings.hpp"
#include "loop/simulator_runs.hpp"
#include "loop/windy_case.hpp"
#include "study/simulated_hours.hpp"

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

study::Case measured() {
    study::Case made = test::windy_case();
    test::measure(made, test::named("wind infiltration"), 0.08, 3);
    return made;
}

/// Runs that miss every reading by as much, up and down in turn: their errors are
/// independent, and an hour is an hour of evidence.
class Runs {
  public:
    Runs() : data_(measured(), {}) {}

    const LoopData& data() const { return data_; }

    SimulatorRun missing_by(double error, std::vector<double> scales = {}) const {
        SimulatorRun run{{0.5, 0.5},
                         std::move(scales),
                         study::AskedPeriods(data_.building.periods.size(), 1),
                         {},
                         {},
                         {}};
        auto& hours =
            run.hours.emplace_back(study::hours_of_periods(data_.building), 0.0);
        const auto readings = study::readings_of(data_.building, data_.training());
        for (std::size_t h = 0; h < readings[0].values.size(); ++h)
            hours[h] = readings[0].values[h] + (h % 2 == 0 ? error : -error);
        return run;
    }

    /// Without effects: the nearest misses by 1.
    std::vector<SimulatorRun> before() const {
        return {missing_by(3), missing_by(2), missing_by(1), missing_by(1.5)};
    }

  private:
    LoopData data_;
};

/// More runs that miss by so much, with these scales.
void add(std::vector<SimulatorRun>& all, const Runs& runs, std::vector<double> errors,
         const std::vector<double>& scales) {
    for (const double error : errors) all.push_back(runs.missing_by(error, scales));
}

Judged judge(const Runs& runs, const std::vector<SimulatorRun>& all, std::size_t n) {
    return RunsSoFar(runs.data(), all).judge_effects(4, n, 2);
}

TEST(JudgedEffects, AreTriedBesideThoseKeptBefore) {
    const Runs runs;
    auto all = runs.before();
    EXPECT_TRUE(judge(runs, all, 2).kept.empty());
    add(all, runs, {1.2, 0.8}, {1, 0});
    EXPECT_EQ(judge(runs, all, 2).kept, std::vector<char>{1});
    add(all, runs, {0.9, 0.81}, {1, 1});
    const Judged judged = judge(runs, all, 2);
    EXPECT_EQ(judged.kept, (std::vector<char>{1, 0}));
    EXPECT_FALSE(judged.is_over);
    EXPECT_FALSE(judged.in_doubt);
}

// 2,424 hours of evidence: 2 x 2424 log(1 / e) is 13.8 at e = 0.99716.
TEST(JudgedEffects, ComeNearerThanChanceWould) {
    const Runs runs;
    for (const double error : {0.9968, 0.9975}) {
        auto all = runs.before();
        add(all, runs, {1.2, error}, {1});
        EXPECT_EQ(judge(runs, all, 1).kept[0], error < 0.997 ? 1 : 0) << error;
    }
}

TEST(JudgedEffects, NoneKeptIsTheEnd) {
    const Runs runs;
    auto all = runs.before();
    add(all, runs, {1.2, 1.1}, {1});
    EXPECT_TRUE(judge(runs, all, 1).is_over);
}

// What came nearer by other parameters alone leaves when it is doubted.
TEST(JudgedEffects, LeaveWhereTheProgramIsAsNearWithoutThem) {
    const Runs runs;
    auto all = runs.before();
    add(all, runs, {1.2, 0.8}, {1, 0});
    add(all, runs, {0.7, 0.6}, {1, 1});
    add(all, runs, {0.55, 0.5}, {1, 1});  // refinement
    Judged judged = judge(runs, all, 2);
    EXPECT_EQ(judged.in_doubt, 1U);
    add(all, runs, {0.52, 0.5}, {1, 0});
    judged = judge(runs, all, 2);
    EXPECT_EQ(judged.kept, (std::vector<char>{1, 0}));
    EXPECT_EQ(judged.in_doubt, 0U);
    add(all, runs, {0.95, 0.9}, {0, 0});
    judged = judge(runs, all, 2);
    EXPECT_EQ(judged.kept, (std::vector<char>{1, 0}));
    EXPECT_TRUE(judged.is_over);
    EXPECT_FALSE(judged.in_doubt);
}

// The second stayed in its own doubt, but without the first it is no longer needed.
TEST(JudgedEffects, LeaveWhereTheNearestRunHasNoneOfThem) {
    const Runs runs;
    auto all = runs.before();
    add(all, runs, {1.2, 0.8}, {1, 0});
    add(all, runs, {0.7, 0.6}, {1, 1});
    add(all, runs, {0.55, 0.5}, {1, 1});  // refinement
    add(all, runs, {0.62, 0.6}, {1, 0});
    EXPECT_EQ(judge(runs, all, 2).kept, (std::vector<char>{1, 1}));
    add(all, runs, {0.48, 0.45}, {0, 0});
    const Judged judged = judge(runs, all, 2);
    EXPECT_EQ(judged.kept, (std::vector<char>{0, 0}));
    EXPECT_TRUE(judged.is_over);
}

TEST(SimulatorRuns, ReadingsAreSumsOfTheirHours) {
    const Runs runs;
    const auto readings = readings_from(runs.data(), runs.missing_by(0).hours);
    for (std::size_t k = 0; k < readings.size(); ++k)
        if (!std::isnan(runs.data().targets.measured[k])) {
            ASSERT_EQ(readings[k], runs.data().targets.measured[k]);
        }
}

TEST(SimulatorRuns, OtherReadingsStandWhereReadingsWere) {
    const Runs runs;
    std::vector<double> readings(runs.data().targets.size(), 7);
    const LoopData other(with_readings(runs.data(), readings), {});
    EXPECT_EQ(std::ranges::count(other.targets.measured, 7.0),
              std::ranges::count_if(runs.data().targets.measured,
                                    [](double value) { return !std::isnan(value); }));
    const auto held_out = study::readings_of(other.building, other.building.periods[1]);
    EXPECT_EQ(std::ranges::count(held_out[0].values, 7.0), 0);
}

TEST(SimulatorRuns, AreKeptInAnAnswer) {
    const Runs runs;
    SimulatorRun run = runs.missing_by(1, {0, 0.5});
    run.left_out = {"a line"};
    const SimulatorRun same = study::unpack_run(pack(run));
    EXPECT_EQ(same.point, run.point);
    EXPECT_EQ(same.scales, run.scales);
    EXPECT_EQ(same.hours, run.hours);
    EXPECT_EQ(same.left_out, run.left_out);
}

}  // namespace
}  // namespace bemcal::loop
