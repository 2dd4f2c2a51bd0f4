/// The result: one HDF5 file with netCDF-4's conventions, written under a temporary name
/// and renamed when complete.
///
/// What depends on the run (times, ranks, host, dates) lies in /run; the result hash
/// covers everything else. Reading is for `report`, `status` and the tests.
#pragma once

#include "store/result.hpp"

#include <filesystem>
#include <string>

namespace bemcal::store {

/// The hash of all but /run: attributes by name, then datasets by path.
std::string result_hash(const ResultFile& result);

/// Throws UserError: exists already, folder not writable, disk full; never leaves a
/// partial file under the final name. \return the hash
std::string write_result(const std::filesystem::path& file, const ResultFile& result);

/// Throws UserError where the file is missing or not one of ours.
/// \param group  whose datasets are read; empty = all
ResultFile read_result(const std::filesystem::path& file, const std::string& group = "");

}  // namespace bemcal::store
