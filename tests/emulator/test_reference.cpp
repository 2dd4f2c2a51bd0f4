/// Against Stan's log density and gradient for bc-stan's example (12 measurements, 120
/// runs), in both forms.
#include "emulator/reference_data.hpp"
#include "support/measured.hpp"

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

struct Worst {
    double value = 0, gradient = 0;
};

Worst worst_difference(Form form) {
    ModelOptions options;
    options.form = form;
    KohDensity density(reference_data(), options);
    const CsvTable table(shared_file("koh/ref_logp_grad.csv"));
    const Matrix all = columns(table, 0, 47);
    const Matrix points = columns(table, 15, 15);
    sampling::Evaluations out;
    density.evaluate(points, true, out);
    Worst worst;
    for (std::size_t i = 0; i < points.rows; ++i) {
        const double value = out.prior[i] + out.likelihood[i] - prior_constants();
        worst.value = std::max(worst.value, std::abs(value - all(i, 30)));
        for (std::size_t k = 0; k < 15; ++k) {
            const double expected = all(i, 32 + k);
            const double got = out.prior_gradient(i, k) + out.likelihood_gradient(i, k);
            worst.gradient = std::max(
                worst.gradient, std::abs(got - expected) / (1 + std::abs(expected)));
        }
    }
    EXPECT_EQ(points.rows, 20U);
    EXPECT_EQ(density.jitter().n_with[0], 20U) << "no jitter is needed at these points";
    return worst;
}

void expect_stan(Form form, const char* name) {
    if (is_reference_absent()) GTEST_SKIP() << "the reference data are not here";
    const Worst worst = worst_difference(form);
    bemcal::test::print_measured(std::string(name) + " log density, worst of 20",
                                 worst.value, "", "1e-6");
    bemcal::test::print_measured(std::string(name) + " gradient, worst of 300",
                                 worst.gradient, "", "1e-6");
    EXPECT_LT(worst.value, 1e-6);
    EXPECT_LT(worst.gradient, 1e-6);
}

TEST(KohReference, TheDenseFormHasStansDensityAndGradient) {
    expect_stan(Form::dense, "dense");
}

TEST(KohReference, TheKroneckerFormHasStansDensityAndGradient) {
    expect_stan(Form::kronecker_if_grid, "kronecker");
}

TEST(KohReference, TheDataAreAGridWithinTheTolerance) {
    if (is_reference_absent()) GTEST_SKIP() << "the reference data are not here";
    const Standardised data = reference_data();
    EXPECT_TRUE(find_grid(data.data));
    EXPECT_FALSE(find_grid(data.data, 1e-11)) << "measurements lie 3.6e-10 beside it";
}

}  // namespace
}  // namespace bemcal::emulator::test
