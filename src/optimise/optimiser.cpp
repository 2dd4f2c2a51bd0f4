/// An optimiser as its users see it: it starts a method, hands out the points that it
/// waits for, and goes on when told their values.
/// Plain bookkeeping without a source. It simulates nothing and stores nothing: it is
/// resumed by being told the same values again.
#include "optimise/optimiser.hpp"

namespace bemcal::optimise {

Optimiser::Optimiser(Space space, std::size_t n_objectives, const Limits& limits,
                     const Method& method)
    : search_(std::make_unique<Search>(std::move(space), n_objectives, limits)),
      task_(method(*search_)) {
    task_.start();
    search_->proceed();
    task_.check();
}

void Optimiser::tell(const Matrix& values) {
    search_->answer(values);
    task_.check();
}

Matrix Optimiser::found_points() const {
    std::vector<Position> positions;
    positions.reserve(found().size());
    for (const Found& found : found()) positions.push_back(found.position);
    return space().values_of(positions);
}

}  // namespace bemcal::optimise
