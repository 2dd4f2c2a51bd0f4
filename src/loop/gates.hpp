/// What a candidate has to pass before it joins the model: evidence, a plausible
/// coefficient, errors of readings that its fit had not seen, and those that come last.
#pragma once

#include "loop/search.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::loop {

/// The weighted error of the last readings under fits to those before: what follows time
/// must foretell what comes. They are the last quarter of training; of a step at most the
/// last half of what follows it, since nothing before it knows its size.
class LastReadings {
  public:
    LastReadings(const LoopData& data, const Standing& before);

    /// Relative change from the model before, of one with that effect.
    double change_to(const Standing& after, const effects::Effect& effect);
    /// From there on readings are foretold.
    physics::Seconds begin_for(const effects::Effect& effect) const;

  private:
    double error_of(const Standing& standing, physics::Seconds from) const;

    const LoopData& data_;
    const Standing& before_;
    std::vector<double> weights_;
    std::map<physics::Seconds, double> errors_before_;  ///< few candidates come so far
};

/// The first gate that a judged candidate does not pass; empty: it passes all.
std::string objection_to(const LoopData& data, const Standing& before,
                         const Refitted& candidate, double threshold,
                         LastReadings& last_readings);

/// Whether a coefficient lies in its effect's plausible range or little beyond.
bool is_plausible(const effects::Effect& effect, double coefficient);

}  // namespace bemcal::loop
