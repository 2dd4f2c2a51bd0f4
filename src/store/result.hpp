/// What a result file holds, and the names by which it says that it is complete and what
/// its content is.
#pragma once

#include "study/stage.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::store {

constexpr const char* complete_mark = "COMPLETE";
constexpr const char* hash_mark = "result_hash";
constexpr const char* labels_mark = "labels_hash";
constexpr const char* run_group = "run";

struct ResultFile {
    /// Of the root: job, seed, versions, ...
    std::map<std::string, std::string> attributes;
    std::map<std::string, std::string> run;  ///< attributes of /run: outside the hash
    std::vector<study::Dataset> datasets;  ///< each dimension has a coordinate or a size
    bool complete = false;
    std::string hash;  ///< filled by the reader and the writer
    /// Of what that hash leaves out, /run and units; empty in files of older versions.
    std::string labels_hash{};
};

}  // namespace bemcal::store
