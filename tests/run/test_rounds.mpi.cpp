#include "run/execute.hpp"
#include "run/rounds.hpp"
#include "support/mpi_world.hpp"
#include "support/shared_folder.hpp"

#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>

namespace bemcal::run {
namespace {

using test::SharedFolder;
using test::world;

bool is_first() {
    return world().rank() == 0;
}
bool is_last() {
    return world().rank() == world().size() - 1;
}

struct WalkOptions {
    int n_rounds = 5;
    int raises_at = -1;  ///< this or a later item, on the last rank, raises SIGTERM
    std::string shortfall;
};

/// Rounds of 5, 6, 7, ... items, which all start from the sum of the answers before.
class Walk : public study::Stage {
  public:
    explicit Walk(WalkOptions options = {}) : options_(std::move(options)) {}

    std::string name() const override { return "office/walk"; }
    int n_items() const override { return 5; }
    long long n_simulations() const override { return 0; }
    std::size_t answer_bytes() const override { return 8; }

    study::ItemAnswer run(int item) const override {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const bool raises = options_.raises_at >= 0 && item >= options_.raises_at;
        if (raises && is_last() && !raised_.exchange(true)) ::raise(SIGTERM);
        return {{std::sin(item) + 0.7 * start_ + 1e-3 * (item - first_item_)}, {}, {}};
    }
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        int n_rounds = 0, n_items = 0;
        while (n_items < static_cast<int>(answers.size())) n_items += 5 + n_rounds++;
        if (n_rounds == options_.n_rounds) return std::nullopt;
        double sum = 0;
        for (const auto& answer : answers) sum += answer.values.at(0);
        return study::Round{5 + n_rounds, {sum}};
    }
    void begin_round(int first_item, const study::Round& round) override {
        first_item_ = first_item;
        start_ = round.needed.at(0);
    }
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        std::vector<double> scores;
        for (const auto& answer : answers) scores.push_back(answer.values.at(0));
        const std::size_t n = scores.size();
        return {{{name() + "/score", {"point"}, {n}, std::move(scores), {}}}};
    }
    std::string shortfall(const std::vector<study::ItemAnswer>&) const override {
        return options_.shortfall;
    }

  private:
    WalkOptions options_;
    int first_item_ = 0;
    double start_ = 0;
    mutable std::atomic<bool> raised_ = false;
};

/// All rounds, one item after the other.
std::vector<double> plain_scores(int n_rounds = 5) {
    Walk stage({n_rounds, -1, {}});
    std::vector<study::ItemAnswer> answers;
    int end = stage.n_items();
    for (;;) {
        while (static_cast<int>(answers.size()) < end)
            answers.push_back(stage.run(static_cast<int>(answers.size())));
        const auto next = stage.next_round(answers);
        if (!next) return stage.conclude(answers).datasets[0].values;
        stage.begin_round(end, *next);
        end += next->n_items;
    }
}

Outcome run_walk(const SharedFolder& folder, WalkOptions walk,
                 ExecuteOptions options = {}) {
    Work work;
    work.stages.push_back(std::make_unique<Walk>(std::move(walk)));
    work.identity = {{"version", "1"}};
    work.frame.attributes = {{"program", "bemcal-batch"}, {"title", "walk"}};
    options.output = folder / "a.h5";
    if (options.n_threads == 0) options.n_threads = 1;
    return execute(world(), std::move(work), options);
}

ExecuteOptions resuming() {
    ExecuteOptions options;
    options.existing = Existing::resume;
    return options;
}

std::vector<double> stored_scores(const SharedFolder& folder) {
    for (const auto& dataset : store::read_result(folder / "a.h5").datasets)
        if (dataset.path == "office/walk/score") return dataset.values;
    return {};
}

TEST(Rounds, GoOnFromTheAnswersBeforeForAnyThreads) {
    for (const int n_threads : {1, 3}) {
        const SharedFolder folder;
        ExecuteOptions options;
        options.n_threads = n_threads;
        EXPECT_EQ(run_walk(folder, {}, options).code, ExitCode::ok);
        if (is_first()) {
            EXPECT_EQ(stored_scores(folder), plain_scores());
        }
    }
}

