/// Runs of another program's model of a building, and what they say of where to go on:
/// the best so far, and the points at which the next runs pay.
#pragma once

#include "emulator/series_emulator.hpp"
#include "loop/model.hpp"
#include "loop/stored_loop.hpp"
#include "study/simulator_run.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace bemcal::loop {

using study::SimulatorRun;

/// Where the next runs pay.
struct NextRuns {
    Matrix points;  ///< [runs x parameters]
    Matrix scales;  ///< [runs x effects]
};

/// [effects] 1 = its scale is fitted with the parameters. Runs with effects beside those
/// do not count; by default none with any.
using KeptEffects = std::vector<char>;

/// How far effects have been judged by the program's own runs. One is tried at the best
/// point so far, which shows what it does there, then where the emulator has the optimum
/// with it. It is doubted, once all are known, at the optimum without it.
struct Judged {
    std::vector<char> kept;                 ///< [effects that were tried]
    std::optional<std::size_t> in_doubt{};  ///< the effect that is to be left out next
    bool is_over = false;                   ///< nothing more to run
};

/// Runs that are reported: the nominal one, the nearest without effects, the nearest of
/// all; nothing where none succeeded. [StoredLoop::Model]
using ReportedRuns = std::array<std::optional<std::size_t>, StoredLoop::n_models>;

class RunsSoFar {
  public:
    /// \param runs  that did not fail count, and are of the training period; `data` and
    /// they must outlive this
    RunsSoFar(const LoopData& data, const std::vector<SimulatorRun>& runs);

    /// Whether there are enough without effects to go on.
    bool are_enough() const;
    /// Index of the run whose readings are nearest to the measured ones.
    std::optional<std::size_t> best(const KeptEffects& kept = {}) const;
    /// How far a run is from the readings; infinite of one that failed.
    double deviance_at(std::size_t run) const { return deviances_[run]; }
    /// Of the nearest; infinite where there is none.
    double least_deviance(const KeptEffects& kept = {}) const;
    ReportedRuns reported(const KeptEffects& kept) const;
    /// The optimum of an emulator of the runs first, then points about it.
    /// \param without  an effect whose scale is held at 0
    NextRuns next(std::size_t n, const KeptEffects& kept = {},
                  std::optional<std::size_t> without = {}) const;
    /// How far the emulator of runs without effects misses a run that it has not seen:
    /// CV(RMSE) of readings, weighed by what the nearest run with those leaves.
    /// [channels] %
    std::vector<double> emulator_error(const KeptEffects& kept) const;

    /// Which effects the program's own runs speak for. First they are tried one after the
    /// other, each beside those kept before it; then runs refine all that were kept; then
    /// each is doubted, the last first. An effect stays where the nearest run with it is
    /// nearer to the readings than that without it, and the nearest of all has it.
    /// \param first  index of the first trial in the runs
    Judged judge_effects(std::size_t first, std::size_t n_effects,
                         std::size_t n_refinement) const;

  private:
    std::vector<double> residuals_of(std::size_t run) const;
    /// Deviances by the noise of that run, or of the next one that did not fail.
    void rank_by(std::size_t run);
    double nearest_of(std::size_t first, std::size_t n) const;
    std::vector<std::size_t> usable(const KeptEffects& kept) const;
    std::vector<double> weights(const KeptEffects& kept) const;
    emulator::SeriesEmulator emulator_of(const KeptEffects& kept,
                                         const std::vector<double>& weights) const;

    const LoopData& data_;
    const std::vector<SimulatorRun>& runs_;
    std::vector<std::vector<double>> readings_;  ///< [runs]; empty of those that failed
    std::vector<double> deviances_;              ///< [runs]; infinite of those
};

}  // namespace bemcal::loop
