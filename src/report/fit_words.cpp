/// The words that tables of fits share.
/// Plain formatting; NaN is "-".
#include "report/fit_words.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {

std::string change(double before, double after) {
    const auto number = [](double share) {
        return std::isfinite(share) ? fmt::format("{:.1f}", 100 * share)
                                    : std::string("-");
    };
    return fmt::format("{:>6} -> {:>5}", number(before), number(after));
}

std::string verdict(bool before, bool after) {
    const auto word = [](bool is_met) { return is_met ? "yes" : "no"; };
    return fmt::format("{:>3} -> {}", word(before), word(after));
}

}  // namespace bemcal::report
