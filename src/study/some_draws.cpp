/// Picks evenly spread rows of a posterior's draws, and takes quantiles of columns.
/// Follows from `predictive_quantile`, by which coverage counts too.
/// All draws weigh alike; nothing is drawn at random.
#include "study/some_draws.hpp"

#include "stats/coverage.hpp"

#include <algorithm>

namespace bemcal::study {

std::vector<std::size_t> chosen_rows(std::size_t n_rows, int n_wanted) {
    const std::size_t n = std::min(n_rows, static_cast<std::size_t>(n_wanted));
    std::vector<std::size_t> rows;
    rows.reserve(n);
    for (std::size_t k = 0; k < n; ++k) rows.push_back(k * n_rows / n);
    return rows;
}

std::vector<double> column_quantiles(const Matrix& draws, double p) {
    std::vector<double> result(draws.cols), column(draws.rows);
    for (std::size_t k = 0; k < draws.cols; ++k) {
        for (std::size_t d = 0; d < draws.rows; ++d) column[d] = draws(d, k);
        std::ranges::sort(column);
        result[k] = stats::predictive_quantile(column, p);
    }
    return result;
}

}  // namespace bemcal::study
