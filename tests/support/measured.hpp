/// What a test measured, in one form for all, to be found with `grep measured`.
#pragma once

#include <string>

#include <fmt/format.h>

namespace bemcal::test {

/// Prints "measured: <what> = <value> <unit> (limit <limit>)"; without a limit where
/// there is none.
inline void print_measured(const std::string& what, double value, const char* unit,
                           const char* limit) {
    const std::string end =
        *limit == 0 ? std::string() : fmt::format(" (limit {})", limit);
    fmt::print("measured: {} = {:.4g} {}{}\n", what, value, unit, end);
}

}  // namespace bemcal::test
