/// Tables for the terminal, made from a stored result alone, at most 100 columns wide.
#pragma once

#include "store/result_file.hpp"

#include <string>

namespace bemcal::report {

/// Everything a result holds, as plain text; metrics are computed again from what is
/// stored. Works on a part of a result too: the datasets of one stage. Throws UserError
/// where they are damaged: another layout, or of lengths that do not go together.
std::string tables_of(const store::ResultFile& result);

/// Whether its content is not what was written, or not all of it.
bool is_damaged(const store::ResultFile& result);

/// For `status`: complete or not, the job, seed, version, hash (computed again), and the
/// run.
std::string status_of(const store::ResultFile& result);

}  // namespace bemcal::report
