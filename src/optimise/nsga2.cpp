/// NSGA-II: tournaments, children, and the best of parents and children by front and
/// crowding, generation by generation.
/// Source: Deb, Pratap, Agarwal and Meyarivan 2002. The start point is one of the first.
/// Constraints are left out; crossover and mutation are in variation, fronts in fronts.
#include "optimise/nsga2.hpp"

#include "optimise/fronts.hpp"
#include "optimise/variation.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace bemcal::optimise {
namespace {

using sampling::Task;

struct Individual {
    Position position;
    std::vector<double> objectives;
    std::size_t front = 0;
    double crowding = 0;
};
using Population = std::vector<Individual>;

/// Crowded comparison.
bool is_better(const Individual& a, const Individual& b) {
    return a.front != b.front ? a.front < b.front : a.crowding > b.crowding;
}

Matrix objectives_of(const Population& population) {
    Matrix objectives(population.size(), population[0].objectives.size());
    for (std::size_t r = 0; r < population.size(); ++r)
        std::ranges::copy(population[r].objectives, objectives.row(r).begin());
    return objectives;
}

/// The n best, front by front; of the last that has room, the least crowded.
Population best_of(Population all, std::size_t n) {
    const Matrix objectives = objectives_of(all);
    Population kept;
    std::size_t number = 0;
    for (const auto& front : sort_into_fronts(objectives)) {
        const std::vector<double> crowding = crowding_of(objectives, front);
        std::vector<std::size_t> order(front.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        if (kept.size() + front.size() > n)
            std::ranges::stable_sort(order, std::greater<>(),
                                     [&](std::size_t k) { return crowding[k]; });
        for (const std::size_t k : order) {
            if (kept.size() == n) return kept;
            kept.push_back(std::move(all[front[k]]));
            kept.back().front = number;
            kept.back().crowding = crowding[k];
        }
        ++number;
    }
    return kept;
}

/// Rows 0 .. n - 1 in a random order.
std::vector<std::uint32_t> shuffled(std::size_t n, Stream& random) {
    std::vector<std::uint32_t> rows(n);
    std::iota(rows.begin(), rows.end(), 0U);
    for (std::size_t k = n; k > 1; --k)
        std::swap(rows[k - 1], rows[random.below(static_cast<std::uint32_t>(k))]);
    return rows;
}

/// Which of two rows wins.
std::uint32_t winner(const Population& population, std::uint32_t a, std::uint32_t b,
                     Stream& random) {
    if (is_better(population[a], population[b])) return a;
    if (is_better(population[b], population[a])) return b;
    return random.uniform() < 0.5 ? a : b;
}

/// Winners of tournaments in which everybody takes part twice.
std::vector<Position> parents_of(const Population& population, Stream& random) {
    std::vector<Position> parents;
    parents.reserve(population.size());
    for (int turn = 0; turn < 2; ++turn) {
        const auto rows = shuffled(population.size(), random);
        for (std::size_t k = 0; k + 1 < rows.size(); k += 2)
            parents.push_back(
                population[winner(population, rows[k], rows[k + 1], random)].position);
    }
    return parents;
}

std::vector<Position> children_of(const Space& space, const Nsga2Options& options,
                                  const Population& population, Stream& random) {
    const std::vector<Position> parents = parents_of(population, random);
    std::vector<Position> children;
    children.reserve(parents.size());
    for (std::size_t k = 0; k + 1 < parents.size(); k += 2) {
        auto [one, other] = cross(space, options, parents[k], parents[k + 1], random);
        children.push_back(mutated(space, options, std::move(one), random));
        children.push_back(mutated(space, options, std::move(other), random));
    }
    return children;
}

/// The described building is the first of them.
std::vector<Position> first_positions(const Space& space, const Nsga2Options& options,
                                      Stream random) {
    std::vector<Position> positions{space.start()};
    positions.reserve(static_cast<std::size_t>(options.n_population));
    for (int k = 1; k < options.n_population; ++k)
        positions.push_back(space.draw(random));
    return positions;
}

void add(const std::vector<Position>& positions, const Matrix& values,
         Population& population) {
    population.reserve(population.size() + positions.size());
    for (std::size_t r = 0; r < positions.size(); ++r) {
        const auto row = values.row(r);
        population.push_back({positions[r], {row.begin(), row.end()}});
    }
}

/// A point that is there twice is one of the front.
void keep_front(const Population& population, Search& search) {
    std::vector<Found> front;
    for (const Individual& each : population)
        if (each.front == 0 &&
            std::ranges::find(front, each.position, &Found::position) == front.end())
            front.push_back({each.position, each.objectives});
    search.keep(std::move(front));
}

Task<> nsga2(Search& search, Nsga2Options options) {
    const Space& space = search.space();
    const auto n = static_cast<std::size_t>(options.n_population);
    Population population;
    for (int g = 0; g < options.n_generations; ++g) {
        Stream random(options.seed, options.stream, static_cast<std::uint64_t>(g));
        const std::vector<Position> positions =
            g == 0 ? first_positions(space, options, random)
                   : children_of(space, options, population, random);
        const Matrix values = co_await search.evaluate(positions);
        add(positions, values, population);
        population = best_of(std::move(population), n);
        keep_front(population, search);
    }
}

}  // namespace

Method make_nsga2(const Nsga2Options& options) {
    if (options.n_population < 4 || options.n_population % 2 != 0)
        throw std::invalid_argument(
            "a population of NSGA-II must be even and have at least 4 points");
    return [options](Search& search) { return nsga2(search, options); };
}

}  // namespace bemcal::optimise
