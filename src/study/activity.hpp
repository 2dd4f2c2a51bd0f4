/// How far the items are that run on a rank: told by their threads as they go, looked at
/// by the rank's main thread. No answer depends on it.
#pragma once

#include <list>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::study {

struct Activity {
    double share = 0;    ///< that is done of an item that runs, on average; 0 = not known
    std::string text{};  ///< of those: "draw 40 of 200"; empty = nothing to tell
    std::string so_far{};  ///< of what has finished, which rank 0 alone knows
    int n_items = 0;       ///< that run
};

/// Of all ranks, rank 0 first: the share of a mean item; the texts of the ranks that are
/// least far, for the last one ends a round.
Activity of_all(const std::vector<Activity>& ranks);

/// The items that run, each with a State of atomics, which it alone writes.
template <class State>
class Running {
  public:
    /// Lives as long as the item runs.
    class Item {
      public:
        template <class... Arguments>
        explicit Item(Running& all, Arguments&&... arguments) : all_(all) {
            const std::scoped_lock lock(all_.mutex_);
            at_ = all_.states_.emplace(all_.states_.end(),
                                       std::forward<Arguments>(arguments)...);
        }
        ~Item() {
            const std::scoped_lock lock(all_.mutex_);
            all_.states_.erase(at_);
        }
        Item(const Item&) = delete;
        Item& operator=(const Item&) = delete;
        State& operator*() const { return *at_; }
        State* operator->() const { return &*at_; }

      private:
        Running& all_;
        typename std::list<State>::iterator at_;
    };

    int count() const {
        const std::scoped_lock lock(mutex_);
        return static_cast<int>(states_.size());
    }

    template <class Look>
    void each(const Look& look) const {
        const std::scoped_lock lock(mutex_);
        for (const State& state : states_) look(state);
    }

  private:
    mutable std::mutex mutex_;
    std::list<State> states_;
};

}  // namespace bemcal::study
