/// Finished items, appended as they finish: the truth that a resumed run starts from.
///
/// One file per rank beside the result: NAME.h5.part/rank-R.log. A record is a header
/// (magic, stage, item, what it started from, length), the answer, and a 64-bit checksum;
/// a cut or damaged record is noticed, reported and its item done again. Leaves out: any
/// order; that is the reader's.
#pragma once

#include "study/stage.hpp"

#include <compare>
#include <cstdint>
#include <filesystem>
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

class ItemLog {
  public:
    /// Opens for appending; creates the folder. Throws UserError where that is not
    /// possible.
    ItemLog(const std::filesystem::path& folder, int rank);
    ~ItemLog();
    ItemLog(const ItemLog&) = delete;
    ItemLog& operator=(const ItemLog&) = delete;

    /// Appends one record; the operating system has it on return. Throws UserError (disk
    /// full).
    void append(const ItemKey& key, const std::vector<std::byte>& packed);
    void sync();  ///< the disk has it on return

  private:
    int file_ = -1;
    std::filesystem::path path_;
};

struct LogContent {
    struct Record {
        ItemKey key;
        std::vector<std::byte> packed;
    };
    /// Each key once; of several answers the one with the fewest failures.
    std::vector<Record> records;
    int n_damaged = 0;  ///< records dropped for a wrong checksum or a cut end
};
LogContent read_logs(const std::filesystem::path& folder);

}  // namespace bemcal::store
