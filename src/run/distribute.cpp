/// Items over ranks and threads: rank 0 hands out blocks and collects answers, each
/// rank's main thread talks between it and its compute threads; stops and errors reach
/// all.
/// Our own protocol (tags in wire), without a source. What an item does is the stage's;
/// order of blocks is schedule's. A dead rank is not replaced.
#include "run/distribute.hpp"

#include "base/machine.hpp"
#include "run/pool.hpp"
#include "run/schedule.hpp"
#include "run/together.hpp"
#include "run/wire.hpp"
#include "store/item_log.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

namespace bemcal::run {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
constexpr microseconds shortest_wait{100}, longest_wait{5000};
constexpr std::chrono::seconds grace{1};         ///< of what runs when all must stop soon
constexpr std::chrono::seconds asking_pause{1};  ///< a line is written as often
constexpr std::size_t message_bytes =
    1U << 24;  ///< an answers message is sent when this long

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void send(Comm& comm, int to, Tag tag, Bytes data) {
    comm.send(to, static_cast<int>(tag), std::move(data));
}

/// Rank 0's other half: hands out items, collects answers, decides when it is over.
class Master {
  public:
    Master(Comm& comm, const study::Stage& stage, Items items,
           const DistributeOptions& options)
        : comm_(comm),
          stage_(stage),
          options_(options),
          first_(items.first),
          answers_(std::move(items.known)),
          schedule_(missing(items), comm.size()),
          activities_(static_cast<std::size_t>(comm.size())) {
        answers_.resize(static_cast<std::size_t>(items.count));
        progress_.items_total = items.count;
        progress_.items_known = static_cast<int>(std::ranges::count(items.has, true));
        progress_.items_done = progress_.items_known;
        for (const auto& answer : answers_) count_failures(answer);
        schedule_.join(0, options.n_threads);
    }

    void receive(const Comm::Message& message) {
        switch (static_cast<Tag>(message.tag)) {
            case Tag::hello:
                schedule_.join(message.source, to_numbers(message.data)[0]);
                break;
            case Tag::answers:
                take_answers(message);
                break;
            case Tag::ask_stop:
                stop(to_stop(message.data));
                break;
            case Tag::stopped:
                ++n_stopped_;
                break;
            case Tag::activity:
                --n_asked_;
                activities_[static_cast<std::size_t>(message.source)] =
                    to_activity(message.data);
                break;
            default:
                break;
        }
    }

    /// Sends what is due; once all is done, or all have stopped, and nobody is to answer,
    /// ends every rank's loop.
    void hand_out() {
        const bool is_over =
            is_stopping_ ? n_stopped_ == comm_.size() : schedule_.is_complete();
        if (is_over && n_asked_ == 0 && !has_ended_) {
            has_ended_ = true;
            send_to_all(Tag::finish);
        }
        if (is_stopping_) return;
        for (auto& block : schedule_.blocks_due())
            send(comm_, block.rank, Tag::work, to_bytes(block.items));
    }

    void show_progress() {
        if (!options_.on_progress || seconds_since(shown_) < 0.2) return;
        shown_ = Clock::now();
        ask_how_far();
        progress_.seconds = seconds_since(began_);
        activities_[0] = stage_.activity();
        progress_.activity = study::of_all(activities_);
        options_.on_progress(progress_);
    }

    std::vector<study::ItemAnswer> take() { return std::move(answers_); }

  private:
    static std::vector<int> missing(const Items& items) {
        std::vector<int> todo;
        for (int k = 0; k < items.count; ++k)
            if (items.has.empty() || !items.has[static_cast<std::size_t>(k)])
                todo.push_back(items.first + k);
        return todo;
    }

    void count_failures(const study::ItemAnswer& answer) {
        progress_.points_failed += static_cast<long long>(answer.failures.size()) +
                                   (answer.error.empty() ? 0 : 1);
    }

    /// The other ranks, once all have answered.
    void ask_how_far() {
        if (has_ended_ || n_asked_ > 0 || Clock::now() - asked_ < asking_pause) return;
        asked_ = Clock::now();
        n_asked_ = comm_.size() - 1;
        for (int rank = 1; rank < comm_.size(); ++rank)
            send(comm_, rank, Tag::how_far, {});
    }

    void take_answers(const Comm::Message& message) {
        for_each_answer(
            message.data, [&](int item, const std::byte* data, std::size_t bytes) {
                auto& answer = answers_[static_cast<std::size_t>(item - first_)];
                answer = store::unpack(data, bytes);
                count_failures(answer);
                ++progress_.items_done;
                schedule_.finished(message.source);
            });
    }

    void stop(const Stop& reason) {
        if (has_ended_) return;
        const bool is_news = !is_stopping_ || reason.how > reason_.how;
        if (reason_.text.empty()) reason_ = reason;
        if (!is_news) return;
        if (!std::exchange(is_stopping_, true) && options_.on_stopping &&
            reason.text.empty())
            options_.on_stopping();
        send_to_all(Tag::stop);
    }

    void send_to_all(Tag tag) {
        for (int rank = 0; rank < comm_.size(); ++rank)
            send(comm_, rank, tag, to_bytes(reason_));
    }

    Comm& comm_;
    const study::Stage& stage_;
    const DistributeOptions& options_;
    int first_;
    std::vector<study::ItemAnswer> answers_;
    Schedule schedule_;
    Progress progress_;
    Clock::time_point began_ = Clock::now(), shown_{}, asked_ = began_;
    Stop reason_;
    bool is_stopping_ = false, has_ended_ = false;
    int n_stopped_ = 0;
    int n_asked_ = 0;  ///< ranks that have not told yet how far they are
    std::vector<study::Activity> activities_;  ///< [rank]
};

/// A rank's main thread: between rank 0 and the rank's compute threads.
class Talker {
  public:
    Talker(Comm& comm, const study::Stage& stage, Pool& pool, Master* master,
           const DistributeOptions& options)
        : comm_(comm), stage_(stage), pool_(pool), master_(master), options_(options) {}

