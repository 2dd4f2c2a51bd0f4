#include "base/error.hpp"
#include "run/distribute.hpp"
#include "support/fake_stage.hpp"
#include "support/mpi_world.hpp"

#include <atomic>
#include <chrono>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

using test::FakeStage;
using test::world;

Distributed distribute_all(const study::Stage& stage, const DistributeOptions& options) {
    return distribute(world(), stage, {0, stage.n_items(), {}, {}}, options);
}

void expect_complete(const Distributed& done, const study::Stage& stage) {
    EXPECT_FALSE(done.stopped);
    if (world().rank() != 0) return;
    ASSERT_EQ(done.answers.size(), static_cast<std::size_t>(stage.n_items()));
    for (int item = 0; item < stage.n_items(); ++item)
        EXPECT_EQ(done.answers[static_cast<std::size_t>(item)].values,
                  stage.run(item).values);
}

TEST(Distribute, AnswersStandInItemOrderForAnyNumberOfThreads) {
    for (const int n_threads : {1, 2, 3, 4}) {
        const FakeStage stage("a", {300});
        DistributeOptions options;
        options.n_threads = n_threads;
        expect_complete(distribute_all(stage, options), stage);
    }
}

TEST(Distribute, FewerItemsThanRanksAndNoItemsAtAllAreFine) {
    for (const int n_items : {0, 1, 2}) {
        const FakeStage stage("a", {n_items});
        expect_complete(distribute_all(stage, {}), stage);
    }
}

TEST(Distribute, EveryItemIsReportedFinishedExactlyOnceOverAllRanks) {
    const FakeStage stage("a", {1000});
    std::vector<int> counts(1000, 0);
    DistributeOptions options;
    options.n_threads = 2;
    options.on_finished = [&](int item, const Bytes&) {
        ++counts[static_cast<std::size_t>(item)];
    };
    distribute_all(stage, options);
    Bytes mine(counts.size());
    for (std::size_t k = 0; k < counts.size(); ++k)
        mine[k] = static_cast<std::byte>(counts[k]);
    std::vector<int> sums(counts.size(), 0);
    for (const Bytes& bytes : world().all_gather(mine))
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += static_cast<int>(bytes[k]);
    EXPECT_EQ(sums, std::vector<int>(1000, 1));
}

TEST(Distribute, EveryRankTakesPartWhereItemsTakeTime) {
    const FakeStage stage("a", {40 * world().size(), std::chrono::milliseconds(2)});
    int n_mine = 0;
    DistributeOptions options;
    options.on_finished = [&](int, const Bytes&) { ++n_mine; };
    distribute_all(stage, options);
    EXPECT_GT(n_mine, 0);
}

/// Its items run for longer than the pause after which the ranks are asked.
class TellingStage : public FakeStage {
  public:
    TellingStage() : FakeStage("a", {world().size(), std::chrono::milliseconds(2500)}) {}
    study::Activity activity() const override {
        const double rank = world().rank();
        return {1 - rank / 10, fmt::format("rank {}", rank), "", 1};
    }
};

TEST(Distribute, ProgressHoldsHowFarTheItemsOfAllRanksAre) {
    const TellingStage stage;
    study::Activity last;
    DistributeOptions options;
    options.on_progress = [&](const Progress& progress) { last = progress.activity; };
    distribute_all(stage, options);
    if (world().rank() != 0) return;
    const int size = world().size();
    EXPECT_EQ(last.n_items, size);
    EXPECT_NEAR(last.share, 1 - (size - 1) / 20.0, 1e-12);
    EXPECT_EQ(last.text, fmt::format("rank {}", size - 1));
}

TEST(Distribute, KnownAnswersAreNotComputedAgain) {
    const FakeStage stage("a", {100});
    std::vector<study::ItemAnswer> known(100);
    std::vector<bool> has(100, false);
    for (std::size_t item = 0; item < 100; item += 2) {
        known[item] = stage.run(static_cast<int>(item));
        has[item] = true;
    }
    std::atomic<bool> repeated = false;
    DistributeOptions options;
    options.on_finished = [&](int item, const Bytes&) {
        repeated = repeated || item % 2 == 0;
    };
    expect_complete(distribute(world(), stage, {0, 100, known, has}, options), stage);
    EXPECT_FALSE(repeated);
}

TEST(Distribute, ALaterRangeOfItemsKeepsItsNumbers) {
    const FakeStage stage("a", {100});
    const Distributed done = distribute(world(), stage, {60, 25, {}, {}}, {});
    if (world().rank() != 0) return;
    ASSERT_EQ(done.answers.size(), 25U);
    for (int k = 0; k < 25; ++k)
        EXPECT_EQ(done.answers[static_cast<std::size_t>(k)].values,
                  stage.run(60 + k).values);
}

TEST(Distribute, AnItemThatThrowsBecomesAnAnswerWithItsReason) {
    const FakeStage stage("a", {50, {}, 17});
    const Distributed done = distribute_all(stage, {});
    if (world().rank() != 0) return;
    EXPECT_EQ(done.answers[17].error, "item fails on purpose");
    EXPECT_EQ(done.answers[18].error, "");
}

TEST(Distribute, AStopAskedForOnTheLastRankStopsAllOfThem) {
    const FakeStage stage("a", {100000, std::chrono::milliseconds(1)});
    const bool is_last = world().rank() == world().size() - 1;
    int n_mine = 0;
    DistributeOptions options;
    options.on_finished = [&](int, const Bytes&) { ++n_mine; };
    options.should_stop = [&] {
        return is_last && n_mine > 5 ? Stopping::after_items : Stopping::no;
    };
    EXPECT_TRUE(distribute_all(stage, options).stopped);
}

TEST(Distribute, AnErrorOnTheLastRankIsThrownOnAllOfThem) {
    const FakeStage stage("a", {2000, std::chrono::microseconds(200)});
    const bool is_last = world().rank() == world().size() - 1;
    int n_mine = 0;
    DistributeOptions options;
    options.on_finished = [&](int, const Bytes&) {
        if (is_last && ++n_mine > 5) throw UserError(ExitCode::io, "no space left");
    };
    try {
        distribute_all(stage, options);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::io);
        EXPECT_STREQ(error.what(), "no space left");
    }
}

TEST(Distribute, AStageAfterAStoppedOneIsComplete) {
    const FakeStage stopped("a", {100000, std::chrono::milliseconds(1)});
    DistributeOptions options;
    options.should_stop = [] { return Stopping::soon; };
    EXPECT_TRUE(distribute_all(stopped, options).stopped);
    const FakeStage stage("b", {200});
    expect_complete(distribute_all(stage, {}), stage);
}

TEST(Distribute, AnswersOfMegabytesArrive) {
    class Large : public FakeStage {
      public:
        using FakeStage::FakeStage;
        study::ItemAnswer run(int item) const override {
            return {std::vector<double>(500000, item), {}, {}};
        }
    };
    const Large stage("a", {12});
    expect_complete(distribute_all(stage, {}), stage);
}

TEST(Distribute, ProgressEndsWithAllItems) {
    const FakeStage stage("a", {30, std::chrono::milliseconds(20)});
    Progress last;
    DistributeOptions options;
    options.on_progress = [&](const Progress& progress) { last = progress; };
    distribute_all(stage, options);
    EXPECT_EQ(last.items_total, world().rank() == 0 ? 30 : 0);
}

}  // namespace
}  // namespace bemcal::run
