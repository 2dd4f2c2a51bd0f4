/// A study by few runs of a simulator: runs first, then the study on what was learned.
#include "study/analytic_simulator.hpp"
#include "study/emulated_study.hpp"
#include "study/find.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::AnalyticSimulator;
using test::find;

/// Asks a simulator at points of its own; two rounds of them.
class Asks : public Stage {
  public:
    explicit Asks(std::shared_ptr<const Simulator> simulator)
        : simulator_(std::move(simulator)) {}
    std::string name() const override { return "asks"; }
    int n_items() const override { return 3; }
    long long n_simulations() const override { return 5; }
    std::size_t answer_bytes() const override { return 16; }
    ItemAnswer run(int item) const override {
        Matrix point(1, 5), answers;
        for (double& value : point.values) value = 1 + 3.5 * item;
        std::vector<std::string> failures;
        simulator_->evaluate(point, answers, failures);
        return {answers.values, {}, {}};
    }
    std::optional<Round> next_round(
        const std::vector<ItemAnswer>& answers) const override {
        if (answers.size() > 3) return std::nullopt;
        return Round{2, {7}};
    }
    void begin_round(int first_item, const Round& round) override {
        EXPECT_EQ(first_item, 3);
        EXPECT_EQ(round.needed, std::vector<double>{7});
    }
    Conclusion conclude(const std::vector<ItemAnswer>& answers) const override {
        EXPECT_EQ(answers.size(), 5U);
        return {{{"asks/heat", {"point"}, {1}, {answers[2].values[1]}, {}, ""}}, {}};
    }
    std::vector<double> best_point(
        const std::vector<ItemAnswer>& answers) const override {
        EXPECT_EQ(answers.size(), 5U);
        return has_best ? std::vector<double>(5, best) : std::vector<double>{};
    }
    static inline bool has_best = false;
    static constexpr double best = 11;

  private:
    std::shared_ptr<const Simulator> simulator_;
};

std::unique_ptr<Stage> asks(std::shared_ptr<const Simulator> simulator) {
    return std::make_unique<Asks>(std::move(simulator));
}

/// All rounds of a stage on two ranks: that which ends it, and one that does items alone.
std::vector<ItemAnswer> answers_of(Stage& first, Stage& second) {
    std::vector<ItemAnswer> answers;
    for (int left = first.n_items(); left > 0;) {
        const auto begin = static_cast<int>(answers.size());
        for (int k = 0; k < left; ++k)
            answers.push_back((k % 2 == 0 ? first : second).run(begin + k));
        const auto round = first.next_round(answers);
        left = round ? round->n_items : 0;
        if (!round) continue;
        first.begin_round(static_cast<int>(answers.size()), *round);
        second.begin_round(static_cast<int>(answers.size()), *round);
    }
    return answers;
}

std::unique_ptr<Stage> emulated(int n_runs, double fails_above = 1e9) {
    return make_emulated_study(
        "asks", std::make_shared<const AnalyticSimulator>(fails_above), n_runs, 4, asks);
}

/// "heat" = 100 air + 10 (set_point - 10) - 2 lights - 3 devices.
double heat_at(double all) {
    return 100 * all + 10 * (all - 10) - 5 * all;
}

TEST(EmulatedStudy, AsksAnEmulatorOfTheRuns) {
    const auto first = emulated(30), second = emulated(30);
    EXPECT_EQ(first->n_items(), 30);
    EXPECT_STREQ(first->counts(), "runs");
    const auto answers = answers_of(*first, *second);
    ASSERT_EQ(answers.size(), 30U + 5U);
    const auto datasets = first->conclude(answers).datasets;
    EXPECT_NEAR(find(datasets, "heat").values[0], heat_at(8), 1)
        << "of 2,200 over the ranges";
    EXPECT_EQ(find(datasets, "simulator_run").texts.size(), 30U);
    EXPECT_EQ(find(datasets, "simulator_run_value").shape,
              (std::vector<std::size_t>{30, 5}));
    for (const double error : find(datasets, "simulator_emulator_error").values)
        EXPECT_LT(error, 1);
}

