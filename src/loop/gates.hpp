/// What a candidate has to pass before it joins the model: evidence, a plausible
/// coefficient, errors of readings that its fit had not seen, and the last quarter of the
/// training period.
#pragma once

#include "loop/search.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

/// The weighted error in the last quarter of training under fits to the first three: what
/// follows time must foretell what comes.
class LastQuarter {
  public:
    LastQuarter(const LoopData& data, const Standing& before);

    /// Relative change from the model before.
    double change_to(const Standing& after);

  private:
    double error_of(const Standing& standing) const;

    const LoopData& data_;
    const Standing& before_;
    std::vector<double> weights_, is_last_;
    std::optional<double> error_before_;  ///< few candidates come so far
};

/// The first gate that a judged candidate does not pass; empty: it passes all.
std::string objection_to(const LoopData& data, const Standing& before,
                         const Refitted& candidate, double threshold,
                         LastQuarter& last_quarter);

/// Whether a coefficient lies in its effect's plausible range or little beyond.
bool is_plausible(const effects::Effect& effect, double coefficient);

}  // namespace bemcal::loop
