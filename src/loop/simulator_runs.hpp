/// Runs of another program's model of a building, and what they say of where to go on:
/// the best so far, and the points at which the next runs pay.
#pragma once

#include "emulator/series_emulator.hpp"
#include "loop/model.hpp"
#include "study/stage.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::loop {

/// A run at a point, with effects at a scale each.
struct SimulatorRun {
    std::vector<double> point;               ///< [parameters] on the scale 0 to 1
    std::vector<double> scales;              ///< [effects]; none before effects are known
    std::vector<std::vector<double>> hours;  ///< [channels][hours of all periods]
    std::vector<std::string> left_out;       ///< what the program could not take
    std::string failure;                     ///< then there are no hours

    bool has_effects() const;
};

/// As an item's answer, and back.
std::vector<double> pack(const SimulatorRun& run);
SimulatorRun unpack_run(std::span<const double> packed);

/// Where the next runs pay.
struct NextRuns {
    Matrix points;  ///< [runs x parameters]
    Matrix scales;  ///< [runs x effects]
};

class RunsSoFar {
  public:
    /// \param runs       that did not fail count; `data` and they must outlive this
    /// \param n_effects  whose scales are fitted with the parameters
    RunsSoFar(const LoopData& data, const std::vector<SimulatorRun>& runs,
              std::size_t n_effects);

    /// Whether there are enough of them to go on.
    bool are_enough() const;
    /// Index of the run whose readings are nearest to the measured ones, among those
    /// without effects, or among all.
    std::optional<std::size_t> best(bool with_effects) const;
    /// How far a run is from the readings; infinite of one that failed.
    double deviance_at(std::size_t run) const { return deviances_[run]; }
    /// The optimum of an emulator of the runs first, then points about it.
    NextRuns next(std::size_t n) const;
    /// How far the emulator of runs without effects misses a run that it has not seen:
    /// CV(RMSE) of readings. [channels] %
    std::vector<double> emulator_error() const;

  private:
    std::vector<std::size_t> usable() const;
    std::vector<double> weights() const;
    emulator::SeriesEmulator emulator_of(const std::vector<std::size_t>& used,
                                         std::size_t n_effects) const;

    const LoopData& data_;
    const std::vector<SimulatorRun>& runs_;
    std::size_t n_effects_;
    std::vector<std::vector<double>> readings_;  ///< [runs]; empty of those that failed
    std::vector<double> deviances_;              ///< [runs]; infinite of those
};

}  // namespace bemcal::loop
