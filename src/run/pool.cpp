#include "run/pool.hpp"

#include "store/item_log.hpp"

#include <exception>
#include <utility>

namespace bemcal::run {
namespace {

/// An item that throws has failed as a whole; the batch goes on.
study::ItemAnswer answer_of(const study::Stage& stage, int item) {
    study::ItemAnswer answer;
    try {
        answer = stage.run(item);
    } catch (const std::exception& error) {
        answer = {};
        answer.error = error.what();
        if (answer.error.empty()) answer.error = "an error without a message";
    }
    return answer;
}

}  // namespace

void Pool::run_item(std::unique_lock<std::mutex>& lock) {
    const int item = waiting_.front();
    waiting_.pop_front();
    ++n_running_;
    lock.unlock();
    const auto begin = std::chrono::steady_clock::now();
    Bytes packed = store::pack(answer_of(stage_, item));
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - begin;
    lock.lock();
    --n_running_;
    busy_seconds_ += seconds.count();
    finished_.push_back({item, std::move(packed)});
    if (waiting_.empty()) to_main_.notify_one();
}

void Pool::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        to_threads_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        run_item(lock);
    }
}

bool Pool::run_one() {
    std::unique_lock lock(mutex_);
    if (waiting_.empty()) return false;
    run_item(lock);
    return true;
}

void Pool::push(const std::vector<int>& items) {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.insert(waiting_.end(), items.begin(), items.end());
    }
    to_threads_.notify_all();
}

void Pool::drop() {
    const std::scoped_lock lock(mutex_);
    waiting_.clear();
}

void Pool::close() {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.clear();
        closed_ = true;
    }
    to_threads_.notify_all();
}

std::vector<Finished> Pool::take(std::chrono::microseconds wait) {
    std::unique_lock lock(mutex_);
    to_main_.wait_for(lock, wait, [&] { return waiting_.empty() && !finished_.empty(); });
    return std::exchange(finished_, {});
}

bool Pool::is_idle() const {
    const std::scoped_lock lock(mutex_);
    return waiting_.empty() && n_running_ == 0 && finished_.empty();
}

double Pool::busy_seconds() const {
    const std::scoped_lock lock(mutex_);
    return busy_seconds_;
}

}  // namespace bemcal::run
