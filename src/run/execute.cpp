#include "run/execute.hpp"

#include "run/output_place.hpp"
#include "run/progress.hpp"
#include "run/rounds.hpp"
#include "run/run_record.hpp"
#include "run/signals.hpp"
#include "run/synced_log.hpp"
#include "run/threads.hpp"
#include "run/timer.hpp"
#include "run/together.hpp"
#include "run/verdict.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

/// "3 ranks"
std::string counted(int n, const char* noun) {
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

/// An error on the way, a full disk say, does not lose what is finished; says so.
template <class Result>
Result keeping(const std::function<Result()>& step) {
    try {
        return step();
    } catch (const UserError& error) {
        throw UserError(
            error.exit_code(),
            fmt::format("{}; what is finished is kept: mend that and go on with --resume",
                        error.what()));
    }
}

class Execution {
  public:
    Execution(Comm& comm, Work work, const ExecuteOptions& options)
        : comm_(comm),
          work_(std::move(work)),
          options_(options),
          verdict_(work_.max_failed_share) {
        for (const auto& stage : work_.stages)
            work_.identity.emplace_back("stage " + stage->name(),
                                        fmt::format("{} items", stage->n_items()));
        result_ = work_.frame;
        result_.attributes["identity"] = hash_of(work_.identity);
        result_.run["started"] = utc_now();
    }

    Outcome run() {
        together(comm_, [&] {
            if (is_first()) open_place();
        });
        if (is_complete_already()) return {agreed_code(), {}};
        announce();
        together(comm_, [&] { open_log(); });
        for (std::size_t stage = 0; stage < work_.stages.size(); ++stage)
            if (!run_stage(static_cast<int>(stage))) return stopped();
        return finish();
    }

  private:
    bool is_first() const { return comm_.rank() == 0; }

    void say(const std::string& text) const {
        if (is_first() && options_.say) options_.say(text);
    }

    void open_place() {
        place_ = prepare_output(options_.output, options_.existing, work_.identity);
        if (place_.is_complete) {
            verdict_.take_shortfalls(store::read_result(options_.output).datasets);
            return;
        }
        lock_.emplace(part_folder_of(options_.output));
        n_resumed_ = place_.logs.records.size();
        if (n_resumed_ > 0 || place_.logs.n_damaged > 0)
            say(fmt::format(
                "resuming: {} items are done; damaged records, to be done again: {}",
                n_resumed_, place_.logs.n_damaged));
    }

    bool is_complete_already() {
        const Bytes flag{static_cast<std::byte>(place_.is_complete)};
        if (comm_.all_gather(flag)[0][0] == std::byte{0}) return false;
        say(fmt::format("{} is complete already: nothing to do",
                        options_.output.string()));
        return true;
    }

    std::string title() const {
        const auto found = work_.frame.attributes.find("title");
        return found == work_.frame.attributes.end() ? "job" : found->second;
    }

    /// A stage that goes on in rounds may not know how many it will need.
    std::string simulations() const {
        long long n = 0;
        bool all_known = true;
        for (const auto& stage : work_.stages) {
            n += stage->n_simulations();
            all_known = all_known && stage->n_simulations() > 0;
        }
        if (all_known) return fmt::format("{} simulations", n);
        return n > 0 ? fmt::format("{} simulations and as many more as it takes", n)
                     : "as many simulations as it takes";
    }

    void announce() {
        threads_ = plan_threads(comm_, options_.n_threads);
        say(fmt::format("{}: {}, {}; {}, {}; writing {}", title(),
                        counted(static_cast<int>(work_.stages.size()), "stage"),
                        simulations(), counted(comm_.size(), "rank"),
                        counted(threads_.n_threads_total, "compute thread"),
                        options_.output.string()));
        for (const std::string& warning : threads_.warnings) say("warning: " + warning);
        if (is_first() && options_.on_stage) options_.on_stage(work_.frame);
    }

    void open_log() {
        const auto folder = part_folder_of(options_.output);
        if (!std::filesystem::exists(folder / "identity.txt"))
            throw UserError(ExitCode::cannot_create,
                            folder.string() +
                                ": rank 0 made it, but it cannot be seen here; the "
                                "output must lie on a disk that all hosts share");
        log_.emplace(folder, comm_.rank());
    }

    /// Answers of an earlier run to items of a stage.
    Items known_items(int stage, int first, int count) {
        Items items{first, count, {}, {}};
        if (place_.logs.records.empty()) return items;
        items.known.resize(static_cast<std::size_t>(count));
        items.has.resize(static_cast<std::size_t>(count), false);
        for (auto& record : place_.logs.records) {
            const int k = record.item - first;
            if (record.stage != stage || k < 0 || k >= count) continue;
            const auto at = static_cast<std::size_t>(k);
            items.known[at] = store::unpack(record.packed.data(), record.packed.size());
            items.has[at] = true;
            record.packed = {};
        }
        return items;
    }

    bool is_time_over() const {
        return is_first() && options_.stop_at &&
               std::chrono::steady_clock::now() >= *options_.stop_at;
    }

    DistributeOptions distribute_options(int stage, ProgressLine& line) {
        DistributeOptions options;
        options.n_threads = threads_.n_threads;
        options.on_finished = [this, stage](int item, const Bytes& packed) {
            log_->append(stage, item, packed);
        };
        options.on_tick = [this] { log_->sync_if_due(); };
        options.on_progress = [&line](const Progress& progress) { line.show(progress); };
        options.on_stopping = [this, &line] {
            line.clear();
            say(fmt::format("stopping{}: waiting for the items that are running",
                            is_time_over() ? ", the time is over" : ""));
        };
        options.should_stop = [this] {
            return SignalWatch::stop_requested() || is_time_over();
        };
        return options;
    }

    /// \return false where it was stopped
    bool run_stage(int index) {
        study::Stage& stage = *work_.stages[static_cast<std::size_t>(index)];
        ProgressLine line(stage.name(), stage.n_simulations());
        RoundOptions rounds;
        rounds.distribute = distribute_options(index, line);
        rounds.known = [&](int first, int count) {
            return known_items(index, first, count);
        };
        rounds.on_round = [&](int round) { line.begin_round(round); };
        const Distributed done =
            keeping<Distributed>([&] { return run_rounds(comm_, stage, rounds); });
        line.clear();
        spent_.simulate += done.seconds;
        spent_.busy += done.busy_seconds;
        if (done.stopped) return false;
        together(comm_, [&] {
            if (is_first()) conclude(stage, done.answers);
        });
        return true;
    }

    void conclude(const study::Stage& stage,
                  const std::vector<study::ItemAnswer>& answers) {
        const Timer timer(spent_.conclude);
        verdict_.count(stage, answers);
        store::ResultFile part;
        part.attributes = result_.attributes;
        part.datasets = stage.conclude(answers);
        const std::string missed = stage.shortfall(answers);
        if (!missed.empty()) part.datasets.push_back(shortfall_dataset(stage, missed));
        verdict_.take_shortfalls(part.datasets);
        if (options_.on_stage) options_.on_stage(part);
        std::ranges::move(part.datasets, std::back_inserter(result_.datasets));
    }

    Outcome stopped() {
        together(comm_, [&] { log_->sync(); });
        say(fmt::format("stopped; what is finished is kept in {}; go on with --resume",
                        part_folder_of(options_.output).string()));
        return {ExitCode::more_to_do, {}};
    }

    Outcome finish() {
        spent_.n_threads = threads_.n_threads;
        if (log_) spent_.log = log_->seconds();
        result_.run["items_resumed"] = std::to_string(n_resumed_);
        describe_run(comm_, threads_, spent_, result_.run);
        Outcome outcome;
        keeping<void>([&] {
            together(comm_, [&] {
                if (is_first())
                    outcome.hash = store::write_result(options_.output, result_);
            });
        });
        log_.reset();
        comm_.barrier();
        if (is_first()) remove_part(outcome.hash);
        outcome.code = agreed_code();
        return outcome;
    }

    void remove_part(const std::string& hash) {
        lock_.reset();
        std::error_code ignored;
        std::filesystem::remove_all(part_folder_of(options_.output), ignored);
        say(
            fmt::format("wrote {0}, result hash {1}; its tables again: bemcal-batch "
                        "report {0}",
                        options_.output.string(), hash));
    }

    /// Rank 0's verdict, on every rank: what failed must not look like success on any.
    ExitCode agreed_code() {
        for (const std::string& sentence : verdict_.sentences()) say(sentence);
        const Bytes mine{static_cast<std::byte>(verdict_.code())};
        return static_cast<ExitCode>(comm_.all_gather(mine)[0][0]);
    }

    Comm& comm_;
    Work work_;
    const ExecuteOptions& options_;
    OutputPlace place_;
    std::optional<FolderLock> lock_;
    std::optional<SyncedLog> log_;
    ThreadPlan threads_;
    store::ResultFile result_;
    Spent spent_;
    std::size_t n_resumed_ = 0;
    Verdict verdict_;
};

}  // namespace

Outcome execute(Comm& comm, Work work, const ExecuteOptions& options) {
    const SignalWatch watch;
    return Execution(comm, std::move(work), options).run();
}

}  // namespace bemcal::run
