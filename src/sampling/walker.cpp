/// What the methods share: which coordinates are real, first scales, Metropolis's
/// decision, and the order of moves.
/// Source: Metropolis's rule; 2.38 / sqrt(n): Roberts, Gelman and Gilks 1997. The moves
/// are in nuts and metropolis, learning in adaptation.
#include "sampling/walker.hpp"

#include <cmath>
#include <utility>

namespace bemcal::sampling {
namespace {

Task<Transition> move_real_coordinates(Walker& walker) {
    switch (walker.method) {
        case Method::random_walk:
            return random_walk(walker);
        case Method::gibbs:
            return gibbs(walker);
        default:
            return nuts(walker);
    }
}

MetricShape shape_for(const SamplerOptions& options) {
    const bool is_dense = options.dense_metric && options.method != Method::gibbs;
    return is_dense ? MetricShape::dense : MetricShape::diagonal;
}

/// 2.38 / sqrt(n): Roberts, Gelman and Gilks 1997.
std::vector<double> first_scales(Method method, std::size_t n_real) {
    const auto n = static_cast<double>(n_real);
    if (method == Method::gibbs) return std::vector<double>(n_real, 1.0);
    return {method == Method::random_walk && n_real > 0 ? 2.38 / std::sqrt(n) : 1.0};
}

}  // namespace

Coordinates coordinates_of(const Density& density) {
    Coordinates coordinates{
        density.dimension(), {}, {}, density.levels(), density.held_in_climb()};
    for (std::size_t i = 0; i < coordinates.dimension; ++i) {
        const bool is_real = coordinates.levels[i] == 0;
        (is_real ? coordinates.real : coordinates.whole).push_back(i);
    }
    return coordinates;
}

Walker::Walker(Company& its_company, const Coordinates& its_coordinates,
               const SamplerOptions& options, double its_inverse_temperature,
               const Stream& its_random)
    : company(its_company),
      coordinates(its_coordinates),
      method(options.method),
      inverse_temperature(its_inverse_temperature),
      random(its_random),
      current(coordinates.dimension),
      trial(coordinates.dimension),
      metric(coordinates.real, shape_for(options)),
      scales(first_scales(method, metric.size())),
      acceptances(scales.size()),
      step(metric.size()),
      trajectory(coordinates.dimension, metric.size(),
                 method == Method::nuts ? options.most_depth : 0) {}

double Walker::decide() {
    const double gain = log_density(trial) - log_density(current);
    const double acceptance = gain >= 0 ? 1 : std::exp(gain);
    if (random.uniform() < acceptance) std::swap(current, trial);
    return acceptance;
}

Task<Transition> transition_of(Walker& walker) {
    Transition transition;
    if (walker.metric.size() > 0) transition = co_await move_real_coordinates(walker);
    if (!walker.coordinates.whole.empty())
        transition.n_steps += co_await move_whole_numbers(walker);
    co_return transition;
}

}  // namespace bemcal::sampling
