/// Reads the keys of chains: sampler, lengths, targets, temperatures.
/// Source: Vehtari et al. 2021 for the targets, rank R-hat and effective draws.
/// Seeds and sizes of items are the kind's own.
#include "job/chains.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

int whole(const schema::Section& section, std::string_view key) {
    return static_cast<int>(section.integer(key));
}

/// Temperatures as the job has them, 1 first, rising, become their inverses.
std::vector<double> read_temperatures(const schema::Section& section,
                                      const std::vector<double>& otherwise) {
    std::vector<double> temperatures = section.numbers("temperatures");
    if (temperatures.empty()) return otherwise;
    if (temperatures[0] != 1 ||
        std::ranges::adjacent_find(temperatures, std::greater_equal<>()) !=
            temperatures.end())
        section.fail("temperatures",
                     "expected 1 first, then numbers that rise: [1, 2, 4, 8]");
    for (double& temperature : temperatures) temperature = 1 / temperature;
    return temperatures;
}

}  // namespace

void read_chains(const schema::Section& section, posterior::ChainOptions& chains) {
    chains.sampler.method = section.choice_as<sampling::Method>("sampler");
    chains.sampler.n_warm_up = whole(section, "warm_up");
    chains.sampler.thin = whole(section, "thin");
    chains.sampler.inverse_temperatures =
        read_temperatures(section, chains.sampler.inverse_temperatures);
    chains.n_chains = whole(section, "n_chains");
    chains.draws_per_round = whole(section, "draws_per_round");
    chains.most_draws = whole(section, "most_draws");
    chains.target_rhat = section.number("target_rhat");
    chains.target_ess = section.number("target_ess");
    if (chains.most_draws < chains.draws_per_round)
        section.fail(
            "most_draws",
            fmt::format("is {}, less than draws_per_round = {}; expected as many "
                        "at least",
                        chains.most_draws, chains.draws_per_round));
}

double rounds_of(const posterior::ChainOptions& chains) {
    return 1 + std::ceil(static_cast<double>(chains.most_draws) / chains.draws_per_round);
}

}  // namespace bemcal::job
