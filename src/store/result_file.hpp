/// The result: one HDF5 file with netCDF-4's conventions, written under a fresh name,
/// read back, and renamed when complete.
///
/// What depends on the run (times, ranks, host, dates) lies in /run; the result hash
/// covers everything else. Reading is for `report`, `status` and the tests.
#pragma once

#include "base/disk.hpp"
#include "store/result.hpp"

#include <filesystem>
#include <string>

namespace bemcal::store {

/// The hash of all but /run: attributes by name, then datasets by path.
std::string result_hash(const ResultFile& result);

struct Placing {
    std::filesystem::path folder{};  ///< of the file while it is written; empty = beside
    Replace replace = Replace::yes;
};

/// Read back and compared before it gets its name. Throws UserError: name taken, folder
/// not writable, disk full or faulty; never leaves a partial file under the final name.
/// \return the hash
std::string write_result(const std::filesystem::path& file, const ResultFile& result,
                         const Placing& placing = {});

/// Throws UserError where the file is missing or not one of ours.
/// \param group  whose datasets are read; empty = all
ResultFile read_result(const std::filesystem::path& file, const std::string& group = "");
/// The same without datasets.
ResultFile read_head(const std::filesystem::path& file);

/// Whether it is all what was written: its content, units and /run have the hashes that
/// it says.
bool is_sound(const ResultFile& result);

}  // namespace bemcal::store
