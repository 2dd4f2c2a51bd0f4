/// Metropolis's moves: a random walk by the learnt covariance, one coordinate after the
/// other ("Metropolis within Gibbs"), and whole numbers, all others equally likely.
/// Source: Haario, Saksman and Tamminen 2001, Bernoulli 7(2), the covariance frozen after
/// the warm-up. Conditional distributions in closed form are not used.
#include "sampling/normal.hpp"
#include "sampling/walker.hpp"

#include <numeric>

namespace bemcal::sampling {

Task<Transition> random_walk(Walker& walker) {
    fill_standard_normal(walker.random, walker.step);
    walker.trial.x = walker.current.x;
    walker.metric.move(walker.trial.x, walker.scales[0], walker.step);
    co_await walker.evaluate(walker.trial);
    walker.acceptances[0] = walker.decide();
    co_return Transition{walker.acceptances[0], 1};
}

Task<Transition> gibbs(Walker& walker) {
    const std::size_t n = walker.metric.size();
    for (std::size_t i = 0; i < n; ++i) {
        walker.trial.x = walker.current.x;
        walker.trial.x[walker.coordinates.real[i]] +=
            walker.scales[i] * standard_normal(walker.random);
        co_await walker.evaluate(walker.trial);
        walker.acceptances[i] = walker.decide();
    }
    const double sum =
        std::accumulate(walker.acceptances.begin(), walker.acceptances.end(), 0.0);
    co_return Transition{sum / static_cast<double>(n), static_cast<int>(n)};
}

Task<int> move_whole_numbers(Walker& walker) {
    int n_evaluations = 0;
    for (const std::size_t i : walker.coordinates.whole) {
        const int n_levels = walker.coordinates.levels[i];
        if (n_levels < 2) continue;
        const int now = static_cast<int>(walker.current.x[i]);
        const int other =
            static_cast<int>(walker.random.below(static_cast<unsigned>(n_levels - 1)));
        walker.trial.x = walker.current.x;
        walker.trial.x[i] = other < now ? other : other + 1;
        co_await walker.evaluate(walker.trial);
        walker.decide();
        ++n_evaluations;
    }
    co_return n_evaluations;
}

}  // namespace bemcal::sampling
