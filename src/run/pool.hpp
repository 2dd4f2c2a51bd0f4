/// The items of one rank: waiting for its compute threads, and finished ones for its main
/// thread.
///
/// A thread cannot be ended from outside. One whose item takes longer than it may is left
/// behind: the item counts as unfinished, another thread takes its place, and what it
/// still reads is kept for as long as it runs.
#pragma once

#include "run/comm.hpp"
#include "study/stage.hpp"

#include <chrono>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

namespace bemcal::run {

/// An item's answer, packed (store::pack) by the thread that computed it; of one that was
/// left behind the reason, which is not to be stored as an answer.
struct Finished {
    int item = 0;
    Bytes packed;
    bool is_left_behind = false;
};

struct PoolOptions {
    int n_threads = 1;
    /// Longest time of an item; 0 = no limit.
    std::chrono::duration<double> item_limit{0};
    /// What the stage refers to, the stage itself included, where a thread may outlive
    /// it.
    std::shared_ptr<const void> keep;
};

/// Used by one thread, the rank's main one. Its end waits for the items that run, but not
/// for those left behind.
class Pool {
  public:
    /// Starts the threads. Throws UserError where none can be started.
    Pool(const study::Stage& stage, const PoolOptions& options);
    ~Pool();
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    void push(const std::vector<int>& items);
    void drop();  ///< forgets the items that have not begun
    /// Leaves all items behind that run now; they are not taken either.
    void leave_running();
    /// Finished items and those over the limit, at the latest after `wait`; sooner where
    /// the threads run out of items.
    std::vector<Finished> take(std::chrono::microseconds wait);
    /// Throws UserError where an item met what no input is to blame for: the machine had
    /// no memory, say, or the program has a mistake. Such an item is not finished.
    void check() const;
    bool is_idle() const;          ///< nothing waits, runs or is left to take
    bool has_left_behind() const;  ///< a thread still computes what nobody waits for
    double busy_seconds() const;   ///< of all compute threads, in finished items

  private:
    struct State;
    std::shared_ptr<State> state_;
    PoolOptions options_;
    std::thread team_;
};

}  // namespace bemcal::run
