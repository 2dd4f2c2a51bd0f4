/// What predictions need of a posterior's draws: some of them, and what they say.
#pragma once

#include "base/matrix.hpp"

#include <vector>

namespace bemcal::study {

/// Some of all rows, evenly spread.
std::vector<std::size_t> chosen_rows(std::size_t n_rows, int n_wanted);

/// Of each column over the rows, as coverage takes them.
std::vector<double> column_quantiles(const Matrix& draws, double p);

}  // namespace bemcal::study
