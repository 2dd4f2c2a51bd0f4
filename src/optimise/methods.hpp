/// The methods for one objective.
///
/// swarm_then_pattern is the hybrid that users of GenOpt know as GPSPSOCCHJ (Wetter 2010;
/// paper 2): a particle swarm on a mesh, then a Hooke-Jeeves pattern search from its
/// best point. GenOpt stops there, which is in a wrong valley too often (bench_optimisers
/// has the rates). Here, where the budget allows, as many evaluations again go to kicks:
/// one to three variables of the best point are drawn anew, a coarse pattern search goes
/// on from there, and what is better becomes the best (iterated local search; Lourenco,
/// Martin and Stuetzle 2003). Then it starts again with a swarm drawn anew, twice as
/// large (up to four doublings; Auger and Hansen 2005 do so with CMA-ES), until the
/// budget is spent.
#pragma once

#include "optimise/optimiser.hpp"
#include "optimise/pattern_search.hpp"
#include "optimise/swarm.hpp"

#include <cstdint>

namespace bemcal::optimise {

enum class MethodKind { swarm_then_pattern, swarm, pattern };

struct MethodOptions {
    MethodKind kind = MethodKind::swarm_then_pattern;
    SwarmOptions swarm;
    PatternOptions pattern;
    PatternOptions kick{0x1p-3, 0x1p-7};  ///< of the search after a kick
    int most_restarts = 1000000;          ///< of swarm_then_pattern; 0: no kicks either
    std::uint64_t seed = 0;
    std::uint32_t stream = 0;  ///< of the seed
};

Method make_method(const MethodOptions& options);

}  // namespace bemcal::optimise