    /// Until rank 0 says finish. \return why it ended
    Stop talk() {
        if (!master_)
            send(comm_, 0, Tag::hello, to_bytes(std::vector<int>{options_.n_threads}));
        microseconds wait = shortest_wait;
        while (!is_over_) {
            const bool received = receive_all();
            const bool delivered = deliver(pool_.take(received ? microseconds{0} : wait));
            watch();
            const bool active = received || delivered || comm_.is_sending();
            wait = active ? shortest_wait : std::min(longest_wait, wait * 2);
        }
        return reason_;
    }

  private:
    bool receive_all() {
        bool any = false;
        for (auto message = comm_.poll(); message && !is_over_; message = comm_.poll()) {
            any = true;
            receive(*message);
            if (is_over_) break;
        }
        return any;
    }

    void receive(const Comm::Message& message) {
        switch (static_cast<Tag>(message.tag)) {
            case Tag::work:
                pool_.push(to_numbers(message.data));
                break;
            case Tag::stop:
                stop(to_stop(message.data).how);
                break;
            case Tag::how_far:
                send(comm_, 0, Tag::activity, to_bytes(stage_.activity()));
                break;
            case Tag::finish:
                is_over_ = true;
                reason_ = to_stop(message.data);
                break;
            default:
                if (master_) master_->receive(message);
        }
    }

    void stop(Stopping how) {
        if (how == Stopping::soon && !leave_at_) leave_at_ = Clock::now() + grace;
        if (std::exchange(is_stopping_, true)) return;
        pool_.drop();
        guarded(options_.on_hurry);
    }

    /// Logs finished items and sends them to rank 0; after an error they are lost on
    /// purpose.
    bool deliver(const std::vector<Finished>& finished) {
        Bytes message;
        for (const Finished& each : finished) {
            if (!keep(each)) break;
            append(message, each);
            if (message.size() >= message_bytes)
                send(comm_, 0, Tag::answers, std::exchange(message, {}));
        }
        if (!message.empty()) send(comm_, 0, Tag::answers, std::move(message));
        if (is_stopping_ && !finished.empty()) guarded(options_.on_hurry);
        return !finished.empty();
    }

    bool keep(const Finished& finished) {
        if (options_.on_finished && !finished.is_left_behind)
            guarded([&] { options_.on_finished(finished.item, finished.packed); });
        return !has_failed_;
    }

    /// A callback; its error ends all ranks, and no callback follows it.
    void guarded(const std::function<void()>& callback) {
        if (has_failed_ || !callback) return;
        try {
            callback();
        } catch (const std::exception&) {
            fail(as_user_error(std::current_exception()));
        }
    }

    void fail(const UserError& error) {
        has_failed_ = true;
        pool_.drop();
        send(comm_, 0, Tag::ask_stop, to_bytes(Stop{error.exit_code(), error.what()}));
    }

    /// Signals, the end of a stop, and rank 0's duties.
    void watch() {
        guarded(options_.on_tick);
        ask_for_stop(options_.should_stop ? options_.should_stop() : Stopping::no);
        // A signal to all of us may have ended what an item had started.
        if (asked_ == Stopping::no && !is_stopping_) guarded([&] { pool_.check(); });
        if (leave_at_ && Clock::now() >= *leave_at_) pool_.leave_running();
        if (is_stopping_ && !has_stopped_ && pool_.is_idle()) {
            has_stopped_ = true;
            send(comm_, 0, Tag::stopped, {});
        }
        if (!master_) return;
        master_->hand_out();
        master_->show_progress();
    }

    void ask_for_stop(Stopping how) {
        if (how <= asked_) return;
        asked_ = how;
        guarded(options_.on_hurry);
        send(comm_, 0, Tag::ask_stop, to_bytes(Stop{ExitCode::more_to_do, {}, how}));
    }

    Comm& comm_;
    const study::Stage& stage_;
    Pool& pool_;
    Master* master_;
    const DistributeOptions& options_;
    Stop reason_;
    bool is_over_ = false, is_stopping_ = false, has_stopped_ = false;
    bool has_failed_ = false;
    Stopping asked_ = Stopping::no;
    std::optional<Clock::time_point> leave_at_;  ///< what runs then
};

}  // namespace

Distributed distribute(Comm& comm, const study::Stage& stage, Items items,
                       const DistributeOptions& options) {
    const auto begin = Clock::now();
    std::unique_ptr<Master> master;
    if (comm.rank() == 0)
        master = std::make_unique<Master>(comm, stage, std::move(items), options);
    std::unique_ptr<Pool> pool;
    together(comm, [&] {
        const std::chrono::duration<double> limit(options.item_seconds);
        pool = std::make_unique<Pool>(
            stage, PoolOptions{options.n_threads, limit, options.keep});
    });
    const Stop reason = Talker(comm, stage, *pool, master.get(), options).talk();
    comm.finish_sends();
    if (pool->has_left_behind()) comm.note_left_threads();
    if (!reason.text.empty()) throw UserError(reason.code, reason.text);
    return {master ? master->take() : std::vector<study::ItemAnswer>{},
            reason.code != ExitCode::ok, seconds_since(begin), pool->busy_seconds()};
}

}  // namespace bemcal::run
