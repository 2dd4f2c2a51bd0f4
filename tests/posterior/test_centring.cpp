/// Coefficients of unknown size: what share readings have in them, and that the density
/// of values stays.
#include "job/small_office.hpp"
#include "posterior/centring.hpp"
#include "study/sampled_shapes.hpp"
#include "support/simulated_fit.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::posterior {
namespace {

/// The office of the sample job with a function at its gains that is sampled.
std::shared_ptr<PosteriorParts> parts_with(double reading_weight, double spread = 0.5) {
    std::vector<study::SampledFunction> functions;
    study::Case made =
        job::small_office_with(job::effect_that_follows("gains", {1, 0, 2, 1}, spread));
    const study::Period period = made.periods.at(0);
    made = study::with_sampled_shapes(std::move(made), period, functions);
    return test::parts_of(std::make_unique<BuildingModel>(made, period, MeterChoice{}),
                          reading_weight);
}

std::vector<double> odds_by_weight(double weight) {
    std::vector<double> odds;
    const auto parts = parts_with(weight);
    const std::vector<double> shares = shares_of_readings(parts);
    for (std::size_t f = 0; f < shares.size(); ++f)
        if (parts->space->coordinates()[parts->space->index_of(f)].in)
            odds.push_back(shares[f] / (1 - shares[f]) / weight);
    return odds;
}

/// Odds of readings against the prior are as the weight of readings.
TEST(Centring, ReadingsHaveTheShareOfTheirInformation) {
    const std::vector<double> full = odds_by_weight(1), weak = odds_by_weight(1e-3);
    ASSERT_GE(full.size(), 2U);
    for (std::size_t k = 0; k < full.size(); ++k) {
        EXPECT_GT(full[k], 0);
        EXPECT_NEAR(weak[k], full[k], 1e-6 * full[k]);
    }
}

TEST(Centring, OtherUnknownsStayInTheirOwnUnits) {
    const auto parts = parts_with(1e-3);
    const std::vector<double> shares = shares_of_readings(parts);
    for (std::size_t f = 0; f < shares.size(); ++f)
        if (!parts->space->coordinates()[parts->space->index_of(f)].in) {
            EXPECT_EQ(shares[f], 1);
        }
    const auto fixed = parts_with(1, 0);
    const auto space = fixed->space;
    centre(fixed);
    EXPECT_EQ(fixed->space, space);
}

/// At values, densities differ by the Jacobian: the size to the power of what the forms
/// differ by.
TEST(Centring, TheDensityOfValuesStays) {
    const auto own = parts_with(1e-3), centred = parts_with(1e-3);
    centre(centred);
    const study::Space& space = *own->space;
    std::vector<double> middle;
    for (const study::Coordinate& one : space.coordinates())
        middle.push_back(one.prior.quantile(0.6));
    double jacobian = 0;
    for (std::size_t k = 0; k < space.size(); ++k)
        if (const auto& in = space.coordinates()[k].in)
            jacobian +=
                (1 - centred->space->coordinates()[k].centring) * std::log(middle[*in]);
    const auto density = [&](const auto& parts) {
        const std::vector<double> position = parts->space->position_of(middle);
        Matrix points(1, position.size());
        std::ranges::copy(position, points.values.begin());
        sampling::Evaluations at;
        make_posterior_density(parts)->evaluate(points, false, at);
        return at.prior[0] + at.likelihood[0];
    };
    EXPECT_GT(std::abs(jacobian), 0.1);
    const double of_own = density(own);
    EXPECT_NEAR(density(centred), of_own + jacobian, 1e-9 * std::abs(of_own));
}

}  // namespace
}  // namespace bemcal::posterior
