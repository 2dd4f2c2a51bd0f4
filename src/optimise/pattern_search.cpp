/// Hooke and Jeeves' search in batches: all variables up and down at once, then sums of
/// the best moves, then a move as far again; steps halve where nothing is better.
/// Source: Hooke and Jeeves 1961; Wetter's GPS (GenOpt manual 3.1, 5.2); batches are our
/// own. It finds the valley it starts in; a pattern leaves discrete variables.
#include "optimise/pattern_search.hpp"

#include <algorithm>
#include <utility>

namespace bemcal::optimise {
namespace {

/// One variable, elsewhere.
struct Move {
    std::size_t variable = 0;
    double to = 0;
    double value = 0;  ///< of the objective there
};

Position moved(Position position, const Move& move) {
    position[move.variable] = move.to;
    return position;
}

void add_move(const Space& space, std::size_t k, double to, std::vector<Move>& moves) {
    if (to >= 0 && to <= space.highest(k)) moves.push_back({k, to, 0});
}

/// Those that stay in the range.
std::vector<Move> moves_from(const Space& space, const Position& centre, double step,
                             const std::vector<bool>& held) {
    std::vector<Move> moves;
    for (std::size_t k = 0; k < space.size(); ++k) {
        if (!held.empty() && held[k]) continue;
        const double last = space.is_discrete(k) ? space.highest(k) : step;
        for (double by = space.is_discrete(k) ? 1 : step; by <= last; by *= 2) {
            add_move(space, k, centre[k] + by, moves);
            add_move(space, k, centre[k] - by, moves);
        }
    }
    return moves;
}

/// Of each variable the best move that is better than the centre; the best first.
std::vector<Move> gains(std::vector<Move> moves, double centre) {
    std::erase_if(moves, [&](const Move& move) { return !(move.value < centre); });
    std::ranges::stable_sort(moves, {}, &Move::value);
    std::vector<Move> best;
    for (const Move& move : moves)
        if (std::ranges::find(best, move.variable, &Move::variable) == best.end())
            best.push_back(move);
    return best;
}

/// The centre with the best move, the two best, the three best, ...
std::vector<Position> sums_of(const Position& centre, const std::vector<Move>& moves) {
    std::vector<Position> sums;
    Position sum = centre;
    for (std::size_t n = 0; n < moves.size(); ++n) {
        sum = moved(std::move(sum), moves[n]);
        sums.push_back(sum);
    }
    return sums;
}

const Found& better_of(const Found& a, const Found& b) {
    return b.objectives[0] < a.objectives[0] ? b : a;
}

/// The best of positions and their values.
Found best_of(const std::vector<Position>& positions, const Matrix& values) {
    const auto best = static_cast<std::size_t>(std::ranges::min_element(values.values) -
                                               values.values.begin());
    return {positions[best], {values.values[best]}};
}

/// The best point that the moves around the centre lead to, the centre included.
sampling::Task<Found> explore(Search& search, Position centre, double step,
                              const std::vector<bool>& held) {
    std::vector<Move> moves = moves_from(search.space(), centre, step, held);
    std::vector<Position> positions{centre};
    for (const Move& move : moves) positions.push_back(moved(centre, move));
    const Matrix values = co_await search.evaluate(positions);
    for (std::size_t k = 0; k < moves.size(); ++k) moves[k].value = values(k + 1, 0);
    const Found found = best_of(positions, values);
    const std::vector<Move> better = gains(std::move(moves), values(0, 0));
    if (better.size() < 2) co_return found;
    const std::vector<Position> sums = sums_of(centre, better);
    const Matrix of_sums = co_await search.evaluate(sums);
    co_return better_of(found, best_of(sums, of_sums));
}

/// As far again as from `before` to `base`; a discrete variable stays where it is.
Position pattern_move(const Space& space, const Position& before, const Position& base) {
    Position position = base;
    for (std::size_t k = 0; k < space.size(); ++k)
        if (!space.is_discrete(k)) position[k] += base[k] - before[k];
    return space.snapped(std::move(position), 0);
}

}  // namespace

sampling::Task<Found> pattern_search(Search& search, PatternOptions options,
                                     Position start) {
    const std::vector<Position> first(1, start);
    const Matrix value = co_await search.evaluate(first);
    Found base{std::move(start), {value(0, 0)}};
    Position before;  // empty: no pattern
    for (double step = options.first_step; step >= options.last_step;) {
        const Position centre = before.empty()
                                    ? base.position
                                    : pattern_move(search.space(), before, base.position);
        Found found = co_await explore(search, centre, step, options.held);
        if (found.objectives[0] < base.objectives[0]) {
            before = std::exchange(base, std::move(found)).position;
        } else {
            if (before.empty()) step /= 2;
            before.clear();
        }
    }
    co_return base;
}

}  // namespace bemcal::optimise
