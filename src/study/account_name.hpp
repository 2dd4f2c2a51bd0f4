/// What a cost or an emission is called that not all energies have a share in.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::study {

/// "cost"; "cost of gas alone" where others are bought, too.
inline std::string account_name(const std::string& what,
                                const std::vector<std::string>& of, bool is_of_all) {
    return is_of_all ? what : fmt::format("{} of {} alone", what, fmt::join(of, ", "));
}

}  // namespace bemcal::study
