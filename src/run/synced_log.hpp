/// A rank's item log, on the disk at most a second after each item.
#pragma once

#include "run/comm.hpp"
#include "run/timer.hpp"
#include "store/item_log.hpp"

#include <chrono>
#include <filesystem>

namespace bemcal::run {

class SyncedLog {
  public:
    SyncedLog(const std::filesystem::path& folder, int rank) : log_(folder, rank) {}

    void append(const store::ItemKey& key, const Bytes& packed) {
        const Timer timer(seconds_);
        log_.append(key, packed);
        is_dirty_ = true;
    }
    void sync_if_due() {
        if (is_dirty_ &&
            std::chrono::steady_clock::now() - synced_ >= std::chrono::seconds(1))
            sync();
    }
    void sync() {
        const Timer timer(seconds_);
        log_.sync();
        synced_ = std::chrono::steady_clock::now();
        is_dirty_ = false;
    }
    double seconds() const { return seconds_; }

  private:
    store::ItemLog log_;
    bool is_dirty_ = false;
    std::chrono::steady_clock::time_point synced_ = std::chrono::steady_clock::now();
    double seconds_ = 0;
};

}  // namespace bemcal::run
