/// A chain: one walker at each temperature, which meet after every transition to swap
/// points with their neighbours. A chain that is not tempered is a ladder of one.
///
/// Swaps take turns between even and odd pairs, the non-reversible scheme of Syed,
/// Bouchard-Cote, Deligiannidis and Doucet 2022 (JRSS B 84(2), arXiv:1905.02939).
#pragma once

#include "sampling/tally.hpp"
#include "sampling/walker.hpp"

#include <coroutine>
#include <deque>
#include <span>
#include <string>
#include <vector>

namespace bemcal::sampling {

/// What a call's ladders have in common.
struct Setting {
    const Density& density;
    Company& company;
    const Coordinates& coordinates;
    const SamplerOptions& options;
    int n_draws;
    Tally* tally;  ///< nullptr = none
};

class Ladder {
  public:
    Ladder(const Setting& setting, const ChainTask& task);
    /// Lets the walkers go until they wait for the density; the company does the rest.
    void start();
    /// What they drew, when the company has nothing left to do.
    ChainPart finish();

  private:
    struct Meeting {
        Ladder& ladder;
        bool await_ready() const noexcept { return ladder.walkers_.size() == 1; }
        bool await_suspend(std::coroutine_handle<> walker) const {
            return ladder.wait_for_others(walker);
        }
        void await_resume() const noexcept {}
    };
    Meeting meet() { return {*this}; }
    bool wait_for_others(std::coroutine_handle<> walker);
    void swap_neighbours();
    double swap_probability(std::size_t pair) const;
    void plan_tunings();
    void tune_temperatures();

    Task<> walk(Walker& walker);
    Task<> find_start(Walker& walker);
    Task<> warm_up(Walker& walker);
    Task<> draw(Walker& walker);
    void count(const Walker& walker, const Transition& transition);
    void record(std::size_t draw, const Transition& transition);

    /// All that the next round starts from.
    std::vector<std::span<double>> memory();
    void remember(const std::vector<double>& state);

    const Setting& setting_;
    const ChainTask& task_;
    Stream random_;  ///< for swaps
    std::deque<Walker> walkers_;
    std::vector<Task<>> walks_;
    std::vector<std::coroutine_handle<>> arrived_, leaving_;
    std::vector<double> swapped_;  ///< [pairs] 1 = the last swap was accepted
    std::vector<double> refused_;  ///< [pairs] sum of probabilities since the last tuning
    std::vector<double> tunings_;  ///< at these numbers of meetings
    double n_meetings_ = 0;
    ChainPart part_;
};

}  // namespace bemcal::sampling
