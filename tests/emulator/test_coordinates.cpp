/// Names, scales and starts of the parameters; priors that do not fit.
#include "emulator/small_study.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

TEST(KohCoordinates, ParametersAreNamedByTheirInputsAndFixedOnesAreNot) {
    Observations o = small_study({}, 1);
    o.x_names = {"temperature", "sun"};
    o.t_names = {"u_value", "air_change"};
    ModelOptions options;
    options.emulator_mean = Mean::linear;
    options.coefficients = Coefficients::sampled;
    options.priors.lambda_e = {stats::PriorKind::fixed, 100};
    const KohDensity density(standardise(o), options);
    const std::vector<std::string> expected{"u_value",
                                            "air_change",
                                            "rho_eta_temperature",
                                            "rho_eta_sun",
                                            "rho_eta_u_value",
                                            "rho_eta_air_change",
                                            "rho_delta_temperature",
                                            "rho_delta_sun",
                                            "lambda_eta",
                                            "lambda_delta",
                                            "beta_eta_constant",
                                            "beta_eta_temperature",
                                            "beta_eta_sun"};
    EXPECT_EQ(density.names(), expected);
}

TEST(KohCoordinates, ValuesAreOnTheirOwnScales) {
    const Observations o = small_study({}, 1);
    const KohDensity density(standardise(o), {});
    const std::vector<double> values =
        density.values(std::vector<double>(density.dimension(), 0));
    EXPECT_NEAR(values[0], density.data().t[0].physical(0.5), 1e-12);
    EXPECT_DOUBLE_EQ(values[2], 0.5);
    EXPECT_DOUBLE_EQ(values.back(), 1);
}

TEST(KohCoordinates, StartsAreDispersedAsThePriorIs) {
    const KohDensity density(standardise(small_study({}, 1)), {});
    Stream random(5, 0, 0);
    constexpr int n = 2000;
    int below_half = 0, rho_above = 0;
    for (int i = 0; i < n; ++i) {
        const std::vector<double> values = density.values(density.draw_start(random));
        below_half += values[0] < density.data().t[0].physical(0.5);
        rho_above += values[2] > 0.9;  // 0.1^0.3 = 0.50 of Beta(1, 0.3)
    }
    // 5 standard errors: false alarm 1e-6
    EXPECT_NEAR(below_half, n / 2, 5 * std::sqrt(n * 0.25));
    EXPECT_NEAR(rho_above, n * std::pow(0.1, 0.3), 5 * std::sqrt(n * 0.25));
}

TEST(KohCoordinates, EveryCalibratedInputMayHaveAPriorOfItsOwn) {
    ModelOptions options;
    options.priors.t = {{stats::PriorKind::normal, 0.085, 0.2, 0, 1, false},
                        {stats::PriorKind::uniform, 0, 1, 0, 1, false}};
    KohDensity density(standardise(small_study({}, 1)), options);
    Matrix points(2, density.dimension(), 0);
    points(1, 0) = 1;
    sampling::Evaluations out;
    density.evaluate(points, false, out);
    const double x = 1 / (1 + std::exp(-1.0));
    const auto z = [](double t) { return (t - 0.085) / 0.2; };
    const double expected =
        (z(0.5) * z(0.5) - z(x) * z(x)) / 2 + std::log(x * (1 - x) / 0.25);
    EXPECT_NEAR(out.prior[1] - out.prior[0], expected, 1e-12);
}

TEST(KohCoordinates, PriorsThatDoNotFitAreRefused) {
    const Standardised data = standardise(small_study({}, 1));
    ModelOptions options;
    options.priors.rho_eta = {stats::PriorKind::normal, 0.5, 0.1};
    EXPECT_THROW(KohDensity(data, options), std::invalid_argument);
    options = {};
    options.priors.t.resize(3);
    EXPECT_THROW(KohDensity(data, options), std::invalid_argument);
    options = {};
    options.discrepancy_mean = Mean::linear;
    EXPECT_THROW(KohDensity(standardise(small_study({5, 6, 2}, 1)), options),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::emulator::test
