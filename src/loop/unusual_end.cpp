/// Says whether a parameter is at an end of its range, or far from its prior.
/// Three standard deviations are judgement: a normal prior has one of 370 beyond them.
/// What stands behind it is not sought here.
#include "loop/unusual_end.hpp"

#include "loop/decisions.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

std::string value_with_unit(const study::FitUnknown& unknown, double x) {
    const bool has_unit = !unknown.unit.empty() && unknown.unit != "-";
    return fmt::format("{:.3g}{}{}", unknown.value(x), has_unit ? " " : "",
                       has_unit ? unknown.unit : "");
}

}  // namespace

bool is_far_from_prior(const study::FitUnknown& unknown, double x) {
    return unknown.has_prior && std::abs(x) > decisions::far;
}

std::string unusual_end(const study::FitUnknown& unknown, double x, bool is_added) {
    const bool is_lowest = x <= unknown.lowest();
    const bool is_at_end = is_lowest || x >= unknown.highest();
    if (is_at_end && is_added && (is_lowest ? unknown.least : unknown.most) == 0)
        return "";
    if (is_at_end)
        return fmt::format("at the {} end of its range: {}",
                           is_lowest ? "lower" : "upper", value_with_unit(unknown, x));
    if (is_far_from_prior(unknown, x))
        return fmt::format("{:.1f} prior sd from its mean: {}", std::abs(x),
                           value_with_unit(unknown, x));
    return "";
}

}  // namespace bemcal::loop
