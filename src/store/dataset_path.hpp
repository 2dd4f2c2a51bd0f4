/// Paths of datasets: group/group/leaf.
#pragma once

#include <string>

namespace bemcal::store {

/// "c" of "a/b/c"
inline std::string leaf_of(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

/// "a/b" of "a/b/c"; "" at the root
inline std::string group_of(const std::string& path) {
    const std::size_t end = path.rfind('/');
    return end == std::string::npos ? std::string() : path.substr(0, end);
}

}  // namespace bemcal::store
