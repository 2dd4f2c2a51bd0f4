#include "run/execute.hpp"

#include "run/distribute.hpp"
#include "run/output_place.hpp"
#include "run/progress.hpp"
#include "run/signals.hpp"
#include "run/synced_log.hpp"
#include "run/threads.hpp"
#include "run/together.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace bemcal::run {
namespace {

std::string utc_now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(
                           std::chrono::system_clock::now())));
}

/// What a rank has spent, for /run. Doubles only, so that ranks can send it as it is.
struct Spent {
    double simulate = 0, conclude = 0, store = 0, log = 0, busy = 0, n_threads = 0;
};

class Execution {
  public:
    Execution(Comm& comm, Work work, const ExecuteOptions& options)
        : comm_(comm), work_(std::move(work)), options_(options) {
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
        if (is_complete_already()) return {};
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
        if (place_.is_complete) return;
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

    void announce() {
        threads_ = plan_threads(comm_, options_.n_threads);
        long long n_simulations = 0;
        for (const auto& stage : work_.stages) n_simulations += stage->n_simulations();
        say(fmt::format(
            "{}: {} stage{}, {} simulations; {} rank{}, {} compute thread{}; writing {}",
            title(), work_.stages.size(), work_.stages.size() == 1 ? "" : "s",
            n_simulations, comm_.size(), comm_.size() == 1 ? "" : "s",
            threads_.n_threads_total, threads_.n_threads_total == 1 ? "" : "s",
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

    /// Answers of an earlier run to a stage's items.
    std::vector<bool> known_answers(int stage, std::vector<study::ItemAnswer>& known) {
        const auto n = static_cast<std::size_t>(
            work_.stages[static_cast<std::size_t>(stage)]->n_items());
        std::vector<bool> has(n, false);
        if (place_.logs.records.empty()) return has;
        known.resize(n);
        for (auto& record : place_.logs.records) {
            const auto item = static_cast<std::size_t>(record.item);
            if (record.stage != stage || item >= n) continue;
            known[item] = store::unpack(record.packed.data(), record.packed.size());
            has[item] = true;
            record.packed = {};
        }
        return has;
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
            say("stopping: waiting for the items that are running");
        };
        options.should_stop = SignalWatch::stop_requested;
        return options;
    }

    /// An error on the way, a full disk say, does not lose what is finished; says so.
    template <class Result>
    static Result keeping(const std::function<Result()>& step) {
        try {
            return step();
        } catch (const UserError& error) {
            throw UserError(
                error.exit_code(),
                fmt::format("{}; what is finished is kept: mend that and go on with "
                            "--resume",
                            error.what()));
        }
    }

    /// \return false where it was stopped
    bool run_stage(int index) {
        const study::Stage& stage = *work_.stages[static_cast<std::size_t>(index)];
        std::vector<study::ItemAnswer> known;
        const std::vector<bool> has = known_answers(index, known);
        ProgressLine line(stage.name(), stage.n_simulations());
        Distributed done = keeping<Distributed>([&] {
            return distribute(comm_, stage, std::move(known), has,
                              distribute_options(index, line));
        });
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
        count_failures(stage, answers);
        store::ResultFile part;
        part.attributes = result_.attributes;
        part.datasets = stage.conclude(answers);
        if (options_.on_stage) options_.on_stage(part);
        std::ranges::move(part.datasets, std::back_inserter(result_.datasets));
    }

    void count_failures(const study::Stage& stage,
                        const std::vector<study::ItemAnswer>& answers) {
        const double per_item =
            static_cast<double>(stage.n_simulations()) / stage.n_items();
        n_points_ += static_cast<double>(stage.n_simulations());
        for (const auto& answer : answers) {
            n_failed_ += answer.error.empty()
                             ? static_cast<double>(answer.failures.size())
                             : per_item;
            if (!answer.error.empty() && first_error_.empty())
                first_error_ = answer.error;
            if (!answer.failures.empty() && first_error_.empty())
                first_error_ = answer.failures[0].reason;
        }
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
        describe_run();
        Outcome outcome;
        keeping<void>([&] {
            together(comm_, [&] {
                if (is_first()) outcome.hash = write();
            });
        });
        log_.reset();
        comm_.barrier();
        if (!is_first()) return {budget(), {}};
        lock_.reset();
        std::error_code ignored;
        std::filesystem::remove_all(part_folder_of(options_.output), ignored);
        say(
            fmt::format("wrote {0}, result hash {1}; its tables again: bemcal-batch "
                        "report {0}",
                        options_.output.string(), outcome.hash));
        outcome.code = budget();
        return outcome;
    }

    std::string write() {
        const Timer timer(spent_.store);
        return store::write_result(options_.output, result_);
    }

    /// Too many failures must not look like success, on any rank.
    ExitCode budget() {
        const bool is_over = is_first() && n_failed_ > work_.max_failed_share * n_points_;
        if (is_over)
            say(fmt::format(
                "{:.0f} of {:.0f} simulations failed, more than the share of {} that "
                "the job accepts; the first: {}",
                n_failed_, n_points_, work_.max_failed_share, first_error_));
        return is_over ? ExitCode::data : ExitCode::ok;
    }

    void describe_run() {
        Bytes mine(sizeof spent_);
        std::memcpy(mine.data(), &spent_, sizeof spent_);
        double busy = 0, available = 0, log = 0;
        for (const Bytes& bytes : comm_.all_gather(mine)) {
            Spent spent;
            std::memcpy(&spent, bytes.data(), sizeof spent);
            busy += spent.busy;
            available += spent.simulate * spent.n_threads;
            log = std::max(log, spent.log);
        }
        auto& run = result_.run;
        run["finished"] = utc_now();
        run["host"] = host_name();
        run["mpi"] = mpi_version();
        run["n_hosts"] = std::to_string(threads_.n_hosts);
        run["n_ranks"] = std::to_string(comm_.size());
        run["n_threads"] = std::to_string(threads_.n_threads_total);
        run["items_resumed"] = std::to_string(n_resumed_);
        run["seconds_simulate"] = fmt::format("{:.3f}", spent_.simulate);
        run["seconds_conclude"] = fmt::format("{:.3f}", spent_.conclude);
        run["seconds_log"] = fmt::format("{:.3f}", log);
        run["idle_share"] =
            fmt::format("{:.4f}", available > 0 ? 1 - busy / available : 0);
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
    double n_points_ = 0, n_failed_ = 0;
    std::string first_error_;
};

}  // namespace

Outcome execute(Comm& comm, Work work, const ExecuteOptions& options) {
    const SignalWatch watch;
    return Execution(comm, std::move(work), options).run();
}

}  // namespace bemcal::run
