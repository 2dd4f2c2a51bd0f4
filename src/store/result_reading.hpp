/// Reads a result file that may be of anyone: damaged, crafted, or no result at all.
///
/// HDF5 1.10 crashes on some files (8 % of those with a few bytes changed at random), so
/// that it reads in a process of its own, which hands on attributes and datasets.
#pragma once

#include "store/result.hpp"

#include <filesystem>
#include <string>

namespace bemcal::store {

/// Throws UserError, with the code for data, where it is not one of ours or damaged.
/// \param group  whose datasets are read; empty = all
ResultFile read_apart(const std::filesystem::path& file, const std::string& group);

/// The same in this process, for tests; HDF5 may crash it. Throws hdf5::Error.
ResultFile read_here(const std::filesystem::path& file, const std::string& group);

}  // namespace bemcal::store