/// Two rounds after the first; what the second needs is always the same.
class Learns : public Walk {
  public:
    explicit Learns(double learned) : learned_(learned) {}
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        if (answers.size() >= 7) return std::nullopt;
        return study::Round{1, {answers.size() == 5 ? learned_ : 1}};
    }

  private:
    double learned_;
};

std::vector<std::uint64_t> checksums_of(double learned) {
    Learns stage(learned);
    std::vector<std::uint64_t> checksums;
    RoundOptions options;
    options.on_round = [&](const RoundStart& start) {
        checksums.push_back(start.checksum);
    };
    run_rounds(world(), stage, options);
    return checksums;
}

// Items that failed are done again: what was learned from the others was of less.
TEST(Rounds, AnAnswerIsOfAllThatRoundsBeforeNeeded) {
    const auto one = checksums_of(2), same = checksums_of(2), other = checksums_of(3);
    ASSERT_EQ(one.size(), 3U);
    EXPECT_EQ(one, same);
    EXPECT_EQ(one[0], other[0]);
    EXPECT_NE(one[1], other[1]);
    EXPECT_NE(one[2], other[2]);
}

TEST(Rounds, AStageThatAsksForNoneHasOne) {
    const SharedFolder folder;
    EXPECT_EQ(run_walk(folder, {1, -1, {}}).code, ExitCode::ok);
    if (is_first()) {
        EXPECT_EQ(stored_scores(folder), plain_scores(1));
    }
}

/// The logs of a run that was stopped, as if more ranks had written them than resume it.
void rename_logs(const std::filesystem::path& folder) {
    for (int rank = 0; rank < world().size(); ++rank)
        std::filesystem::rename(folder / ("rank-" + std::to_string(rank) + ".log"),
                                folder / ("rank-" + std::to_string(9 - rank) + ".log"));
}

TEST(Rounds, AfterASignalInAnyRoundResumeGivesTheSameResultFromOtherRanksLogs) {
    for (const int raises_at : {0, 5, 12, 20}) {
        const SharedFolder folder;
        const Outcome stopped = run_walk(folder, {5, raises_at, {}});
        EXPECT_EQ(stopped.code, ExitCode::more_to_do);
        std::size_t n_finished = 0;
        if (is_first()) {
            n_finished = store::read_logs(folder / "a.h5.part").records.size();
            rename_logs(folder / "a.h5.part");
        }
        world().barrier();
        EXPECT_EQ(run_walk(folder, {}, resuming()).code, ExitCode::ok);
        if (!is_first()) continue;
        EXPECT_EQ(stored_scores(folder), plain_scores());
        EXPECT_EQ(store::read_result(folder / "a.h5").run.at("items_resumed"),
                  std::to_string(n_finished));
    }
}

TEST(Rounds, StatusOfAnUnfinishedRunCountsTheItemsOfAllRounds) {
    const SharedFolder folder;
    ASSERT_EQ(run_walk(folder, {5, 20, {}}).code, ExitCode::more_to_do);
    if (!is_first()) return;
    const std::string text = part_status(folder / "a.h5.part");
    EXPECT_NE(text.find("items done, 5 of them in its first round"), std::string::npos)
        << text;
}

TEST(Rounds, AMissedTargetIsWrittenSaidAndInTheExitCodeOfEveryRank) {
    const SharedFolder folder;
    std::string said, printed;
    ExecuteOptions options;
    options.say = [&](const std::string& text) { said += text + "\n"; };
    options.on_stage = [&](const store::ResultFile& part) {
        for (const auto& dataset : part.datasets) printed += dataset.path + "\n";
    };
    EXPECT_EQ(run_walk(folder, {2, -1, "not converged: R-hat 1.2"}, options).code,
              ExitCode::not_reached);
    EXPECT_EQ(run_walk(folder, {2, -1, "not converged: R-hat 1.2"}, resuming()).code,
              ExitCode::not_reached);
    if (!is_first()) return;
    EXPECT_TRUE(store::read_result(folder / "a.h5").complete);
    EXPECT_NE(said.find("office/walk: not converged: R-hat 1.2"), std::string::npos);
    EXPECT_NE(printed.find("office/walk/shortfall"), std::string::npos);
}

}  // namespace
}  // namespace bemcal::run
