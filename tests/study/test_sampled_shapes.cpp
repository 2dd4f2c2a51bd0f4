/// Functions that a posterior samples: their parameters, and what a column brings.
#include "job/small_office.hpp"
#include "posterior/posterior_density.hpp"
#include "study/points.hpp"
#include "study/sampled_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

/// The office of the sample job with an effect that follows a function.
Case office(const std::string& hook, const std::vector<double>& values, double spread) {
    return job::small_office_with(job::effect_that_follows(hook, values, spread));
}

std::vector<double> nominal(const Case& building) {
    return nominal_point(building.parameters);
}

/// Of all meters in all periods.
std::vector<double> readings(const Case& building, const std::vector<double>& point) {
    Matrix points(1, point.size());
    std::ranges::copy(point, points.values.begin());
    std::vector<double> all;
    for (const Period& period : building.periods)
        for (const Matrix& meter :
             posterior::BuildingModel(building, period, {}).predict(points))
            all.insert(all.end(), meter.values.begin(), meter.values.end());
    return all;
}

/// Of the parameters; residuals have any.
std::vector<double> nominal_values(const Case& building, const Space& space) {
    std::vector<double> values = nominal(building);
    for (std::size_t k = values.size(); k < space.size(); ++k)
        values.push_back(space.coordinates()[k].prior.quantile(0.5));
    return values;
}

TEST(SampledShapes, WithoutASpreadTheCaseStays) {
    std::vector<SampledFunction> functions;
    const Case made = office("gains", {1, 0, 2, 1}, 0);
    EXPECT_EQ(with_sampled_shapes(made, made.periods.at(0), functions).parameters.size(),
              made.parameters.size());
    EXPECT_TRUE(functions.empty());
}

TEST(SampledShapes, EachHasASizeAndItsColumnsBehindTheParameters) {
    std::vector<SampledFunction> functions;
    const Case made = office("gains", {1, 0, 2, 1}, 0.5);
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    ASSERT_EQ(functions.size(), 1U);
    const SampledFunction& one = functions[0];
    EXPECT_EQ(one.name, "use by outdoor temperature");
    EXPECT_EQ(one.unit, "W/m2");
    const std::size_t size = made.parameters.size();
    ASSERT_EQ(sampled.parameters.size(), size + 1 + one.columns.cols);
    EXPECT_EQ(sampled.priors.size(), sampled.parameters.size());
    EXPECT_EQ(sampled.parameters[size].name, "use by outdoor temperature: size");
    EXPECT_NEAR(sampled.priors[size].prior.quantile(0.5), 0.5, 1e-12);
    for (std::size_t k = size + 1; k < sampled.parameters.size(); ++k)
        EXPECT_EQ(sampled.priors[k].in, size);
}

TEST(SampledShapes, AtNominalValuesTheBuildingStays) {
    std::vector<SampledFunction> functions;
    const Case made = office("gains", {1, 0, 2, 1}, 0.5);
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    EXPECT_EQ(readings(sampled, nominal(sampled)), readings(made, nominal(made)));
}

/// In every period, also beyond the knots, and where a share could not be taken alone.
TEST(SampledShapes, AColumnsCoefficientIsADeviationOfTheValues) {
    for (const char* hook : {"gains", "infiltration", "aperture"}) {
        std::vector<SampledFunction> functions;
        const std::vector<double> values{0.2, 0, 0.4, 0.2};
        const Case made = office(hook, values, 0.2);
        const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
        std::vector<double> point = nominal(sampled), moved = values;
        for (std::size_t c = 0; c < functions[0].columns.cols; ++c) {
            const double coefficient = c == 0 ? 0.05 : -0.03;
            point[made.parameters.size() + 1 + c] = coefficient;
            for (std::size_t p = 0; p < moved.size(); ++p)
                moved[p] += coefficient * functions[0].columns(p, c);
        }
        const Case declared = office(hook, moved, 0);
        const auto expected = readings(declared, nominal(declared)),
                   found = readings(sampled, point);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); ++k)
            EXPECT_NEAR(found[k], expected[k], 1e-9 * (1 + std::abs(expected[k])))
                << hook;
    }
}

/// The office with heat that somebody brings from a moment on.
Case office_with_step(const std::string& since, int within, double coefficient) {
    return job::small_office_with(
        fmt::format("[[effect]]\nname = \"tenant\"\nhook = \"gains\"\ndriver = "
                    "\"time elapsed\"\nsince = \"{}\"\ncoefficient = {}\n{}\n",
                    since, coefficient,
                    within > 0 ? fmt::format("since_within = {}\n", within) : ""));
}

/// What chains would simulate: a day that is sampled and a coefficient, through the
/// space.
std::vector<double> point_of_step(const Case& sampled, double day) {
    const posterior::BuildingModel model(sampled, sampled.periods[0], {});
    const auto space = posterior::space_of(model);
    std::vector<double> values(space->size());
    std::vector<double> position = space->position_of(nominal_values(sampled, *space));
    for (std::size_t f = 0; f < space->n_free(); ++f) {
        const auto& coordinate = space->coordinates()[space->index_of(f)];
        if (coordinate.name == "tenant: day")
            position[f] = stats::transform_of(coordinate.prior).inverse(day);
    }
    space->read(position, values);
    values.resize(sampled.parameters.size());
    return values;
}

TEST(SampledShapes, AStepsDayIsThatOfTheStepDeclaredThen) {
    std::vector<SampledFunction> functions;
    const Case made = office_with_step("2021-01-12", 3, 2);
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    EXPECT_EQ(sampled.parameters.size(), made.parameters.size() + 2 + 6);
    EXPECT_EQ(readings(sampled, nominal(sampled)), readings(made, nominal(made)));
    for (const int day : {-2, 0, 2}) {
        const Case then = office_with_step(fmt::format("2021-01-{}", 12 + day), 0, 2);
        const auto expected = readings(then, nominal(then)),
                   found = readings(sampled, point_of_step(sampled, day));
        for (std::size_t k = 0; k < found.size(); ++k)
            ASSERT_NEAR(found[k], expected[k], 1e-9 * (1 + std::abs(expected[k]))) << day;
    }
}

/// A night that starts from what the last one found.
TEST(SampledShapes, NumbersThatHaveMovedSinceStay) {
    Case made = office("gains", {1, 0, 2, 1}, 0.5);
    std::vector<SampledFunction> functions;
    physics::set_nominal(made.parameters[0].most, made.parameters[0], made.building);
    const Case sampled = with_sampled_shapes(made, made.periods.at(0), functions);
    EXPECT_EQ(readings(sampled, nominal(sampled)), readings(made, nominal(made)));
}

}  // namespace
}  // namespace bemcal::study
