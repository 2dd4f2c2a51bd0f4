#include "run/execute.hpp"
#include "run/output_place.hpp"
#include "run/signals.hpp"
#include "run/together.hpp"
#include "run/verdict.hpp"
#include "support/fake_stage.hpp"
#include "support/mpi_world.hpp"
#include "support/shared_folder.hpp"

#include <atomic>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

namespace bemcal::run {
namespace {

using test::FakeStage;
using test::SharedFolder;
using test::world;

bool is_first() {
    return world().rank() == 0;
}
bool is_last() {
    return world().rank() == world().size() - 1;
}

using Sleep = std::chrono::microseconds;

Work work_of(Sleep sleep = Sleep{0}, const std::string& input = "1234") {
    Work work;
    work.stages.push_back(
        std::make_unique<FakeStage>("a", FakeStage::Options{200, sleep, -1}));
    work.stages.push_back(
        std::make_unique<FakeStage>("b", FakeStage::Options{50, sleep, 17}));
    work.identity = {{"version", "1"}, {"file weather.csv", input}};
    work.frame.attributes = {{"program", "bemcal-batch"}, {"title", "fake"}};
    return work;
}

ExecuteOptions options_of(const std::filesystem::path& output, Existing existing,
                          int n_threads = 1) {
    ExecuteOptions options;
    options.output = output;
    options.existing = existing;
    options.n_threads = n_threads;
    return options;
}

/// What plain loops over the items give: the hash that every run must have.
std::string expected_hash(const SharedFolder& folder) {
    static std::string hash;
    if (!hash.empty() || !is_first()) return hash;
    store::ResultFile result = work_of().frame;
    for (const auto& stage : work_of().stages) {
        std::vector<study::ItemAnswer> answers;
        for (int item = 0; item < stage->n_items(); ++item) {
            answers.emplace_back();
            try {
                answers.back() = stage->run(item);
            } catch (const std::exception& error) {
                answers.back().error = error.what();
            }
        }
        for (auto& dataset : stage->conclude(answers).datasets)
            result.datasets.push_back(std::move(dataset));
        for (auto& dataset : failed_item_datasets(*stage, answers))
            result.datasets.push_back(std::move(dataset));
    }
    result.attributes["identity"] =
        store::read_result(folder / "a.h5").attributes.at("identity");
    return hash = store::result_hash(result);
}

void expect_complete(const SharedFolder& folder, const Outcome& outcome) {
    EXPECT_EQ(outcome.code, ExitCode::ok);
    if (!is_first()) return;
    EXPECT_EQ(outcome.hash, expected_hash(folder));
    EXPECT_EQ(store::read_result(folder / "a.h5").hash, outcome.hash);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.h5.part")) << "one item failed";
    EXPECT_FALSE(is_unfinished(folder / "a.h5"));
}

ExitCode code_of(Work work, const ExecuteOptions& options,
                 std::string* message = nullptr) {
    try {
        return execute(world(), std::move(work), options).code;
    } catch (const UserError& error) {
        if (message) *message = error.what();
        return error.exit_code();
    }
}

/// Runs slowly until the last rank gets a signal, which it sends itself after some items.
void stop_early(const SharedFolder& folder, int signal) {
    Work work = work_of(std::chrono::milliseconds(1));
    class Raising : public FakeStage {
      public:
        Raising(const FakeStage::Options& options, int signal)
            : FakeStage("a", options), signal_(signal) {}
        study::ItemAnswer run(int item) const override {
            if (item >= 40 && is_last() && !raised_.exchange(true)) ::raise(signal_);
            return FakeStage::run(item);
        }

      private:
        int signal_;
        mutable std::atomic<bool> raised_ = false;
    };
    work.stages[0] = std::make_unique<Raising>(
        FakeStage::Options{200, std::chrono::milliseconds(2), -1}, signal);
    EXPECT_EQ(code_of(std::move(work), options_of(folder / "a.h5", Existing::refuse)),
              ExitCode::more_to_do);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(Execute, GivesTheHashOfPlainLoopsForAnyThreads) {
    for (const int n_threads : {1, 2, 3, 4}) {
        const SharedFolder folder;
        expect_complete(
            folder, execute(world(), work_of(),
                            options_of(folder / "a.h5", Existing::refuse, n_threads)));
    }
}

TEST(Execute, AfterASignalOnTheLastRankResumeGivesTheSameHash) {
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
        const SharedFolder folder;
        stop_early(folder, signal);
        expect_complete(folder, execute(world(), work_of(),
                                        options_of(folder / "a.h5", Existing::resume)));
    }
}

TEST(Execute, AfterItsTimeItStopsOnAllRanksAndResumeGivesTheSameHash) {
    const SharedFolder folder;
    ExecuteOptions options = options_of(folder / "a.h5", Existing::refuse);
    options.stop_at = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    EXPECT_EQ(code_of(work_of(std::chrono::milliseconds(10)), options),
              ExitCode::more_to_do);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
    expect_complete(folder, execute(world(), work_of(),
                                    options_of(folder / "a.h5", Existing::resume)));
}

TEST(Execute, ResumeDoesNotRepeatWhatIsFinished) {
    const SharedFolder folder;
    stop_early(folder, SIGTERM);
    std::size_t n_finished = 0;
    if (is_first()) n_finished = store::read_logs(folder / "a.h5.part").records.size();
    execute(world(), work_of(), options_of(folder / "a.h5", Existing::resume));
    if (!is_first()) return;
    EXPECT_GT(n_finished, 0U);
    EXPECT_EQ(store::read_result(folder / "a.h5").run.at("items_resumed"),
              std::to_string(n_finished));
}

TEST(Execute, DamagedRecordsAreDoneAgain) {
    const SharedFolder folder;
    stop_early(folder, SIGTERM);
    if (is_first())
        for (const auto& entry :
             std::filesystem::directory_iterator(folder / "a.h5.part"))
            if (entry.path().extension() == ".log" && entry.file_size() > 200) {
                std::fstream log(entry.path(),
                                 std::ios::in | std::ios::out | std::ios::binary);
                log.seekp(100);
                log.write("damage", 6);
            }
    world().barrier();
    expect_complete(folder, execute(world(), work_of(),
                                    options_of(folder / "a.h5", Existing::resume)));
}

TEST(Execute, ResumeWithNothingThereStartsAndWithAResultThereEnds) {
    const SharedFolder folder;
    const ExecuteOptions options = options_of(folder / "a.h5", Existing::resume);
    expect_complete(folder, execute(world(), work_of(), options));
    EXPECT_EQ(code_of(work_of(), options), ExitCode::ok);
    EXPECT_EQ(code_of(work_of(Sleep{0}, "changed"), options), ExitCode::cannot_create);
}

TEST(Execute, RefusesAResultAndAnUnfinishedRunThatAreThere) {
    const SharedFolder folder;
    const ExecuteOptions refuse = options_of(folder / "a.h5", Existing::refuse);
    stop_early(folder, SIGTERM);
    EXPECT_EQ(code_of(work_of(), refuse), ExitCode::cannot_create);
    expect_complete(folder, execute(world(), work_of(),
                                    options_of(folder / "a.h5", Existing::force)));
    EXPECT_EQ(code_of(work_of(), refuse), ExitCode::cannot_create);
    expect_complete(folder, execute(world(), work_of(),
                                    options_of(folder / "a.h5", Existing::force)));
}

TEST(Execute, RefusesToResumeWithOtherDataAndNamesThem) {
    const SharedFolder folder;
    stop_early(folder, SIGTERM);
    std::string message;
    EXPECT_EQ(code_of(work_of(Sleep{0}, "changed"),
                      options_of(folder / "a.h5", Existing::resume), &message),
              ExitCode::cannot_create);
    EXPECT_NE(message.find("weather.csv has changed"), std::string::npos) << message;
}

/// Some items throw, or take long, as long as the first flag is up; counts what was run.
struct Trouble {
    std::atomic<bool> is_there = true;
    std::atomic<int> n_run = 0;
    std::chrono::milliseconds sleep{0};  ///< 0: throws
};

class Troubled : public FakeStage {
  public:
    explicit Troubled(std::shared_ptr<Trouble> trouble)
        : FakeStage("a", {60, {}, -1}), trouble_(std::move(trouble)) {}
    study::ItemAnswer run(int item) const override {
        ++trouble_->n_run;
        if (item % 20 != 7 || !trouble_->is_there) return FakeStage::run(item);
        if (trouble_->sleep.count() == 0) throw std::runtime_error("no licence");
        std::this_thread::sleep_for(trouble_->sleep);
        return FakeStage::run(item);
    }

