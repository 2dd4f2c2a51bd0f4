/// Where a method waits for the values of its points: known ones are answered at once,
/// the rest is the batch; the budget and the target end it.
/// Plain bookkeeping without a source. A method is never resumed after its end. Points
/// are known by equal coordinates, and all of them are kept.
#include "optimise/search.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace bemcal::optimise {

Search::Search(Space space, std::size_t n_objectives, const Limits& limits)
    : space_(std::move(space)), n_objectives_(n_objectives), limits_(limits) {
    require(n_objectives > 0, "a search needs an objective");
}

Search::Evaluation Search::evaluate(std::vector<Position> positions) {
    std::set<Position> added;
    waiting_for_.clear();
    for (const Position& position : positions)
        if (!values_.contains(position) && added.insert(position).second)
            waiting_for_.push_back(position);
    const std::size_t left =
        limits_.evaluations - std::min(limits_.evaluations, n_evaluated());
    is_cut_ = waiting_for_.size() > left;
    if (is_cut_) waiting_for_.resize(left);
    return {*this, std::move(positions)};
}

void Search::answer(const Matrix& values) {
    require(values.rows == waiting_for_.size() && values.cols == n_objectives_,
            "an optimiser was told another number of values than it asked for");
    for (std::size_t r = 0; r < values.rows; ++r) store(waiting_for_[r], values.row(r));
    waiting_for_.clear();
    if (!is_over()) proceed();
}

void Search::proceed() {
    while (method_ && waiting_for_.empty() && !is_cut_)
        std::exchange(method_, {}).resume();
}

void Search::store(const Position& position, std::span<const double> objectives) {
    std::vector<double>& stored = values_[position];
    stored.assign(objectives.begin(), objectives.end());
    for (double& value : stored)
        if (!std::isfinite(value)) value = std::numeric_limits<double>::infinity();
    if (n_objectives_ > 1) return;
    if (found_.empty() || stored[0] < found_[0].objectives[0])
        found_ = {{position, stored}};
}

bool Search::is_over() const {
    return is_cut_ || (n_objectives_ == 1 && !found_.empty() &&
                       found_[0].objectives[0] <= limits_.target);
}

Matrix Search::known(const std::vector<Position>& positions) const {
    Matrix values(positions.size(), n_objectives_);
    for (std::size_t r = 0; r < positions.size(); ++r)
        std::ranges::copy(values_.at(positions[r]), values.row(r).begin());
    return values;
}

}  // namespace bemcal::optimise
