/// Says whether a model is better than another in more unseen blocks than by chance: the
/// larger of a standardised sum and of signed ranks, over blocks where they differ.
/// Source: Wilcoxon 1945 (Biometrics Bulletin 1) for the ranks.
/// Leaves out dependence between blocks, ties, and a correction for taking the larger.
#include "loop/consistency.hpp"

#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

/// Those in which the models differ: an effect of a season is seen in that season. All
/// where these are too few to tell how they scatter.
std::vector<double> falls_where_moved(const std::vector<BlockChange>& changes) {
    double most = 0;
    for (const BlockChange& change : changes) most = std::max(most, change.moved);
    std::vector<double> all, moved;
    all.reserve(changes.size());
    moved.reserve(changes.size());
    for (const BlockChange& change : changes) {
        all.push_back(change.fall);
        if (change.moved >= decisions::share_of_moved_block * most)
            moved.push_back(change.fall);
    }
    return moved.size() < decisions::least_moved_blocks ? all : moved;
}

/// Their sum over its standard error, brought to what a normal variable exceeds as seldom
/// as Student's t does (about z + (z^3 + z) / 4 nu).
double standardised_sum(const std::vector<double>& falls) {
    double sum = 0, square = 0;
    for (const double fall : falls) sum += fall, square += fall * fall;
    const double n = static_cast<double>(falls.size());
    const double variance = square - sum * sum / n;
    return variance > 0 ? sum / std::sqrt(variance) / (1 + 2 / (n - 1)) : 0;
}

/// Wilcoxon's signed ranks, over their standard deviation where signs are by chance: one
/// block in which very much falls does not hide that the others agree.
double signed_ranks(std::vector<double> falls) {
    std::ranges::sort(falls, {}, [](double fall) { return std::abs(fall); });
    double sum = 0, square = 0;
    for (std::size_t k = 0; k < falls.size(); ++k) {
        const double rank = static_cast<double>(k + 1);
        sum += falls[k] > 0 ? rank : -rank;
        square += rank * rank;
    }
    return square > 0 ? sum / std::sqrt(square) : 0;
}

}  // namespace

double consistency_of(const std::vector<BlockChange>& changes) {
    const std::vector<double> falls = falls_where_moved(changes);
    return std::max(standardised_sum(falls), signed_ranks(falls));
}

}  // namespace bemcal::loop
