/// The trajectory of a no-U-turn transition: grown to either side by subtrees of 1, 2, 4,
/// ... leapfrog steps until it turns back, a point of it drawn by its weight on the way.
///
/// Hoffman and Gelman 2014 (JMLR 15); multinomial weights and the generalised criterion
/// of Betancourt 2017 (arXiv:1701.02434, appendix A.4), with Stan's two further checks
/// where halves meet. A subtree grows leaf by leaf: the starts of its unfinished parts
/// are kept as checkpoints (Phan, Pradhan and Jankowiak 2019, arXiv:1912.11554), so that
/// nothing recurses. Momenta are whitened: velocity and momentum are the same vector.
#pragma once

#include "base/random.hpp"
#include "sampling/point.hpp"

#include <array>
#include <span>
#include <vector>

namespace bemcal::sampling {

/// A state of the dynamics.
struct Leaf {
    Point point;
    std::vector<double> momentum, force;  ///< [real coordinates] whitened
    double energy = 0;                    ///< NaN or inf where the density is not finite
};

class Trajectory {
  public:
    /// \param n_real  coordinates that move
    Trajectory(std::size_t dimension, std::size_t n_real, int most_depth);

    /// The leaf that a trajectory starts from, to be filled before begin().
    Leaf& root() { return edges_[0]; }
    void begin();
    bool may_grow() const { return depth_ < most_depth_; }
    /// For the transitions to come, up to the depth it was made for.
    void set_most_depth(int most_depth) { most_depth_ = most_depth; }

    /// Starts a subtree as large as the trajectory, at either end of it.
    void begin_subtree(Stream& random);
    bool subtree_is_complete() const { return n_leaves_ == 1U << depth_; }
    /// The end that grows: the next leaf is computed in place.
    Leaf& edge() { return edges_[side_]; }
    int direction() const { return side_ == 1 ? 1 : -1; }
    /// Takes in the leaf now at the edge; false: it diverges or the subtree turns back.
    bool add_leaf(Stream& random);
    /// Takes in the complete subtree; false: the whole turns back.
    bool join(Stream& random);

    Point& sample() { return sample_; }
    int depth() const { return depth_; }
    int n_steps() const { return n_steps_; }
    bool diverging() const { return diverging_; }
    double mean_acceptance() const { return sum_acceptance_ / n_steps_; }

  private:
    using Vector = std::vector<double>;
    struct Checkpoint {
        Vector momentum, before,
            sum;  ///< of a leaf, of the one before it, up to the leaf
    };
    void keep_checkpoint();
    bool subtree_turns();
    bool part_turns(std::size_t checkpoint, std::size_t last_checkpoint);

    std::array<Leaf, 2> edges_;  ///< backward, forward
    Point sample_, proposal_;
    int most_depth_, depth_ = 0, n_steps_ = 0;
    bool diverging_ = false;
    double energy_0_ = 0, log_weight_ = 0, sum_acceptance_ = 0;
    Vector sum_;  ///< of the trajectory's momenta

    std::size_t side_ = 0;
    unsigned n_leaves_ = 0;
    double log_weight_subtree_ = 0;
    Vector sum_subtree_, last_momentum_, edge_before_;
    std::vector<Checkpoint> checkpoints_;
    Vector sum_left_, sum_right_;  ///< scratch
};

/// Two neighbouring stretches of a trajectory, by the momenta at their ends and the sums
/// over them.
struct Stretches {
    std::span<const double> first, last_of_left, first_of_right, last;
    std::span<const double> sum_left, sum_right;
};
/// Whether the whole turns back, or the left with the first leaf of the right, or the
/// last of the left with the right.
bool turns_back(const Stretches& stretches);

}  // namespace bemcal::sampling
