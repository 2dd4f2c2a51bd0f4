/// How tables of fits word what changed: errors, limits met.
#pragma once

#include <string>

namespace bemcal::report {

/// "12.3 -> 4.5", in per cent of shares; NaN as "-".
std::string change(double before, double after);

/// "no -> yes": whether limits are met.
std::string verdict(bool before, bool after);

}  // namespace bemcal::report
