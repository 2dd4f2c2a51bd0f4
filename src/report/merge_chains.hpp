/// The chains of one job that was run several times, with other numbers of the first
/// chain, as one result.
#pragma once

#include "store/result_file.hpp"

#include <vector>

namespace bemcal::report {

/// Results of the same job text and with other chains become one, whose draws are those
/// of all, cut to the draws that each has; predictions are those of the first. Others
/// stay by themselves, in the order of the files.
std::vector<store::ResultFile> merge_chains(std::vector<store::ResultFile> results);

}  // namespace bemcal::report