  private:
    std::shared_ptr<Trouble> trouble_;
};

Work troubled(const std::shared_ptr<Trouble>& trouble) {
    Work work;
    work.stages.push_back(std::make_unique<Troubled>(trouble));
    work.identity = {{"version", "1"}};
    work.frame.attributes = {{"program", "bemcal-batch"}, {"title", "troubled"}};
    return work;
}

/// Of a run without trouble, in a folder of its own.
std::string untroubled_hash() {
    const SharedFolder folder;
    const auto trouble = std::make_shared<Trouble>();
    trouble->is_there = false;
    const Outcome outcome = execute(world(), troubled(trouble),
                                    options_of(folder / "a.h5", Existing::refuse));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    return outcome.hash;
}

std::vector<std::string> failed_reasons(const SharedFolder& folder) {
    for (const auto& dataset : store::read_result(folder / "a.h5").datasets)
        if (dataset.path == "a/failed_item_reason") return dataset.texts;
    return {};
}

int over_all_ranks(int n) {
    int sum = 0;
    for (const Bytes& bytes : world().all_gather({static_cast<std::byte>(n)}))
        sum += static_cast<int>(bytes[0]);
    return sum;
}

TEST(Execute, RerunFailedDoesOnlyTheFailedItemsAndEndsAsIfTheyHadNotFailed) {
    const std::string expected = untroubled_hash();
    const SharedFolder folder;
    const auto trouble = std::make_shared<Trouble>();
    const ExecuteOptions rerun = options_of(folder / "a.h5", Existing::rerun_failed);
    EXPECT_EQ(code_of(troubled(trouble), options_of(folder / "a.h5", Existing::refuse)),
              ExitCode::ok);
    if (is_first()) {
        EXPECT_EQ(failed_reasons(folder), std::vector<std::string>(3, "no licence"));
        EXPECT_EQ(store::read_result(folder / "a.h5").run.at("items_to_rerun"), "3");
    }
    trouble->is_there = false;
    trouble->n_run = 0;
    const Outcome outcome = execute(world(), troubled(trouble), rerun);
    EXPECT_EQ(outcome.hash, expected);
    EXPECT_EQ(over_all_ranks(trouble->n_run), 3);
    EXPECT_EQ(code_of(troubled(trouble), rerun), ExitCode::cannot_create);
}

TEST(Execute, RerunFailedOfWhatStillFailsKeepsTheReason) {
    const SharedFolder folder;
    const auto trouble = std::make_shared<Trouble>();
    execute(world(), troubled(trouble), options_of(folder / "a.h5", Existing::refuse));
    execute(world(), troubled(trouble),
            options_of(folder / "a.h5", Existing::rerun_failed));
    if (is_first()) {
        EXPECT_EQ(failed_reasons(folder), std::vector<std::string>(3, "no licence"));
    }
}

TEST(Execute, AnItemOverItsTimeIsUnfinishedTheOthersGoOnAndItCanBeDoneAgain) {
    const std::string expected = untroubled_hash();
    const SharedFolder folder;
    const auto trouble = std::make_shared<Trouble>();
    trouble->sleep = std::chrono::seconds(6);
    ExecuteOptions options = options_of(folder / "a.h5", Existing::refuse);
    options.item_seconds = 0.3;
    execute(world(), troubled(trouble), options);
    if (is_first()) {
        EXPECT_EQ(failed_reasons(folder),
                  std::vector<std::string>(
                      3, "unfinished: took longer than 0.3 s (--item-seconds)"));
    }
    trouble->is_there = false;
    trouble->n_run = 0;
    options.existing = Existing::rerun_failed;
    EXPECT_EQ(execute(world(), troubled(trouble), options).hash, expected);
    EXPECT_EQ(over_all_ranks(trouble->n_run), 3);
}

TEST(Execute, ASignalDoesNotWaitForALongItem) {
    const SharedFolder folder;
    const auto trouble = std::make_shared<Trouble>();
    trouble->sleep = std::chrono::seconds(20);
    class Raising : public Troubled {
      public:
        using Troubled::Troubled;
        study::ItemAnswer run(int item) const override {
            if (item == 7) ::raise(SIGUSR1);
            return Troubled::run(item);
        }
    };
    Work work = troubled(trouble);
    work.stages[0] = std::make_unique<Raising>(trouble);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(code_of(std::move(work), options_of(folder / "a.h5", Existing::refuse)),
              ExitCode::more_to_do);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    trouble->is_there = false;
    const Outcome outcome = execute(world(), troubled(trouble),
                                    options_of(folder / "a.h5", Existing::resume));
    const std::string expected = untroubled_hash();
    EXPECT_EQ(outcome.hash, expected);
}

TEST(Execute, AStageOfWhichNothingSucceededIsAFailedBatchAlsoWhenResumed) {
    class Failing : public FakeStage {
      public:
        using FakeStage::FakeStage;
        study::ItemAnswer run(int) const override {
            throw std::runtime_error("no licence");
        }
    };
    const SharedFolder folder;
    const auto work = [] {
        Work all = work_of();
        all.stages[1] = std::make_unique<Failing>("b", FakeStage::Options{50, {}, -1});
        return all;
    };
    EXPECT_EQ(code_of(work(), options_of(folder / "a.h5", Existing::refuse)),
              ExitCode::data);
    EXPECT_EQ(code_of(work(), options_of(folder / "a.h5", Existing::resume)),
              ExitCode::data);
}

TEST(Execute, AFolderThatCannotBeMadeIsRefusedOnAllRanks) {
    const SharedFolder folder;
    if (is_first()) std::ofstream(folder / "file") << "x";
    world().barrier();
    EXPECT_EQ(code_of(work_of(), options_of(folder / "file" / "a.h5", Existing::refuse)),
              ExitCode::cannot_create);
}

TEST(Execute, ADiskThatFillsUpOnTheLastRankEndsAllAndLosesNothing) {
    const SharedFolder folder;
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{1500, old.rlim_max};
    if (is_last()) ::setrlimit(RLIMIT_FSIZE, &small);
    std::string message;
    const ExitCode code =
        code_of(work_of(std::chrono::milliseconds(1)),
                options_of(folder / "a.h5", Existing::refuse), &message);
    ::setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(code, ExitCode::io);
    EXPECT_NE(message.find("--resume"), std::string::npos) << message;
    expect_complete(folder, execute(world(), work_of(),
                                    options_of(folder / "a.h5", Existing::resume)));
}

/// One of its items meets something that no input is to blame for, as long as the flag is
/// up.
class Meeting : public FakeStage {
  public:
    Meeting(std::shared_ptr<std::atomic<bool>> is_there, std::function<void()> meets)
        : FakeStage("a", {60, std::chrono::milliseconds(1), -1}),
          is_there_(std::move(is_there)),
          meets_(std::move(meets)) {}
    study::ItemAnswer run(int item) const override {
        if (item == 33 && *is_there_) meets_();
        return FakeStage::run(item);
    }

