/// How NSGA-II (nsga2.hpp) breeds.
#pragma once

#include <cstdint>

namespace bemcal::optimise {

struct Nsga2Options {
    int n_population = 100;   ///< even, at least 4
    int n_generations = 250;  ///< the first, drawn one included
    double crossover_chance = 0.9, crossover_index = 20;
    double mutation_chance = 0;  ///< of each variable; 0 = 1 / variables
    double mutation_index = 20;
    std::uint64_t seed = 0;
    std::uint32_t stream = 0;  ///< of the seed
};

}  // namespace bemcal::optimise
