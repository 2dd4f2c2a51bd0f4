/// An optimiser as its users see it: it asks for a batch of points and is told their
/// values, until it asks for none.
///
/// It is reproducible: the points follow from the options and from what it was told. So
/// it is also resumed: by an optimiser made anew that is told the same values. Not pagmo
/// or NLopt: they call the objective, point by point or in threads of theirs, and a batch
/// here is a round of simulations on all ranks.
#pragma once

#include "optimise/search.hpp"
#include "sampling/task.hpp"

#include <functional>
#include <memory>

namespace bemcal::optimise {

/// A method of optimisation; it must keep nothing that refers to its caller.
using Method = std::function<sampling::Task<>(Search&)>;

class Optimiser {
  public:
    Optimiser(Space space, std::size_t n_objectives, const Limits& limits,
              const Method& method);

    /// [n x variables] none of them twice; no rows: it is done.
    Matrix next_points() const { return space().values_of(search_->waiting_for()); }
    /// \param values  [n x objectives] of these points; not finite = failed
    void tell(const Matrix& values);

    std::size_t n_evaluated() const { return search_->n_evaluated(); }
    const Space& space() const { return search_->space(); }
    /// One objective: the best point so far. Several: the last generation's front.
    const std::vector<Found>& found() const { return search_->found(); }
    /// Their values. [found x variables]
    Matrix found_points() const;

  private:
    std::unique_ptr<Search> search_;
    sampling::Task<> task_;
};

}  // namespace bemcal::optimise
