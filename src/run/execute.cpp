/// All stages of a job to one result: the place opened, items done before taken from the
/// logs, stages run in rounds and concluded, the result written, the logs removed.
/// Our own order of steps, without a source: an item is in a log before it counts. What a
/// stage does, and reading the job, are left to it and to run_job.
#include "run/execute.hpp"

#include "run/output_place.hpp"
#include "run/part_files.hpp"
#include "run/progress.hpp"
#include "run/progress_file.hpp"
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
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

constexpr int most_said = 5;  ///< of items that are done again, by name

/// "3 ranks"
std::string counted(int n, const char* noun) {
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

/// An error on the way, a full disk say, does not lose what is finished; says so, where
/// the error does not.
template <class Result>
Result keeping(const std::function<Result()>& step) {
    try {
        return step();
    } catch (const UserError& error) {
        const std::string said = error.what();
        if (said.find("--resume") != std::string::npos) throw;
        throw UserError(
            error.exit_code(),
            said + "; what is finished is kept: mend that and go on with --resume");
    }
}

class Execution {
  public:
    Execution(Comm& comm, Work work, const ExecuteOptions& options)
        : comm_(comm),
          kept_(std::make_shared<Work>(std::move(work))),
          work_(*kept_),
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
        if (is_complete_already()) return {agreed_code(), {}, true};
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

    std::filesystem::path folder() const { return part_folder_of(options_.output); }

    void open_place() {
        place_ = prepare_output(options_.output, options_.existing, work_.identity);
        if (place_.lock && !place_.lock->warning().empty()) say(place_.lock->warning());
        for (const std::string& remark : place_.remarks) say(remark);
        if (place_.is_complete) {
            const store::ResultFile result = store::read_result(options_.output);
            verdict_.take_shortfalls(result.datasets);
            verdict_.take_stored(result.run);
            if (place_.lock)
                drop_part();  // of a run that ended between its result and this
            return;
        }
        drop_outdated();
        const auto n_failed =
            options_.existing == Existing::rerun_failed ? drop_failed() : 0;
        n_resumed_ = place_.logs.records.size();
        if (n_failed > 0)
            say(fmt::format("doing again: {} that failed", counted(n_failed, "item")));
        if (n_resumed_ > 0 || place_.logs.n_damaged > 0)
            say(fmt::format(
                "resuming: {} items are done; damaged records, to be done again: {}",
                n_resumed_, place_.logs.n_damaged));
    }

    /// Forgets answers of an earlier run. \return how many
    int drop(const std::function<bool(const study::Stage&, int item,
                                      const study::ItemAnswer&)>& is_dropped) {
        const auto n_stages = static_cast<int>(work_.stages.size());
        return static_cast<int>(
            std::erase_if(place_.logs.records, [&](const auto& record) {
                const int stage = record.key.stage;
                return stage >= 0 && stage < n_stages &&
                       is_dropped(
                           *work_.stages[static_cast<std::size_t>(stage)],
                           record.key.item,
                           store::unpack(record.packed.data(), record.packed.size()));
            }));
    }

    /// Items that may succeed now.
    int drop_failed() {
        return drop([](const study::Stage& stage, int, const study::ItemAnswer& answer) {
            return deserves_rerun(stage, answer);
        });
    }

    /// Items that read what has changed since; says which.
    void drop_outdated() {
        int n_said = 0;
        const int n = drop(
            [&](const study::Stage& stage, int item, const study::ItemAnswer& answer) {
                const std::string why = stage.outdated(item, answer);
                if (!why.empty() && ++n_said <= most_said) say("doing again: " + why);
                return !why.empty();
            });
        if (n > most_said)
            say(fmt::format("doing again: {} more, for the same reason", n - most_said));
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
        if (work_.stages.size() == 1 && all_known)
            return fmt::format("{} {}", n, work_.stages[0]->counts());
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
        verdict_.take_shortfalls(work_.frame.datasets);
        if (is_first() && options_.on_stage) options_.on_stage(work_.frame);
    }

    void open_log() {
        if (!std::filesystem::exists(folder() / identity_name))
            throw UserError(ExitCode::cannot_create,
                            folder().string() +
                                ": rank 0 made it, but it cannot be seen here; the "
                                "output must lie on a disk that all hosts share");
        log_.emplace(folder(), comm_.rank(), mark_of(work_.identity));
        progress_ = is_first() ? std::make_unique<ProgressFile>(folder())
                               : std::make_unique<ProgressFile>();
    }

    /// What others did to the run's files; empty = nothing.
    std::string trouble() const {
        if (is_first() && !has_identity(folder(), work_.identity))
            return (folder() / identity_name).string() +
                   ": was removed or changed while the run was going on";
        if (is_first() && !place_.lock->is_still_there())
            return (folder() / lock_name).string() +
                   ": was removed while the run was going on, so that another may write "
                   "there";
        return log_ ? log_->trouble() : std::string();
    }

    /// What is lost then is not to be added to.
    void check_part() {
        const std::string said = trouble();
        if (said.empty()) return;
        throw UserError(ExitCode::io, said +
                                          "; the run ends, as what it finishes would "
                                          "be lost; what is left goes on with --resume");
    }

    /// Answers of an earlier run to items of a stage.
    Items known_items(int stage, int first, int count) {
        Items items{first, count, {}, {}};
        if (place_.logs.records.empty()) return items;
        items.known.resize(static_cast<std::size_t>(count));
        items.has.resize(static_cast<std::size_t>(count), false);
        for (auto& record : place_.logs.records) {
            const int k = record.key.item - first;
            if (record.key.stage != stage || record.key.start != start_ || k < 0 ||
                k >= count)
                continue;
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
        options.item_seconds = options_.item_seconds;
        options.keep = kept_;
        options.on_finished = [this, stage](int item, const Bytes& packed) {
            log_->append({stage, item, start_}, packed);
        };
        options.on_tick = [this] {
            if (log_->sync_if_due()) check_part();
        };
        options.on_hurry = [this] { log_->sync(); };
        options.on_progress = [&line](const Progress& progress) { line.show(progress); };
        options.on_stopping = [this, &line] {
            line.clear();
            say(fmt::format("stopping{}: waiting for the items that are running",
                            is_time_over() ? ", the time is over" : ""));
        };
        options.should_stop = [this] {
            return SignalWatch::stop_requested() ? Stopping::soon
                   : is_time_over()              ? Stopping::after_items
                                                 : Stopping::no;
        };
        return options;
    }

    /// \return false where it was stopped
    bool run_stage(int index) {
        study::Stage& stage = *work_.stages[static_cast<std::size_t>(index)];
        if (is_first()) stage.see(found_);
        ProgressLine line(stage, threads_.n_threads_total, *progress_);
        RoundOptions rounds;
        rounds.distribute = distribute_options(index, line);
        rounds.known = [&](int first, int count) {
            return known_items(index, first, count);
        };
        rounds.on_round = [&](const RoundStart& start) {
            start_ = start.checksum;
            line.begin_round(start.round);
        };
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
        progress_->write(stage.name() + ": all items are done, concluding");
        verdict_.count(stage, answers);
        store::ResultFile part;
        part.attributes = result_.attributes;
        study::Conclusion conclusion = stage.conclude(answers);
        part.datasets = std::move(conclusion.datasets);
        std::ranges::move(
            shortfall_datasets(stage, stage.shortfall(answers), conclusion.summaries),
            std::back_inserter(part.datasets));
        std::ranges::move(conclusion.summaries, std::back_inserter(found_));
        std::ranges::move(failed_item_datasets(stage, answers),
                          std::back_inserter(part.datasets));
        verdict_.take_shortfalls(part.datasets);
        if (options_.on_stage) options_.on_stage(part);
        std::ranges::move(part.datasets, std::back_inserter(result_.datasets));
    }

    Outcome stopped() {
        together(comm_, [&] {
            check_part();
            log_->close();
            progress_.reset();
        });
        say(fmt::format("stopped; what is finished is kept in {}; go on with {}",
                        folder().string(), how_to_go_on()));
        return {ExitCode::more_to_do, {}};
    }

    const char* how_to_go_on() const {
        return options_.existing == Existing::rerun_failed ? "--rerun-failed"
                                                           : "--resume";
    }

    Outcome finish() {
        spent_.n_threads = threads_.n_threads;
        if (log_) spent_.log = log_->seconds();
        result_.run["items_resumed"] = std::to_string(n_resumed_);
        describe_run(comm_, threads_, spent_, result_.run);
        verdict_.store(result_.run);
        Outcome outcome;
        keeping<void>([&] {
            together(comm_, [&] {
                if (is_first())
                    outcome.hash = store::write_result(
                        options_.output, result_,
                        {is_taken(folder()) ? folder() : "", place_.replace});
            });
        });
        const std::string said = trouble();
        log_.reset();
        progress_.reset();
        comm_.barrier();
        if (is_first()) close_place(outcome.hash, said);
        outcome.code = agreed_code();
        outcome.found = std::move(found_);
        return outcome;
    }

    /// The logs are kept where a failed item may succeed later, and those that hold what
    /// is not this run's.
    void drop_part() {
        if (verdict_.n_to_rerun() == 0) {
            for (const std::string& trouble :
                 remove_part_files(folder(), place_.logs.foreign))
                say(trouble);
            const PartFiles left = part_files(folder());
            if (!left.ours.empty() || !left.foreign.empty())
                say(fmt::format("left as it is, as the run did not make it: {} in {}",
                                names_of(left.ours.empty() ? left.foreign : left.ours),
                                folder().string()));
        }
        place_.lock.reset();
    }

    /// \param trouble  what others did to the run's files by now; the result is whole
    void close_place(const std::string& hash, const std::string& trouble) {
        drop_part();
        say(
            fmt::format("wrote {0}, result hash {1}; its tables again: bemcal-batch "
                        "report {0}",
                        options_.output.string(), hash));
        if (!trouble.empty()) {
            say(trouble + "; the result is whole");
            is_intact_ = false;
        }
        if (verdict_.n_to_rerun() > 0)
            say(
                fmt::format("failed: {}; the others are kept in {}, and --rerun-failed "
                            "does only the failed again",
                            counted(verdict_.n_to_rerun(), "item"), folder().string()));
    }

    /// Rank 0's verdict, on every rank: what failed must not look like success on any.
    ExitCode agreed_code() {
        for (const std::string& sentence : verdict_.sentences()) say(sentence);
        const bool is_worse = !is_intact_ && verdict_.code() != ExitCode::data;
        const Bytes mine{
            static_cast<std::byte>(is_worse ? ExitCode::io : verdict_.code())};
        return static_cast<ExitCode>(comm_.all_gather(mine)[0][0]);
    }

    Comm& comm_;
    std::shared_ptr<Work> kept_;  ///< also by threads that are left behind
    Work& work_;
    const ExecuteOptions& options_;
    OutputPlace place_;
    bool is_intact_ = true;  ///< the run's files, as far as is known
    std::optional<SyncedLog> log_;
    std::unique_ptr<ProgressFile> progress_;
    ThreadPlan threads_;
    store::ResultFile result_;
    std::vector<study::Summary> found_;  ///< rank 0's
    Spent spent_;
    std::size_t n_resumed_ = 0;
    std::uint64_t start_ = 0;  ///< checksum of what this round starts from
    Verdict verdict_;
};

}  // namespace

Outcome execute(Comm& comm, Work work, const ExecuteOptions& options) {
    const SignalWatch watch;
    return Execution(comm, std::move(work), options).run();
}

}  // namespace bemcal::run
