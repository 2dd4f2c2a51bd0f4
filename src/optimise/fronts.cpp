/// Order among points with several objectives: fronts and crowding distances.
/// Source: Deb et al. 2002, section III. Every pair is compared. Constraints are left
/// out.
#include "optimise/fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bemcal::optimise {
namespace {

using Rows = std::vector<std::size_t>;

/// Whom a row dominates, and how many dominate it.
struct Order {
    std::vector<Rows> dominated;
    std::vector<int> n_above;
};

Order order_of(const Matrix& objectives) {
    Order order{std::vector<Rows>(objectives.rows), std::vector<int>(objectives.rows)};
    const auto add = [&](std::size_t above, std::size_t below) {
        order.dominated[above].push_back(below);
        ++order.n_above[below];
    };
    for (std::size_t a = 0; a < objectives.rows; ++a)
        for (std::size_t b = a + 1; b < objectives.rows; ++b) {
            if (dominates(objectives.row(a), objectives.row(b))) add(a, b);
            if (dominates(objectives.row(b), objectives.row(a))) add(b, a);
        }
    return order;
}

/// Rows that are dominated by no row outside the fronts so far.
Rows next_front(Order& order, const Rows& front) {
    Rows next;
    for (const std::size_t above : front)
        for (const std::size_t below : order.dominated[above])
            if (--order.n_above[below] == 0) next.push_back(below);
    std::ranges::sort(next);
    return next;
}

/// Adds the sides along one objective.
void add_sides(const Matrix& objectives, std::span<const std::size_t> front,
               std::size_t objective, std::vector<double>& crowding) {
    Rows order(front.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto value = [&](std::size_t k) { return objectives(front[k], objective); };
    std::ranges::stable_sort(order, {}, value);
    const double extent = value(order.back()) - value(order.front());
    crowding[order.front()] = crowding[order.back()] =
        std::numeric_limits<double>::infinity();
    if (!(extent > 0) || !std::isfinite(extent)) return;
    for (std::size_t k = 1; k + 1 < order.size(); ++k)
        crowding[order[k]] += (value(order[k + 1]) - value(order[k - 1])) / extent;
}

}  // namespace

bool dominates(std::span<const double> a, std::span<const double> b) {
    bool better = false;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (a[k] > b[k]) return false;
        better = better || a[k] < b[k];
    }
    return better;
}

std::vector<std::vector<std::size_t>> sort_into_fronts(const Matrix& objectives) {
    Order order = order_of(objectives);
    Rows front;
    for (std::size_t r = 0; r < objectives.rows; ++r)
        if (order.n_above[r] == 0) front.push_back(r);
    std::vector<Rows> fronts;
    while (!front.empty()) {
        fronts.push_back(front);
        front = next_front(order, front);
    }
    return fronts;
}

std::vector<double> crowding_of(const Matrix& objectives,
                                std::span<const std::size_t> front) {
    std::vector<double> crowding(front.size(), 0.0);
    if (front.empty()) return crowding;
    for (std::size_t k = 0; k < objectives.cols; ++k)
        add_sides(objectives, front, k, crowding);
    return crowding;
}

}  // namespace bemcal::optimise
