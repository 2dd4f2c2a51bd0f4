/// The methods for one objective: a swarm, then a pattern search, then kicks until the
/// budget is spent, in which a variable or a few are drawn anew and the others adapt.
/// Source: GenOpt's GPSPSOCCHJ (Wetter 2010; paper 2); kicks: iterated local search,
/// Lourenco et al. 2003. Left out: new and larger swarms; several objectives are nsga2's.
#include "optimise/methods.hpp"

#include <utility>

namespace bemcal::optimise {
namespace {

using sampling::Task;

/// So many kicks in a row without a new point end it: all of a small space is known.
constexpr std::size_t most_in_vain = 100;

/// \param in_vain  kicks before this one that brought no new point: so many variables
/// more are drawn anew
Task<Found> kick(Search& search, MethodOptions options, Position position,
                 std::size_t in_vain, Stream& random) {
    const Space& space = search.space();
    const PatternOptions& coarse = options.kick;
    PatternOptions others{coarse.first_step, coarse.first_step};
    others.held.resize(space.size());
    const Position anywhere = space.draw(random);
    std::size_t drawn = 0;
    do {
        const std::size_t k = random.below(static_cast<std::uint32_t>(space.size()));
        position[k] = anywhere[k];
        others.held[k] = true;
    } while (++drawn <= in_vain || random.uniform() < options.one_more);
    position = space.snapped(std::move(position), options.swarm.mesh);
    const Found adapted = co_await pattern_search(search, others, position);
    const PatternOptions all{coarse.first_step / 2, coarse.last_step};
    co_return co_await pattern_search(search, all, adapted.position);
}

Task<> kicks(Search& search, MethodOptions options, Found best) {
    Stream random(options.seed, options.stream, 1);
    for (std::size_t in_vain = 0; in_vain < most_in_vain;) {
        const std::size_t n_before = search.n_evaluated();
        Found found = co_await kick(search, options, best.position, in_vain, random);
        if (found.objectives[0] < best.objectives[0])
            found = co_await pattern_search(search, options.pattern, found.position);
        if (found.objectives[0] <= best.objectives[0]) best = found;
        in_vain = search.n_evaluated() > n_before ? 0 : in_vain + 1;
    }
}

Task<> swarm_then_pattern(Search& search, MethodOptions options) {
    const Stream random(options.seed, options.stream, 0);
    const Found rough =
        co_await swarm(search, options.swarm, random, search.space().start());
    const Found best = co_await pattern_search(search, options.pattern, rough.position);
    if (options.with_kicks) co_await kicks(search, options, best);
}

Task<> swarm_alone(Search& search, MethodOptions options) {
    co_await swarm(search, options.swarm, Stream(options.seed, options.stream, 0),
                   search.space().start());
}

Task<> pattern_alone(Search& search, MethodOptions options) {
    co_await pattern_search(search, options.pattern, search.space().start());
}

}  // namespace

Method make_method(const MethodOptions& options) {
    return [options](Search& search) {
        switch (options.kind) {
            case MethodKind::swarm:
                return swarm_alone(search, options);
            case MethodKind::pattern:
                return pattern_alone(search, options);
            case MethodKind::swarm_then_pattern:
                break;
        }
        return swarm_then_pattern(search, options);
    };
}

}  // namespace bemcal::optimise
