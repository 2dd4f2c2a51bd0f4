/// Runs ladders side by side in one company, checks what they are asked to be, and shares
/// the metric of one chain with all.
/// Sharing by the upper quartile of step sizes is our own rule. The algorithms are left
/// to ladder and walker; whether chains have converged, and more rounds, to the caller.
#include "sampling/chains.hpp"

#include "sampling/ladder.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::sampling {
namespace {

bool falls_from_one(const std::vector<double>& inverse_temperatures) {
    if (inverse_temperatures.empty() || inverse_temperatures.front() != 1) return false;
    for (std::size_t i = 1; i < inverse_temperatures.size(); ++i)
        if (!(inverse_temperatures[i] < inverse_temperatures[i - 1])) return false;
    return inverse_temperatures.back() >= 0;
}

void check(const SamplerOptions& options, int n_draws) {
    struct Check {
        bool is_met;
        const char* what;
    };
    const Check checks[] = {
        {options.n_warm_up >= 0, "n_warm_up: expected 0 or more"},
        {options.target_acceptance >= 0 && options.target_acceptance < 1,
         "target_acceptance: expected 0 to below 1"},
        {options.most_depth >= 1 && options.most_depth <= 20,
         "most_depth: expected 1 to 20"},
        {options.n_start_candidates >= 1, "n_start_candidates: expected 1 or more"},
        {falls_from_one(options.inverse_temperatures),
         "inverse_temperatures: expected 1 first, then falling, none below 0"},
        {options.thin >= 1, "thin: expected 1 or more"},
        {n_draws >= 0, "n_draws: expected 0 or more"}};
    for (const Check& check : checks)
        if (!check.is_met) throw std::invalid_argument(check.what);
}

}  // namespace

/// A state (Ladder::memory): meetings, inverse temperature, position, step size, metric.
void share_metric(const Density& density, const SamplerOptions& options,
                  std::vector<std::vector<double>>& states) {
    if (!climbs_first(options)) return;
    const std::size_t step_size = 2 + density.dimension();
    std::vector<std::size_t> alive;
    for (std::size_t c = 0; c < states.size(); ++c)
        if (states[c].size() > step_size) alive.push_back(c);
    if (alive.empty()) return;
    std::ranges::sort(alive, {},
                      [&](std::size_t c) { return std::pair(states[c][step_size], c); });
    const std::vector<double> chosen = states[alive[alive.size() * 3 / 4]];
    const auto learnt = chosen.begin() + static_cast<std::ptrdiff_t>(step_size);
    for (const std::size_t c : alive)
        std::copy(learnt, chosen.end(),
                  states[c].begin() + static_cast<std::ptrdiff_t>(step_size));
}

std::vector<ChainPart> run_chains(Density& density, const SamplerOptions& options,
                                  const std::vector<ChainTask>& tasks, int n_draws,
                                  Tally* tally) {
    check(options, n_draws);
    Company company(density, options.method == Method::nuts);
    const Coordinates coordinates = coordinates_of(density);
    const Setting setting{density, company, coordinates, options, n_draws, tally};
    std::deque<Ladder> ladders;
    for (const ChainTask& task : tasks) ladders.emplace_back(setting, task);
    for (Ladder& ladder : ladders) ladder.start();
    company.run();
    std::vector<ChainPart> parts;
    parts.reserve(tasks.size());
    for (Ladder& ladder : ladders) parts.push_back(ladder.finish());
    return parts;
}

}  // namespace bemcal::sampling
