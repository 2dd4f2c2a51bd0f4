/// How far the items are that run on a rank: told by their threads as they go, looked at
/// by the rank's main thread. No answer depends on it.
#pragma once

#include <list>
#include <mutex>
#include <string>
#include <utility>

namespace bemcal::study {

struct Activity {
    double share = 0;    ///< that is done of an item that runs, on average; 0 = not known
    std::string text{};  ///< "draw 40 of 200, acceptance 0.81"; empty = nothing to tell
};

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
