/// Says which points a step lies between.
/// Plain interpolation without a source. A level in time foretells itself; where no
/// season repeats, in under two years, it may as well be a season: then the mean of the
/// last level and of that of the same time of the year goes on. Drivers that are not
/// numbers are left to the caller.
#include "functions/points.hpp"

#include "functions/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bemcal::functions {
namespace {

using Weights = Points::Weights;

constexpr std::size_t day_classes = 3;   ///< of Kind::hours
constexpr std::size_t kinds_of_day = 2;  ///< of Kind::hours_at_knots

/// The knot below, and the share of the way to the next; the ends are held.
std::pair<std::size_t, double> between(const std::vector<double>& knots, double x) {
    if (!(x > knots.front())) return {0, 0};
    if (x >= knots.back()) return {knots.size() - 2, 1};
    const auto above = std::upper_bound(knots.begin(), knots.end(), x);
    const auto at = static_cast<std::size_t>(above - knots.begin()) - 1;
    return {at, (x - knots[at]) / (knots[at + 1] - knots[at])};
}

Weights at_knots(const std::vector<double>& knots, double x, std::size_t first) {
    const auto [knot, share] = between(knots, x);
    return {{first + knot, first + knot + 1}, {1 - share, share}};
}

Weights in_time(std::size_t n, double year) {
    const auto point_at = [n](double time) {
        return static_cast<std::size_t>(std::clamp(std::floor(time * fortnights_of_year),
                                                   0.0, static_cast<double>(n - 1)));
    };
    const double length = static_cast<double>(n) / fortnights_of_year;
    const double year_before = year - std::ceil(year - length);
    if (year < length || length > decisions::years_that_show_seasons || year_before < 0)
        return {{point_at(year), 0}, {1, 0}};
    return {{point_at(year), point_at(year_before)},
            {1 - decisions::share_of_season, decisions::share_of_season}};
}

}  // namespace

std::size_t Points::size() const {
    switch (kind) {
        case Kind::one:
            return 1;
        case Kind::hours:
        case Kind::hours_from:
            return day_classes * hours_of_day;
        case Kind::knots:
            return knots.size();
        case Kind::hours_at_knots:
            return kinds_of_day * hours_of_day * knots.size();
        default:
            return n_fortnights;
    }
}

Weights Points::weights(std::span<const double> drivers) const {
    switch (kind) {
        case Kind::one:
            return {};
        case Kind::hours:
            return {{static_cast<std::size_t>(drivers[0]), 0}, {1, 0}};
        case Kind::hours_from:
            return {{static_cast<std::size_t>(drivers[0]), 0},
                    {drivers[1] >= knots[0] ? 1.0 : 0.0, 0}};
        case Kind::knots:
            return at_knots(knots, drivers[0], 0);
        case Kind::hours_at_knots:
            return at_knots(knots, drivers[1],
                            static_cast<std::size_t>(drivers[0]) * knots.size());
        default:
            return in_time(n_fortnights, drivers[0]);
    }
}

std::vector<std::vector<double>> Points::drivers_at() const {
    std::vector<double> first, second;
    for (std::size_t p = 0; p < size() && kind != Kind::one; ++p) {
        const auto number = static_cast<double>(p);
        if (kind == Kind::hours || kind == Kind::hours_from) first.push_back(number);
        if (kind == Kind::knots) first.push_back(knots[p]);
        if (kind == Kind::fortnights)
            first.push_back((number + 0.5) / fortnights_of_year);
        if (kind != Kind::hours_at_knots) continue;
        first.push_back(std::floor(number / static_cast<double>(knots.size())));
        second.push_back(knots[p % knots.size()]);
    }
    if (kind == Kind::one) return {};
    if (second.empty()) return {first};
    return {first, second};
}

std::vector<double> function_over(const Points& points, std::span<const double> values,
                                  const std::vector<std::vector<double>>& drivers) {
    std::vector<double> function(drivers[0].size());
    std::vector<double> at(drivers.size());
    for (std::size_t k = 0; k < function.size(); ++k) {
        for (std::size_t d = 0; d < at.size(); ++d) at[d] = drivers[d][k];
        const Weights w = points.weights(at);
        for (std::size_t i = 0; i < w.point.size(); ++i)
            if (w.weight[i] != 0) function[k] += w.weight[i] * values[w.point[i]];
    }
    return function;
}

}  // namespace bemcal::functions
