/// The studies of a stored result, and of what kind each is.
#pragma once

#include "report/lookup.hpp"

#include <string>
#include <vector>

namespace bemcal::report {

struct StoredStudy {
    std::string kind;  ///< a word of the job file, or "stock"
    Group group;
};

/// In the order of the file.
std::vector<StoredStudy> studies_in(const store::ResultFile& result);
/// The groups of those of one kind.
std::vector<Group> studies_of_kind(const store::ResultFile& result,
                                   const std::string& kind);

}  // namespace bemcal::report
