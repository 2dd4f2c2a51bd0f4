/// Which settings the readings deny: those whose parameter ended far from its prior
/// (unusual_end) and is no open question, by the number that it sets.
/// Leaves out numbers that a factor scales, and availability, capacity and flows, which
/// nobody reads off a controller.
#include "loop/settings.hpp"

#include "loop/decisions.hpp"
#include "loop/unusual_end.hpp"
#include "physics/numbers.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

struct Named {
    std::string_view end;  ///< of the path of its number
    std::string_view name;
};
constexpr std::array settings = {Named{".heating_set_point.low", "heating set-back"},
                                 Named{".cooling_set_point.low", "cooling set-back"},
                                 Named{".heating_set_point", "heating set-point"},
                                 Named{".cooling_set_point", "cooling set-point"}};

/// "zone.office.heating_set_point" -> "office".
std::string zone_of(std::string_view path, std::string_view end) {
    constexpr std::string_view begin = "zone.";
    path.remove_suffix(end.size());
    return std::string(path.substr(std::min(begin.size(), path.size())));
}

std::string name_of(const physics::Building& building,
                    const physics::Parameter& parameter) {
    const std::string path = physics::path_of(building, parameter.targets.front());
    for (const auto& [end, name] : settings) {
        if (!path.ends_with(end)) continue;
        const bool is_of_one = parameter.targets.size() == 1 && building.zones.size() > 1;
        return is_of_one ? fmt::format("{} of zone {}", name, zone_of(path, end))
                         : std::string(name);
    }
    return "";
}

}  // namespace

std::optional<Setting> denied_setting(const physics::Building& described,
                                      const physics::Parameter& parameter,
                                      const study::FitUnknown& unknown, double x,
                                      double deviation) {
    if (parameter.targets.empty() || parameter.effect == physics::Effect::factor ||
        !is_far_from_prior(unknown, x) ||
        deviation > decisions::wide_parameter * unknown.scale)
        return std::nullopt;
    const std::string name = name_of(described, parameter);
    if (name.empty()) return std::nullopt;
    const bool is_shift = parameter.effect == physics::Effect::offset;
    const double was = physics::number_at(described, parameter.targets.front()) -
                       (is_shift ? parameter.nominal : 0);
    const double found = unknown.value(x) + (is_shift ? was : 0);
    const double half = stats::normal_quantile(0.95) * deviation;
    return Setting{name,         parameter.name,
                   "degC",       is_shift ? was + unknown.centre : unknown.centre,
                   found,        found - half,
                   found + half, std::abs(x)};
}

}  // namespace bemcal::loop
