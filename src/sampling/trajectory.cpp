/// A no-U-turn trajectory leaf by leaf: multinomial weights, a sample drawn on the way,
/// U-turns from checkpoints, so that nothing recurses.
/// Source: Hoffman and Gelman 2014; Betancourt 2017, A.4, with Stan's further checks;
/// Phan et al. 2019. The dynamics are left to leapfrog.
#include "sampling/trajectory.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace bemcal::sampling {
namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();
constexpr double most_energy_error = 1000;

double log_sum_exp(double a, double b) {
    const double most = std::max(a, b);
    return most + std::log1p(std::exp(std::min(a, b) - most));
}

void add_to(std::vector<double>& sum, const std::vector<double>& terms) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += terms[i];
}

}  // namespace

bool turns_back(const Stretches& s) {
    double whole[2] = {0, 0}, left[2] = {0, 0}, right[2] = {0, 0};
    for (std::size_t i = 0; i < s.first.size(); ++i) {
        const double sum = s.sum_left[i] + s.sum_right[i];
        const double with_left = s.sum_left[i] + s.first_of_right[i];
        const double with_right = s.last_of_left[i] + s.sum_right[i];
        whole[0] += s.first[i] * sum;
        whole[1] += s.last[i] * sum;
        left[0] += s.first[i] * with_left;
        left[1] += s.first_of_right[i] * with_left;
        right[0] += s.last_of_left[i] * with_right;
        right[1] += s.last[i] * with_right;
    }
    const bool goes_on = whole[0] > 0 && whole[1] > 0 && left[0] > 0 && left[1] > 0 &&
                         right[0] > 0 && right[1] > 0;
    return !goes_on;
}

Trajectory::Trajectory(std::size_t dimension, std::size_t n_real, int most_depth)
    : sample_(dimension),
      proposal_(dimension),
      most_depth_(most_depth),
      sum_(n_real),
      sum_subtree_(n_real),
      last_momentum_(n_real),
      edge_before_(n_real),
      checkpoints_(static_cast<std::size_t>(most_depth) + 1,
                   {Vector(n_real), Vector(n_real), Vector(n_real)}),
      sum_left_(n_real),
      sum_right_(n_real) {
    edges_.fill({Point(dimension), Vector(n_real), Vector(n_real)});
}

void Trajectory::begin() {
    edges_[1] = edges_[0];
    sample_ = root().point;
    sum_ = root().momentum;
    energy_0_ = root().energy;
    depth_ = n_steps_ = 0;
    diverging_ = false;
    log_weight_ = sum_acceptance_ = 0;
}

void Trajectory::begin_subtree(Stream& random) {
    side_ = random.below(2);
    edge_before_ = edge().momentum;
    n_leaves_ = 0;
    log_weight_subtree_ = minus_infinity;
    std::ranges::fill(sum_subtree_, 0.0);
}

bool Trajectory::add_leaf(Stream& random) {
    ++n_steps_;
    const double error = edge().energy - energy_0_;
    if (!(error <= most_energy_error)) {
        diverging_ = true;
        return false;
    }
    sum_acceptance_ += error <= 0 ? 1 : std::exp(-error);
    log_weight_subtree_ = log_sum_exp(log_weight_subtree_, -error);
    if (random.uniform() < std::exp(-error - log_weight_subtree_))
        proposal_ = edge().point;
    add_to(sum_subtree_, edge().momentum);
    const bool turns = n_leaves_ % 2 == 1 && subtree_turns();
    if (n_leaves_ % 2 == 0) keep_checkpoint();
    last_momentum_ = edge().momentum;
    ++n_leaves_;
    return !turns;
}

/// Leaf n, even, starts parts of the subtree; the place of a start is free again when no
/// part that begins there can still be complete.
void Trajectory::keep_checkpoint() {
    Checkpoint& kept =
        checkpoints_[static_cast<std::size_t>(std::popcount(n_leaves_ / 2))];
    kept.momentum = edge().momentum;
    kept.before = last_momentum_;
    kept.sum = sum_subtree_;
}

/// Leaf n, odd, completes as many parts as n has trailing ones: of 2, 4, 8 ... leaves.
bool Trajectory::subtree_turns() {
    const auto last = static_cast<std::size_t>(std::popcount(n_leaves_ / 2));
    const auto n_parts = static_cast<std::size_t>(std::countr_one(n_leaves_));
    for (std::size_t k = 0; k < n_parts; ++k)
        if (part_turns(last - k, last)) return true;
    return false;
}

/// The part that starts at a checkpoint and ends at the edge; its right half starts at
/// the next checkpoint, or is the edge itself.
bool Trajectory::part_turns(std::size_t checkpoint, std::size_t last_checkpoint) {
    const Checkpoint& start = checkpoints_[checkpoint];
    const Vector& last = edge().momentum;
    const bool is_pair = checkpoint == last_checkpoint;
    const Checkpoint& middle = checkpoints_[is_pair ? checkpoint : checkpoint + 1];
    const Vector& first_of_right = is_pair ? last : middle.momentum;
    const Vector& sum_to_right = is_pair ? sum_subtree_ : middle.sum;
    for (std::size_t i = 0; i < last.size(); ++i) {
        const double sum_to_left = sum_to_right[i] - first_of_right[i];
        sum_left_[i] = sum_to_left - start.sum[i] + start.momentum[i];
        sum_right_[i] = sum_subtree_[i] - sum_to_left;
    }
    return turns_back({start.momentum, is_pair ? start.momentum : middle.before,
                       first_of_right, last, sum_left_, sum_right_});
}

bool Trajectory::join(Stream& random) {
    if (random.uniform() < std::exp(log_weight_subtree_ - log_weight_))
        std::swap(sample_, proposal_);
    log_weight_ = log_sum_exp(log_weight_, log_weight_subtree_);
    ++depth_;
    const bool turns =
        turns_back({edges_[1 - side_].momentum, edge_before_, checkpoints_[0].momentum,
                    edge().momentum, sum_, sum_subtree_});
    add_to(sum_, sum_subtree_);
    return !turns;
}

}  // namespace bemcal::sampling
