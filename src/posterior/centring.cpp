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

/// Free unknowns that have a size, by their free numbers.
std::vector<std::size_t> sized(const Space& space) {
    std::vector<std::size_t> found;
    for (std::size_t f = 0; f < space.n_free(); ++f)
        if (space.coordinates()[space.index_of(f)].in) found.push_back(f);
    return found;
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

/// The middle of the priors, and it with each of these unknowns moved by its size.
Matrix moved_by_sizes(const Space& space, const std::vector<std::size_t>& of) {
    const std::vector<double> middle = middle_of(space);
    Matrix positions(0, space.n_free());
    positions.add_row(space.position_of(middle));
    for (const std::size_t f : of) {
        std::vector<double> values = middle;
        const std::size_t k = space.index_of(f);
        if (const auto& size = space.coordinates()[k].in) values[k] += middle[*size];
        positions.add_row(space.position_of(values));
    }
    return positions;
}

}  // namespace

std::vector<double> shares_of_readings(
    const std::shared_ptr<const PosteriorParts>& parts) {
    const std::vector<std::size_t> of = sized(*parts->space);
    std::vector<double> shares(parts->space->n_free(), 1);
    if (of.empty()) return shares;
    const Matrix positions = moved_by_sizes(*parts->space, of);
    sampling::Evaluations at;
    make_posterior_density(parts)->evaluate(positions, true, at);
    const Matrix& slopes = at.likelihood_gradient;
    for (std::size_t k = 0; k < of.size(); ++k) {
        const std::size_t f = of[k];
        const double size = positions(k + 1, f) - positions(0, f),
                     told = std::max((slopes(0, f) - slopes(k + 1, f)) * size, 0.0);
        shares[f] = told / (1 + told);
    }
    return shares;
}

void centre(const std::shared_ptr<PosteriorParts>& parts) {
    if (parts->buildings.size() != 1 || sized(*parts->space).empty()) return;
    const std::vector<double> shares = shares_of_readings(parts);
    std::vector<Coordinate> coordinates = parts->space->coordinates();
    for (std::size_t f = 0; f < shares.size(); ++f)
        coordinates[parts->space->index_of(f)].centring = shares[f];
    parts->space = std::make_shared<const Space>(std::move(coordinates));
    parts->arrangement = make_arrangement(Pooling::none, parts->space, {});
}

}  // namespace bemcal::posterior
