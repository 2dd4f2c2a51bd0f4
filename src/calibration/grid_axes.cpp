/// Lists the points of a full factorial, the last parameter running fastest, and refines
/// an axis by midpoints between a kept value and its neighbours.
/// Source: paper 3, eq. 2-3, with plus signs where minus is printed.
/// Leaves out axes of one value, and midpoints outside the range. At an end the missing
/// neighbour is mirrored.
#include "calibration/grid_axes.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace bemcal::calibration {
namespace {

/// Of the range, for the rounding of a midpoint that lies on its end.
constexpr double slack = 1e-9;

bool is_inside(double value, const Room& room) {
    const double allowed = slack * (room.most - room.least);
    return value >= room.least - allowed && value <= room.most + allowed;
}

}  // namespace

std::size_t size_of(const Grid& grid) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / 4;
    std::size_t size = 1;
    for (const auto& axis : grid) {
        if (!axis.empty() && size > most / axis.size()) return most;
        size *= axis.size();
    }
    return size;
}

Matrix points_of(const Grid& grid, std::size_t first, std::size_t n) {
    Matrix points(n, grid.size());
    for (std::size_t row = 0; row < n; ++row) {
        std::size_t rest = first + row;
        for (std::size_t p = grid.size(); p-- > 0; rest /= grid[p].size())
            points(row, p) = grid[p][rest % grid[p].size()];
    }
    return points;
}

std::vector<double> with_midpoints(const std::vector<double>& axis,
                                   const std::vector<double>& kept, const Room& room) {
    std::set<double> values(kept.begin(), kept.end());
    const std::size_t last = axis.size() - 1;
    for (const double x : kept) {
        if (last == 0 || !room.has_midpoints) break;
        const auto at =
            static_cast<std::size_t>(std::ranges::lower_bound(axis, x) - axis.begin());
        const double before = at > 0 ? axis[at - 1] : x - (axis[1] - x);
        const double after = at < last ? axis[at + 1] : x + (x - axis[last - 1]);
        for (const double middle : {(before + x) / 2, (x + after) / 2})
            if (is_inside(middle, room))
                values.insert(std::min(std::max(middle, room.least), room.most));
    }
    return {values.begin(), values.end()};
}

}  // namespace bemcal::calibration
