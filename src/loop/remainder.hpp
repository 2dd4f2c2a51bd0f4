/// What a standing model leaves of the training readings, as the estimation of functions
/// sees it: readings and columns over their standard deviations, block by block.
#pragma once

#include "functions/joint.hpp"
#include "loop/found_function.hpp"
#include "loop/function_bases.hpp"
#include "loop/linear_model.hpp"

#include <optional>
#include <vector>

namespace bemcal::loop {

/// The order and the weights of the readings.
class ReadingLayout {
  public:
    ReadingLayout(const LoopData& data, const std::vector<ChannelNoise>& noise);

    /// [readings] from the steps of the channels: rows first_row, first_row + stride, ...
    /// of what is shown; 0 where nothing is read.
    std::vector<double> readings_of(const Matrix& shown, std::size_t first_row,
                                    std::size_t stride) const;

    /// Over their standard deviations, in the order of the blocks.
    void write(std::span<const double> readings, Eigen::Ref<Eigen::VectorXf> to) const;

    long n_rows() const { return static_cast<long>(order_.size()); }
    const std::vector<long>& first_row() const { return first_row_; }
    const std::vector<std::size_t>& fold() const { return fold_; }

  private:
    void sort_into_blocks();

    const LoopData& data_;
    std::vector<double> per_deviation_;     ///< [readings]
    std::vector<std::vector<int>> bounds_;  ///< [channels]
    std::vector<char> is_read_;             ///< [readings] 0 = missing
    std::vector<std::size_t> order_;        ///< of the readings that are there
    std::vector<std::size_t> fold_;         ///< [blocks]
    std::vector<long> first_row_;           ///< [blocks + 1]
};

/// Every function of every driver at every hook of the standing model. A pair of hook and
/// driver has a number, its id.
class Remainder {
  public:
    /// \param place  with the functions that the standing model has already
    /// \param there  these functions
    /// \param noise  that weighs the meters
    /// \param day    from which on hours may be others (day_of_change.hpp)
    Remainder(const LoopData& data, const Place& place, const Standing& standing,
              const effects::FunctionDrivers& drivers,
              const std::vector<FoundFunction>& there,
              const std::vector<ChannelNoise>& noise, std::optional<double> day);

    functions::Path search() const;
    /// The functions of a fit.
    std::vector<FoundFunction> found_by(const functions::JointFit& fit) const;
    /// By how much a fit moves the unknowns. [unknowns]
    std::vector<double> moves_of(const functions::JointFit& fit) const;

  private:
    const effects::Effect& hook_of(std::size_t id) const {
        return linear_.hooks[id / bases_.size()];
    }
    const functions::Basis& basis_of(std::size_t id) const {
        return bases_[id % bases_.size()];
    }
    std::size_t n_pairs() const { return linear_.hooks.size() * bases_.size(); }
    FoundFunction found_of(const functions::FunctionFit& fit) const;
    std::vector<functions::Pair> pairs() const;
    functions::WeighedData weighed_data() const;
    bool may_pair(std::size_t id) const;
    double log_odds_of(std::size_t id) const;
    Eigen::MatrixXf columns_of(std::size_t id) const;
    /// A pair's function over the steps of training. [steps x 1]
    Matrix input_of(std::size_t id, const std::vector<double>& coefficients) const;
    std::optional<std::size_t> id_of(const FoundFunction& function) const;
    /// Adds what a function brings to the readings, as the linear steps have it.
    void add(std::size_t id, const FoundFunction& function,
             std::vector<double>& readings) const;

    const Standing& standing_;
    ReadingLayout layout_;
    LinearModel linear_;
    std::vector<functions::Basis> bases_;
    std::vector<Matrix> inputs_;     ///< [bases] columns on the steps
    std::vector<std::size_t> free_;  ///< parameters that no end of a range holds
    std::vector<functions::There> there_;
    std::vector<double> without_functions_;  ///< residuals if those there were not
};

}  // namespace bemcal::loop
