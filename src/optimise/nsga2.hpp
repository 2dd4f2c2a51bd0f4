/// NSGA-II: Deb, Pratap, Agarwal and Meyarivan 2002, IEEE Trans. Evol. Comput. 6(2).
///
/// Fast non-dominated sorting, crowding distance, binary tournaments, elitist choice from
/// parents and children. Continuous variables: simulated binary crossover and polynomial
/// mutation, both bounded (Deb and Agrawal 1995; as in Deb's code nsga2-gnuplot 1.1.6).
/// Discrete variables, which the paper codes in binary: children swap them with chance
/// 1/2, and a mutation draws any value of the table. No constraints: a point that failed
/// is worse than all others.
#pragma once

#include "optimise/nsga2_options.hpp"
#include "optimise/optimiser.hpp"

namespace bemcal::optimise {

/// Throws std::invalid_argument for a population that is odd or smaller than 4.
Method make_nsga2(const Nsga2Options& options);

}  // namespace bemcal::optimise
