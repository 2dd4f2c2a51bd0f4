#include "optimise/methods.hpp"

#include <algorithm>

namespace bemcal::optimise {
namespace {

using sampling::Task;

constexpr int most_doublings = 4;
constexpr std::size_t most_kicked = 3;           ///< variables in a kick
constexpr std::uint64_t kicks_item = 1U << 20U;  ///< of the stream; before it: swarms

Position kicked(const Space& space, Position position, Stream& random) {
    const Position anywhere = space.draw(random);
    const auto n = static_cast<std::uint32_t>(space.size());
    const auto most = static_cast<std::uint32_t>(std::min(most_kicked, space.size()));
    for (std::uint32_t left = 1 + random.below(most); left > 0; --left) {
        const std::uint32_t k = random.below(n);
        position[k] = anywhere[k];
    }
    return position;
}

/// About so many evaluations; never more tries than that.
Task<> kick(Search& search, MethodOptions options, Stream random, std::size_t n) {
    Found best = search.found()[0];
    const std::size_t until = search.n_evaluated() + n;
    for (std::size_t k = 0; k < n && search.n_evaluated() < until; ++k) {
        const Position at = kicked(search.space(), best.position, random);
        const Found found = co_await pattern_search(
            search, options.kick, search.space().snapped(at, options.swarm.mesh));
        if (found.objectives[0] < best.objectives[0]) best = found;
    }
    co_await pattern_search(search, options.pattern, best.position);
}

/// A start that brings no new point ends it: all of a small space is known.
Task<> swarm_then_pattern(Search& search, MethodOptions options) {
    for (int start = 0; start <= options.most_restarts; ++start) {
        const std::size_t n_before = search.n_evaluated();
        const auto item = static_cast<std::uint64_t>(start);
        SwarmOptions swarm_options = options.swarm;
        swarm_options.n_particles <<= std::min(start, most_doublings);
        Stream random(options.seed, options.stream, item);
        const Position first =
            start == 0 ? search.space().start() : search.space().draw(random);
        const Found found = co_await swarm(search, swarm_options, random, first);
        co_await pattern_search(search, options.pattern, found.position);
        const std::size_t n_used = search.n_evaluated() - n_before;
        if (n_used == 0) co_return;
        if (options.most_restarts > 0)
            co_await kick(search, options,
                          Stream(options.seed, options.stream, kicks_item + item),
                          n_used);
    }
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
