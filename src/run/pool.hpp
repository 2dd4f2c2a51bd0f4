/// The items of one rank: waiting for its compute threads, and finished ones for its main
/// thread.
#pragma once

#include "run/comm.hpp"
#include "study/stage.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

namespace bemcal::run {

/// A finished item, packed (store::pack) by the thread that computed it.
struct Finished {
    int item = 0;
    Bytes packed;
};

class Pool {
  public:
    explicit Pool(const study::Stage& stage) : stage_(stage) {}

    // by compute threads
    void work();     ///< runs items until the pool is closed
    bool run_one();  ///< one item, if one waits

    // by the main thread
    void push(const std::vector<int>& items);
    void drop();   ///< forgets the items that have not begun
    void close();  ///< work() returns once its item is finished
    /// Finished items, at the latest after `wait`; sooner where the threads run out of
    /// items.
    std::vector<Finished> take(std::chrono::microseconds wait);
    bool is_idle() const;         ///< nothing waits, runs or is left to take
    double busy_seconds() const;  ///< of all compute threads, in items

  private:
    void run_item(std::unique_lock<std::mutex>& lock);

    const study::Stage& stage_;
    mutable std::mutex mutex_;
    std::condition_variable to_threads_, to_main_;
    std::deque<int> waiting_;
    std::vector<Finished> finished_;
    int n_running_ = 0;
    bool closed_ = false;
    double busy_seconds_ = 0;
};

}  // namespace bemcal::run
