/// Finished items, appended as they finish: the truth that a resumed run starts from.
///
/// One file per rank and run: NAME.h5.part/rank-R.log, or rank-R-2.log where that is
/// there already: a log is never written into again. A record is a header (magic, stage,
/// item, what it started from, length), the answer, and a 64-bit checksum that holds the
/// run's identity; a record that is cut, damaged or of another run is noticed, reported
/// and its item done again. Leaves out: any order; that is the reader's.
#pragma once

#include "study/stage.hpp"

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::store {

std::vector<std::byte> pack(const study::ItemAnswer& answer);
study::ItemAnswer unpack(const std::byte* data, std::size_t bytes);

/// Whose answer a record is.
struct ItemKey {
    std::int32_t stage = 0, item = 0;
    /// Checksum of what the item's round started from, 0 in a first round: an answer that
    /// started from something else is another one.
    std::uint64_t start = 0;
    auto operator<=>(const ItemKey&) const = default;
};

/// What all records of a run have in common, by which they are told from others.
using RunMark = std::uint64_t;

class ItemLog {
  public:
    /// Creates the log, and the folder. Throws UserError where that is not possible.
    ItemLog(const std::filesystem::path& folder, int rank, RunMark run = 0);
    ~ItemLog();
    ItemLog(const ItemLog&) = delete;
    ItemLog& operator=(const ItemLog&) = delete;

    /// Appends one record; the operating system has it on return. Throws UserError (disk
    /// full).
    void append(const ItemKey& key, const std::vector<std::byte>& packed);
    void sync();   ///< the disk has it on return
    void close();  ///< the same, and that the disk has taken all; no append follows
    /// What is wrong with the file by now, as far as its name and length tell: it was
    /// removed, replaced, cut or written into by somebody else; empty = nothing.
    std::string trouble() const;
    const std::filesystem::path& path() const { return path_; }

  private:
    int file_ = -1;
    std::filesystem::path path_;
    RunMark run_;
    std::uint64_t bytes_ = 0;  ///< written
};

/// "rank-3.log", "rank-3-2.log".
bool is_log_name(const std::string& name);

struct LogContent {
    struct Record {
        ItemKey key;
        std::vector<std::byte> packed;
    };
    /// Each key once; of several answers the one with the fewest failures.
    std::vector<Record> records;
    int n_damaged = 0;  ///< records dropped for a wrong checksum or a cut end
    int n_foreign = 0;  ///< records dropped because they are another run's
    /// Logs that hold records of another run.
    std::vector<std::filesystem::path> foreign;
};
/// \param run  whose records are taken; none: that of most. Throws UserError where a log
/// cannot be read, or is a folder.
LogContent read_logs(const std::filesystem::path& folder,
                     std::optional<RunMark> run = std::nullopt);

}  // namespace bemcal::store