  private:
    std::shared_ptr<std::atomic<bool>> is_there_;
    std::function<void()> meets_;
};

TEST(Execute, WhatTheMachineRefusesIsNeverAnAnswerAndTheRunGoesOnLater) {
    const std::tuple<std::function<void()>, ExitCode, const char*> cases[] = {
        {[] { throw std::bad_alloc(); }, ExitCode::os, "memory"},
        {[] { throw std::system_error(EAGAIN, std::generic_category(), "thread"); },
         ExitCode::os, "thread"},
        {[] { throw std::system_error(ENOSPC, std::generic_category(), "file"); },
         ExitCode::io, "file"},
        {[] { throw std::logic_error("cannot be"); }, ExitCode::software,
         "program error: cannot be"}};
    for (const auto& [meets, code, words] : cases) {
        const SharedFolder folder;
        const auto is_there = std::make_shared<std::atomic<bool>>(true);
        const auto work = [&] {
            Work made;
            made.stages.push_back(std::make_unique<Meeting>(is_there, meets));
            made.identity = {{"version", "1"}};
            made.frame.attributes = {{"program", "bemcal-batch"}};
            return made;
        };
        std::string message;
        EXPECT_EQ(
            code_of(work(), options_of(folder / "a.h5", Existing::refuse), &message),
            code);
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_NE(message.find("--resume"), std::string::npos) << message;
        *is_there = false;
        EXPECT_EQ(code_of(work(), options_of(folder / "a.h5", Existing::resume)),
                  ExitCode::ok);
        if (is_first()) {
            EXPECT_TRUE(failed_reasons(folder).empty());
        }
    }
}

/// Calls something in the middle of a run, once, on rank 0.
class Disturbed : public FakeStage {
  public:
    explicit Disturbed(std::function<void()> disturb)
        : FakeStage("a", {1000, std::chrono::milliseconds(10), -1}),
          disturb_(std::move(disturb)) {}
    study::ItemAnswer run(int item) const override {
        if (is_first() && item >= 20 && !is_done_.exchange(true)) disturb_();
        return FakeStage::run(item);
    }

