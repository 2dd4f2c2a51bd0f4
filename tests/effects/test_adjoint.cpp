/// The way back through a simulation (physics/response.hpp), for the coefficient of every
/// effect of the catalogue: against central differences.
#include "effects/catalogue.hpp"
#include "kernel/response_derivative.hpp"
#include "office.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;

constexpr physics::Quantity meters[] = {
    physics::Quantity::air_temperature, physics::Quantity::cooling,
    physics::Quantity::electricity, physics::Quantity::gas};

/// Checks an effect at its typical size; says whether it moves a meter and no set-point
/// or limit switches nearby, so that there was something to check.
bool is_checked(const Effect& effect, const Office& office) {
    const Placed placed = place(std::span(&effect, 1), office.around);
    std::vector<physics::Parameter> parameters = placed.parameters;
    parameters[0].nominal = effect.typical;
    const kernel::Batch batch(placed.building, parameters, placed.drive);
    const kernel::Response response(batch, physics::test::some_channels());
    if (!response.is_differentiable()) return false;
    const auto run = response.make_run();
    physics::test::write_sensitivities(response, *run);
    const auto expected = physics::test::slopes_of_all(response, parameters, *run)[0];
    const double all = static_cast<double>(physics::test::objective(response, *run, 0));
    Matrix gradient(1, 1);
    response.pull_back(*run, gradient);
    const double g = gradient(0, 0), size = std::max(std::fabs(g), 1e-4 * all);
    if (!expected.is_smooth(size)) return false;
    EXPECT_NEAR(g, expected.near, 1e-6 * size) << effect.name;
    return std::fabs(expected.near * effect.typical) > 1e-6 * all;
}

/// Names and hooks of what has been checked.
struct Checked {
    std::set<std::string> names;
    std::set<Hook> hooks;

    void check_all(const Office& office) {
        for (const Effect& effect : named_candidates(office.around, meters)) {
            if (names.contains(effect.name) || !is_checked(effect, office)) continue;
            names.insert(effect.name);
            hooks.insert(effect.hook);
        }
    }
};

TEST(Adjoint, OfEveryHookIsThatOfCentralDifferences) {
    const Office spring("2021-03-15", "2021-04-15"), summer("2021-06-15", "2021-07-15");
    Checked checked;
    checked.check_all(spring);
    checked.check_all(summer);
    for (const Effect& effect : named_candidates(spring.around, meters))
        EXPECT_TRUE(checked.hooks.contains(effect.hook)) << name_of(effect.hook);
    EXPECT_GE(checked.names.size(), 60U);
}

}  // namespace
}  // namespace bemcal::effects
