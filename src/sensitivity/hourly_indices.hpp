/// Sobol indices of every step and of the series, with intervals, from the sums of
/// blocks.
///
/// Indices come from the sums of all blocks together; their 95 % intervals from the
/// estimates with one block left out (jackknife; Student's t with 31 degrees of freedom).
/// Blocks of one Sobol sequence complement each other, so the intervals are on the wide
/// side.
#pragma once

#include "sensitivity/hourly_sums.hpp"
#include "study/stage.hpp"

namespace bemcal::sensitivity {

constexpr int n_blocks = 32;

/// Estimates of one step: from all blocks, then with each block left out in turn.
struct StepEstimates {
    StepEstimate all;
    std::vector<StepEstimate> without;
};

/// The series' estimates: parts and variances of the steps added up (Lamboni, Monod and
/// Makowski 2011, Reliab. Eng. Syst. Saf. 96: generalised indices).
void add_to(StepEstimates& sum, const StepEstimates& step);

/// Estimates from the blocks that were computed.
class Blocks {
  public:
    /// \param answers  each: base points used, the shift [n_steps], HourlySums::values
    Blocks(const std::vector<study::ItemAnswer>& answers, std::size_t n_steps,
           std::size_t dimension);

    double shift(std::size_t step) const;  ///< NaN where no block was computed
    StepEstimates at(std::size_t step) const;

  private:
    double term(std::size_t block, std::size_t k, std::size_t step) const {
        return (*blocks_[block])[1 + n_steps_ + step * n_terms_ + k];
    }

    std::size_t n_steps_, n_terms_;
    std::vector<const std::vector<double>*> blocks_;
    double n_ = 0;
};

/// Indices and half widths, [first order of all inputs, total order of all inputs]; NaN
/// where nothing varies.
struct Indices {
    std::vector<double> values, half_widths;
};
Indices indices_of(const StepEstimates& estimates, double shift);

}  // namespace bemcal::sensitivity