  private:
    std::function<void()> disturb_;
    mutable std::atomic<bool> is_done_ = false;
};

TEST(Execute, NoticesWhatOthersDoToItsFilesAndSaysIt) {
    namespace fs = std::filesystem;
    const SharedFolder folder;
    const fs::path part = folder / "a.h5.part";
    const std::pair<std::function<void()>, const char*> disturbances[] = {
        {[&] { fs::remove_all(part); }, "was removed"},
        {[&] { fs::remove(part / "identity.txt"); }, "identity.txt: was removed"},
        {[&] { std::ofstream(part / "identity.txt") << "version\t9\n"; },
         "identity.txt: was removed or changed"},
        {[&] { fs::remove(part / "lock"); }, "lock: was removed"},
        {[&] { fs::remove(part / "rank-0.log"); }, "rank-0.log: was removed"},
        {[&] { fs::resize_file(part / "rank-0.log", 3); }, "rank-0.log: was changed"}};
    for (const auto& [disturb, words] : disturbances) {
        Work work;
        work.stages.push_back(std::make_unique<Disturbed>(disturb));
        work.identity = {{"version", "1"}};
        std::string message;
        const auto begin = std::chrono::steady_clock::now();
        ExecuteOptions options = options_of(folder / "a.h5", Existing::force);
        EXPECT_EQ(code_of(std::move(work), options, &message), ExitCode::io) << words;
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_EQ(message.find("what is finished is kept"), std::string::npos) << message;
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
        world().barrier();
    }
}

TEST(Execute, WhatIsNoticedAtTheEndIsACodeAndTheResultIsWhole) {
    const SharedFolder folder;
    class Late : public FakeStage {
      public:
        explicit Late(std::filesystem::path part)
            : FakeStage("a", {20, {}, -1}), part_(std::move(part)) {}
        study::Conclusion conclude(
            const std::vector<study::ItemAnswer>& answers) const override {
            std::filesystem::remove_all(part_);
            return FakeStage::conclude(answers);
        }

      private:
        std::filesystem::path part_;
    };
    Work work;
    work.stages.push_back(std::make_unique<Late>(folder / "a.h5.part"));
    work.identity = {{"version", "1"}};
    work.frame.attributes = {{"program", "bemcal-batch"}};
    EXPECT_EQ(code_of(std::move(work), options_of(folder / "a.h5", Existing::refuse)),
              ExitCode::io);
    if (is_first()) {
        EXPECT_TRUE(store::is_sound(store::read_result(folder / "a.h5")));
        EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    }
}

TEST(Execute, AFileThatAppearsUnderTheResultsNameIsKept) {
    const SharedFolder folder;
    class Appearing : public FakeStage {
      public:
        explicit Appearing(std::filesystem::path file)
            : FakeStage("a", {20, {}, -1}), file_(std::move(file)) {}
        study::Conclusion conclude(
            const std::vector<study::ItemAnswer>& answers) const override {
            std::ofstream(file_) << "somebody's";
            return FakeStage::conclude(answers);
        }

      private:
        std::filesystem::path file_;
    };
    Work work;
    work.stages.push_back(std::make_unique<Appearing>(folder / "a.h5"));
    work.identity = {{"version", "1"}};
    work.frame.attributes = {{"program", "bemcal-batch"}};
    std::string message;
    EXPECT_EQ(
        code_of(std::move(work), options_of(folder / "a.h5", Existing::refuse), &message),
        ExitCode::cannot_create)
        << message;
    EXPECT_NE(message.find("what is finished is kept"), std::string::npos) << message;
    if (is_first()) {
        EXPECT_EQ(read_regular(folder / "a.h5"), "somebody's");
    }
}

TEST(Execute, MoreFailuresThanTheJobAcceptsAreNoSuccessButTheResultIsThere) {
    const SharedFolder folder;
    Work work = work_of();
    work.max_failed_share = 0.001;
    const ExitCode code =
        code_of(std::move(work), options_of(folder / "a.h5", Existing::refuse));
    EXPECT_EQ(code, ExitCode::data);
    if (is_first()) {
        EXPECT_TRUE(store::read_result(folder / "a.h5").complete);
    }
}

TEST(Together, AnErrorOnTheLastRankIsThrownOnAll) {
    try {
        together(world(), [] {
            if (is_last()) throw UserError(ExitCode::data, "bad row");
        });
        ADD_FAILURE() << "nothing was thrown";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        EXPECT_NE(std::string(error.what()).find("bad row"), std::string::npos);
    }
}

}  // namespace
}  // namespace bemcal::run
