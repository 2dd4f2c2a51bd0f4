/// Tables for the terminal, made from a stored result alone.
#pragma once

#include <string>

#include "store/result_file.hpp"

namespace bemcal::report {

/// Everything a result holds, as plain text; metrics are computed again from what is stored.
std::string tables_of(const store::ResultFile& result);

}  // namespace bemcal::report
