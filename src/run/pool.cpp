/// The items of one rank on its compute threads: an OpenMP team takes them, and the main
/// thread takes what is finished. An item over its time is left behind with its thread.
/// Our own rules, without a source. A thread cannot be ended; it is replaced, and what it
/// reads is kept. Order and messages are distribute's.
#include "run/pool.hpp"

#include "base/error.hpp"
#include "base/machine.hpp"
#include "store/item_log.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <list>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <omp.h>

namespace bemcal::run {
namespace {

using Clock = std::chrono::steady_clock;

/// An item that throws has failed as a whole; the batch goes on, unless no input is to
/// blame.
study::ItemAnswer answer_of(const study::Stage& stage, int item) {
    study::ItemAnswer answer;
    try {
        answer = stage.run(item);
    } catch (const std::exception& error) {
        rethrow_unless_answer(error);
        answer = {};
        answer.error = error.what();
        if (answer.error.empty()) answer.error = "an error without a message";
    }
    return answer;
}

Finished over_limit(int item, std::chrono::duration<double> limit) {
    study::ItemAnswer answer;
    answer.error =
        fmt::format("unfinished: took longer than {} s (--item-seconds)", limit.count());
    return {item, store::pack(answer), true};
}

}  // namespace

/// Shared with the threads, which may outlive the pool.
struct Pool::State {
    State(const study::Stage& its_stage, std::shared_ptr<const void> to_keep)
        : stage(its_stage), keep(std::move(to_keep)) {}

    struct Running {
        int item;
        Clock::time_point begin;
        bool is_left_behind = false;
    };

    void work();
    void run_item(std::unique_lock<std::mutex>& lock, std::list<Running>::iterator mine);
    void take_in(Finished done, std::exception_ptr met);
    std::size_t n_running() const {
        return static_cast<std::size_t>(
            std::ranges::count(running, false, &Running::is_left_behind));
    }

    const study::Stage& stage;
    std::shared_ptr<const void> keep;
    mutable std::mutex mutex;
    std::condition_variable to_threads, to_main;
    std::deque<int> waiting;
    std::list<Running> running;  ///< by a thread each
    std::vector<Finished> finished;
    std::exception_ptr trouble;  ///< the first that is no item's answer
    bool is_closed = false;
    int n_working = 0;  ///< threads that are not left behind
    double busy_seconds = 0;
};

/// Until the pool is closed, or the item was left behind with its thread.
void Pool::State::work() {
    std::unique_lock lock(mutex);
    for (;;) {
        to_threads.wait(lock, [&] { return is_closed || !waiting.empty(); });
        if (waiting.empty()) break;
        const auto mine = running.insert(running.end(), {waiting.front(), Clock::now()});
        waiting.pop_front();
        run_item(lock, mine);
        const bool is_left_behind = mine->is_left_behind;
        running.erase(mine);
        if (is_left_behind) return;
    }
    --n_working;
    to_main.notify_one();
}

void Pool::State::run_item(std::unique_lock<std::mutex>& lock,
                           std::list<Running>::iterator mine) {
    const int item = mine->item;
    const auto begin = mine->begin;
    lock.unlock();
    Finished done{item, {}};
    std::exception_ptr met;
    try {
        done.packed = store::pack(answer_of(stage, item));
    } catch (...) {
        met = std::current_exception();
    }
    const std::chrono::duration<double> seconds = Clock::now() - begin;
    lock.lock();
    if (mine->is_left_behind) return;
    busy_seconds += seconds.count();
    take_in(std::move(done), met);
    if (waiting.empty() || trouble) to_main.notify_one();
}

void Pool::State::take_in(Finished done, std::exception_ptr met) {
    try {
        if (!met) finished.push_back(std::move(done));
    } catch (const std::bad_alloc&) {
        met = std::current_exception();
    }
    if (met && !trouble) trouble = met;
}

/// The team waits for its last member, so that a thread of its own holds it: the main
/// thread is never kept by an item.
Pool::Pool(const study::Stage& stage, const PoolOptions& options)
    : state_(std::make_shared<State>(stage, options.keep)), options_(options) {
    state_->n_working = options.n_threads;
    const auto team = [state = state_, n = options.n_threads] {
        omp_set_dynamic(0);
#pragma omp parallel num_threads(n)
        {
#pragma omp single
            {
                const std::scoped_lock lock(state->mutex);
                state->n_working -= n - omp_get_num_threads();
            }
            state->work();
        }
    };
    try {
        team_ = std::thread(team);
    } catch (const std::system_error& error) {
        throw UserError(ExitCode::os,
                        fmt::format("cannot start a compute thread: {}", error.what()));
    }
}

Pool::~Pool() {
    std::unique_lock lock(state_->mutex);
    state_->waiting.clear();
    state_->is_closed = true;
    state_->to_threads.notify_all();
    state_->to_main.wait(lock, [&] { return state_->n_working <= 0; });
    const bool is_held = state_->n_running() < state_->running.size();
    lock.unlock();
    if (is_held)
        team_.detach();
    else
        team_.join();
}

void Pool::push(const std::vector<int>& items) {
    {
        const std::scoped_lock lock(state_->mutex);
        state_->waiting.insert(state_->waiting.end(), items.begin(), items.end());
    }
    state_->to_threads.notify_all();
}

void Pool::drop() {
    const std::scoped_lock lock(state_->mutex);
    state_->waiting.clear();
}

void Pool::leave_running() {
    const std::scoped_lock lock(state_->mutex);
    for (auto& each : state_->running) {
        state_->n_working -= each.is_left_behind ? 0 : 1;
        each.is_left_behind = true;
    }
}

std::vector<Finished> Pool::take(std::chrono::microseconds wait) {
    std::unique_lock lock(state_->mutex);
    state_->to_main.wait_for(
        lock, wait, [&] { return state_->waiting.empty() && !state_->finished.empty(); });
    if (options_.item_limit.count() > 0)
        for (auto& each : state_->running) {
            if (each.is_left_behind || Clock::now() - each.begin < options_.item_limit)
                continue;
            each.is_left_behind = true;
            state_->finished.push_back(over_limit(each.item, options_.item_limit));
            std::thread([state = state_] { state->work(); }).detach();
        }
    return std::exchange(state_->finished, {});
}

void Pool::check() const {
    std::unique_lock lock(state_->mutex);
    const std::exception_ptr trouble = state_->trouble;
    lock.unlock();
    if (trouble) throw as_user_error(trouble);
}

bool Pool::is_idle() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->waiting.empty() && state_->n_running() == 0 &&
           state_->finished.empty();
}

bool Pool::has_left_behind() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->n_running() < state_->running.size();
}

double Pool::busy_seconds() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->busy_seconds;
}

}  // namespace bemcal::run
