/// The way back through a simulation (physics/response.hpp), for the coefficient of every
/// effect of the catalogue: against central differences.
#include "effects/catalogue.hpp"
#include "office.hpp"
#include "physics/response_derivative.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;

constexpr int meters[] = {0, 2, 3, 4};

/// Checks an effect at its typical size; says whether no set-point or limit switches
/// nearby, so that there was something to check.
bool is_checked(const Effect& effect, const Office& office) {
    const Placed placed = place(std::span(&effect, 1), office.around);
    std::vector<physics::Parameter> parameters = placed.parameters;
    parameters[0].nominal = effect.typical;
    const physics::Batch batch(placed.building, parameters, placed.drive);
    const physics::Response response(batch, physics::test::some_channels());
    if (!response.is_differentiable()) return false;
    const auto run = response.make_run();
    physics::test::write_sensitivities(response, *run);
    const auto expected = physics::test::slopes_of_all(response, parameters, *run)[0];
    const double floor =
        1e-4 * static_cast<double>(physics::test::objective(response, *run, 0));
    Matrix gradient(1, 1);
    response.pull_back(*run, gradient);
    const double g = gradient(0, 0), size = std::max(std::fabs(g), floor);
    if (!expected.is_smooth(size)) return false;
    EXPECT_NEAR(g, expected.near, 1e-6 * size) << effect.name;
    return true;
}

TEST(Adjoint, OfEveryEffectIsThatOfCentralDifferences) {
    const Office office("2021-03-15", "2021-04-15");
    std::set<Hook> all, checked;
    std::size_t n_checked = 0;
    std::set<std::string> seen;
    for (const Effect& effect : named_candidates(office.around, meters)) {
        if (!seen.insert(effect.name).second) continue;
        all.insert(effect.hook);
        if (!is_checked(effect, office)) continue;
        checked.insert(effect.hook);
        ++n_checked;
    }
    for (const Hook hook : all) EXPECT_TRUE(checked.contains(hook)) << name_of(hook);
    EXPECT_GE(n_checked, 60U) << "of " << seen.size();
}

}  // namespace
}  // namespace bemcal::effects
