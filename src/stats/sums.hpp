/// Sums over readings, of which normal equations are made: the time of a search goes
/// there. The same bits on every processor, for each sum has eight parts, of every eighth
/// reading, that are added up in one order.
#pragma once

#include <span>
#include <vector>

namespace bemcal::stats {

/// Rows of the same length, wherever they are.
using Rows = std::vector<const double*>;

/// Each row times a vector: sum over k of row[k] v[k]. [rows]
std::vector<double> products(const Rows& rows, std::span<const double> v);

/// Each row times each: sum over k of w[k] a[k] b[k], with w >= 0; of stretches where all
/// weights are 0 nothing is read. [rows x rows], symmetric
std::vector<double> weighted_gram(const Rows& rows, std::span<const double> weights);

}  // namespace bemcal::stats
