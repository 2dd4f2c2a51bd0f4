/// The methods for one objective.
///
/// swarm_then_pattern is the hybrid that users of GenOpt know as GPSPSOCCHJ (Wetter 2010;
/// paper 2): a particle swarm on a mesh, then a Hooke-Jeeves pattern search from its
/// best point. GenOpt stops there, which is in a wrong valley too often (bench_optimisers
/// has the rates). Here the rest of the budget goes to kicks: of the best point one
/// variable, or a few, are drawn anew, the others adapt to them by a pattern search of
/// one coarse step, all move by finer ones, and what is no worse becomes the best
/// (iterated local search; Lourenco, Martin and Stuetzle 2003). New and larger swarms
/// (Auger and Hansen 2005 start CMA-ES again so) are left out: on the functions of
/// bench_optimisers they find less, though more on Rastrigin's turned off its axes.
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
    bool with_kicks = true;               ///< of swarm_then_pattern: to the budget's end
    PatternOptions kick{0x1p-3, 0x1p-6};  ///< of the search after a kick
    double one_more = 0.3;  ///< probability of one more variable in a kick, again
    std::uint64_t seed = 0;
    std::uint32_t stream = 0;  ///< of the seed
};

Method make_method(const MethodOptions& options);

}  // namespace bemcal::optimise
