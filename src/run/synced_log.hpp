/// A rank's item log, on the disk at most a second after each item.
#pragma once

#include "run/comm.hpp"
#include "run/timer.hpp"
#include "store/item_log.hpp"

#include <chrono>
#include <filesystem>
#include <string>

namespace bemcal::run {

class SyncedLog {
  public:
    SyncedLog(const std::filesystem::path& folder, int rank, store::RunMark run)
        : log_(folder, rank, run) {}

    void append(const store::ItemKey& key, const Bytes& packed) {
        const Timer timer(seconds_);
        log_.append(key, packed);
        is_dirty_ = true;
    }
    /// \return whether it was
    bool sync_if_due() {
        const auto now = std::chrono::steady_clock::now();
        if (now - synced_ < std::chrono::seconds(1)) return false;
        if (is_dirty_)
            sync();
        else
            synced_ = now;
        return true;
    }
    void sync() {
        const Timer timer(seconds_);
        log_.sync();
        synced_ = std::chrono::steady_clock::now();
        is_dirty_ = false;
    }
    void close() {
        const Timer timer(seconds_);
        log_.close();
    }
    std::string trouble() const { return log_.trouble(); }
    double seconds() const { return seconds_; }

  private:
    store::ItemLog log_;
    bool is_dirty_ = false;
    std::chrono::steady_clock::time_point synced_ = std::chrono::steady_clock::now();
    double seconds_ = 0;
};

}  // namespace bemcal::run
