/// Disjoint sets with halved paths, whose roots are their least members.
/// Source: Tarjan and van Leeuwen 1984 (path halving). Roots are not chosen by size, so
/// that they do not depend on the order of joins.
#include "base/alike.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace bemcal {

AlikeGroups::AlikeGroups(std::size_t n) : parents_(n), sizes_(n, 1), n_shown_(n, 0) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
}

std::size_t AlikeGroups::first_of(std::size_t k) const {
    while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
    return k;
}

void AlikeGroups::join(std::size_t a, std::size_t b) {
    const auto [first, other] = std::minmax({first_of(a), first_of(b)});
    if (first == other) return;
    parents_[other] = first;
    sizes_[first] += sizes_[other];
    n_shown_[first] += n_shown_[other];
}

std::vector<std::vector<std::size_t>> AlikeGroups::large_groups() const {
    std::map<std::size_t, std::vector<std::size_t>> by_first;
    for (std::size_t k = 0; k < parents_.size(); ++k)
        if (is_large(k)) by_first[first_of(k)].push_back(k);
    std::vector<std::vector<std::size_t>> groups;
    groups.reserve(by_first.size());
    for (auto& [first, members] : by_first) groups.push_back(std::move(members));
    return groups;
}

}  // namespace bemcal