/// "heat" that is always the same.
class Constant : public AnalyticSimulator {
  public:
    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        AnalyticSimulator::evaluate(points, answers, failures);
        for (std::size_t r = 0; r < answers.rows; ++r) answers(r, 1) = 0.3;
    }
};

TEST(EmulatedStudy, AnOutputThatNeverChangesStays) {
    const auto make = [] {
        return make_emulated_study("asks", std::make_shared<const Constant>(), 30, 4,
                                   asks);
    };
    const auto first = make(), second = make();
    const auto datasets = first->conclude(answers_of(*first, *second)).datasets;
    EXPECT_NEAR(find(datasets, "heat").values[0], 0.3, 1e-12);
    EXPECT_NEAR(find(datasets, "simulator_emulator_error").values[1], 0, 1e-9);
}

TEST(EmulatedStudy, RunsThatFailAreLeftOut) {
    const auto first = emulated(40, 15), second = emulated(40, 15);
    const auto answers = answers_of(*first, *second);
    const auto datasets = first->conclude(answers).datasets;
    EXPECT_NEAR(find(datasets, "heat").values[0], heat_at(8), 1);
    const auto& failures = find(datasets, "simulator_run_failure").texts;
    EXPECT_EQ(std::ranges::count(failures, "too much air"), 10) << "a quarter";
}

/// "heat" that no emulator knows exactly.
class Curved : public AnalyticSimulator {
  public:
    static double heat_at(double air) { return 1000 * std::exp(-0.1 * air); }
    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        AnalyticSimulator::evaluate(points, answers, failures);
        for (std::size_t r = 0; r < answers.rows; ++r)
            answers(r, 1) = heat_at(points(r, 0));
    }
};

TEST(EmulatedStudy, TheSimulatorIsRunAtTheBestPoint) {
    const auto make = [] {
        return make_emulated_study("asks", std::make_shared<const Curved>(), 30, 4, asks);
    };
    const auto first = make(), second = make();
    Asks::has_best = true;
    const auto answers = answers_of(*first, *second);
    const auto datasets = first->conclude(answers).datasets;
    Asks::has_best = false;
    ASSERT_EQ(answers.size(), 30U + 5U + 1U);
    EXPECT_EQ(find(datasets, "simulator_run").texts.back(), "best point");
    EXPECT_EQ(find(datasets, "simulator_run_value").values.back(), Asks::best);
    const double there = Curved::heat_at(Asks::best);
    EXPECT_DOUBLE_EQ(find(datasets, "best_run_value").values.at(1), there);
    const double foretold = find(datasets, "best_run_foretold").values.at(1);
    EXPECT_NEAR(foretold, there, 50);
    EXPECT_NE(foretold, there) << "it is the emulator's own";
}

TEST(EmulatedStudy, ARunThatFailsAtTheBestPointIsTold) {
    Asks::has_best = true;
    const auto first = emulated(40, 10), second = emulated(40, 10);
    const auto datasets = first->conclude(answers_of(*first, *second)).datasets;
    Asks::has_best = false;
    EXPECT_EQ(find(datasets, "simulator_run_failure").texts.back(), "too much air");
    EXPECT_EQ(std::ranges::count(find(datasets, "simulator_run").texts, "best point"), 1);
}

TEST(EmulatedStudy, ConcludesWithoutTheStudyWhereTooFewSucceed) {
    const auto stage = emulated(14, 1), other = emulated(14, 1);
    const auto answers = answers_of(*stage, *other);
    EXPECT_EQ(answers.size(), 14U);
    EXPECT_EQ(stage->shortfall(answers),
              "too few runs of the simulator succeeded for an emulator");
    EXPECT_EQ(find(stage->conclude(answers).datasets, "simulator_run").texts.size(), 14U);
}

TEST(EmulatedStudy, NeedsTwiceTheRunsOfAPlane) {
    EXPECT_THROW(emulated(13), std::invalid_argument);
    EXPECT_NO_THROW(emulated(14));
}

}  // namespace
}  // namespace bemcal::study
