/// Chooses between the centred and the non-centred form for each coefficient of unknown
/// size by what readings tell of it. Of information I, and with the size s, readings have
/// the share I s^2 / (1 + I s^2) in its posterior; with this power of the size neither
/// form's funnel is left where coefficients are normal.
/// Source: Papaspiliopoulos, Roberts and Skoeld 2003 (Bayesian Statistics 7, section 4).
/// Left out: the information of several coefficients together, and what changes with the
/// size.
#include "posterior/centring.hpp"

#include <algorithm>

namespace bemcal::posterior {
namespace {

using study::Coordinate;
using study::Space;

bool has_sizes(const Space& space) {
    return std::ranges::any_of(space.coordinates(),
                               [](const Coordinate& one) { return one.in.has_value(); });
}

/// In their own units.
std::vector<double> middle_of(const Space& space) {
    std::vector<double> values;
    values.reserve(space.size());
    for (const Coordinate& one : space.coordinates())
        values.push_back(one.values.empty() ? one.prior.quantile(0.5)
                                            : one.values[one.values.size() / 2]);
    return values;
}

/// The middle of the priors, and it with each free unknown that has a size moved by that.
Matrix moved_by_sizes(const Space& space) {
    const std::vector<double> middle = middle_of(space);
    Matrix positions(space.n_free() + 1, space.n_free());
    for (std::size_t r = 0; r <= space.n_free(); ++r) {
        std::vector<double> values = middle;
        if (r > 0) {
            const std::size_t k = space.index_of(r - 1);
            if (const auto& size = space.coordinates()[k].in) values[k] += middle[*size];
        }
        std::ranges::copy(space.position_of(values), positions.row(r).begin());
    }
    return positions;
}

}  // namespace

std::vector<double> shares_of_readings(
    const std::shared_ptr<const PosteriorParts>& parts) {
    const Space& space = *parts->space;
    std::vector<double> shares(space.n_free(), 1);
    if (!has_sizes(space)) return shares;
    const Matrix positions = moved_by_sizes(space);
    sampling::Evaluations at;
    make_posterior_density(parts)->evaluate(positions, true, at);
    for (std::size_t f = 0; f < shares.size(); ++f) {
        if (!space.coordinates()[space.index_of(f)].in) continue;
        const double size = positions(f + 1, f) - positions(0, f),
                     by_size =
                         at.likelihood_gradient(0, f) - at.likelihood_gradient(f + 1, f),
                     told = std::max(by_size * size, 0.0);
        shares[f] = told / (1 + told);
    }
    return shares;
}

void centre(const std::shared_ptr<PosteriorParts>& parts) {
    if (parts->buildings.size() != 1 || !has_sizes(*parts->space)) return;
    const std::vector<double> shares = shares_of_readings(parts);
    std::vector<Coordinate> coordinates = parts->space->coordinates();
    for (std::size_t f = 0; f < shares.size(); ++f)
        coordinates[parts->space->index_of(f)].centring = shares[f];
    parts->space = std::make_shared<const Space>(std::move(coordinates));
    parts->arrangement = make_arrangement(Pooling::none, parts->space, {});
}

}  // namespace bemcal::posterior
