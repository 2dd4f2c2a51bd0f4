/// Says where a function enters and what it follows.
/// Follows from its hook and its basis. Its shape is not put into words.
#include "loop/found_function.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::loop {

std::vector<double> FoundFunction::values() const {
    std::vector<double> all(basis.at_points.rows, 0.0);
    for (std::size_t p = 0; p < all.size(); ++p)
        for (std::size_t c = 0; c < mean.size(); ++c)
            all[p] += at.typical * basis.at_points(p, c) * mean[c];
    return all;
}

double FoundFunction::spread() const {
    if (basis.points.kind == functions::Points::Kind::one || deviations.empty() ||
        !effects::adds_up(at.hook))
        return 0;
    double sum = 0;
    for (const double deviation : deviations) sum += deviation * deviation;
    return at.typical * std::sqrt(sum / static_cast<double>(deviations.size()));
}

std::vector<FunctionsAtHook> by_hook(const std::vector<FoundFunction>& found) {
    std::vector<FunctionsAtHook> all;
    for (const FoundFunction& function : found) {
        auto own = std::ranges::find_if(
            all, [&](const auto& one) { return one.at.name == function.at.name; });
        if (own == all.end()) own = all.insert(all.end(), {function.at, {}});
        own->functions.push_back({function.basis.driver, function.basis.points,
                                  function.values(), function.spread()});
    }
    return all;
}

namespace {

std::string date_of(double years, physics::Seconds from) {
    return physics::format_date(
        from + std::chrono::seconds(std::llround(years * effects::seconds_of_year)));
}

}  // namespace

std::string name_of(const FoundFunction& function, physics::Seconds from) {
    const functions::Points& points = function.basis.points;
    if (points.kind == functions::Points::Kind::one) return function.at.name;
    std::string driver = function.basis.driver;
    if (points.kind == functions::Points::Kind::hours_from)
        driver.replace(driver.find("a day on"), std::string::npos,
                       date_of(points.knots[0], from) + " on");
    return fmt::format("{} by {}", function.at.name, driver);
}

}  // namespace bemcal::loop
