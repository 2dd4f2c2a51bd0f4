/// What chains sample: a density over unknowns, how its positions are read, and what
/// follows from the draws.
#pragma once

#include "base/matrix.hpp"
#include "sampling/density.hpp"
#include "study/datasets.hpp"
#include "study/summary.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::posterior {

/// A number whose posterior is reported.
struct Unknown {
    std::string name, unit;
};

/// All chains that started, with the draws that every one of them has.
struct ChainDraws {
    std::size_t n_chains = 0, n_draws = 0;
    Matrix positions;         ///< [(chains x draws) x dimension], on the density's scale
    Matrix statistics;        ///< [(chains x draws) x n_statistics]
    std::vector<int> chains;  ///< [n_chains] numbers
    std::vector<std::string> failures;  ///< of chains that did not start
};

class Posterior {
  public:
    virtual ~Posterior() = default;
    virtual const char* kind() const = 0;  ///< of study, as the result says it
    virtual std::unique_ptr<sampling::Density> make_density() const = 0;
    virtual const std::vector<Unknown>& unknowns() const = 0;
    /// A position in physical units. \param values  [unknowns]
    virtual void read(std::span<const double> position,
                      std::span<double> values) const = 0;
    /// What follows from the draws beside the unknowns themselves: predictions, errors,
    /// and the draws of each building's parameters.
    /// \param summaries  the first has been begun; buildings of their own may follow
    virtual void conclude(const ChainDraws& draws, study::DatasetBuilder& datasets,
                          std::vector<study::Summary>& summaries) const = 0;
};

}  // namespace bemcal::posterior
