/// Reads a result file that may be of anyone: damaged, crafted, or no result at all.
///
/// HDF5 1.10 crashes on some files (8 % of those with a few bytes changed at random), so
/// that it reads in a process of its own, which hands on attributes and datasets.
#pragma once

#include "store/result.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace bemcal::store {

constexpr const char* no_group = "/";

/// Throws UserError, with the code for data, where it is not one of ours or damaged.
/// \param group  whose datasets are read; empty = all, no_group = none
ResultFile read_apart(const std::filesystem::path& file, const std::string& group);

/// The same in this process, for tests; HDF5 may crash it. Throws hdf5::Error.
ResultFile read_here(const std::filesystem::path& file, const std::string& group);

/// In this process, a dataset at a time: the head first, then each dataset in the order
/// of their paths. Of a file that we have written ourselves. Throws hdf5::Error.
void read_each_here(const std::filesystem::path& file,
                    const std::function<void(const ResultFile&)>& head,
                    const std::function<void(const study::Dataset&)>& each);

}  // namespace bemcal::store
