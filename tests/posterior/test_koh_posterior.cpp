#include "physics/office_hour.hpp"
#include "posterior/chain_results.hpp"
#include "posterior/koh_posterior.hpp"
#include "posterior/office_hour_runs.hpp"
#include "study/find.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

constexpr double true_t = 12.5;  // between 10 and 14

/// Rough enough for its covariance to be well conditioned.
double simulated(double x, double t) {
    return 100 + 10 * std::sin(8 * x) + 10 * std::sin(1.5 * (t - 10) + 4 * x);
}

stats::Prior uniform(double least, double most) {
    return {stats::PriorKind::uniform, 0, 1, least, most, false};
}

/// Measurements at 8 points x, made with the true t; 6 designs at each.
posterior::KohOptions small_problem() {
    posterior::KohOptions options;
    emulator::Observations& o = options.observations;
    constexpr std::size_t n = 8, designs = 6;
    o.x_names = {"x"};
    o.t_names = {"t"};
    o.measured_x = Matrix(n, 1);
    o.simulated_x = Matrix(n * designs, 1);
    o.simulated_t = Matrix(n * designs, 1);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = static_cast<double>(i) / (n - 1);
        o.measured_x(i, 0) = x;
        o.measured.push_back(simulated(x, true_t) +
                             0.2 * std::sin(7.0 * static_cast<double>(i)));
    }
    for (std::size_t row = 0; row < n * designs; ++row) {
        o.simulated_x(row, 0) = o.measured_x(row % n, 0);
        o.simulated_t(row, 0) = 10.2 + 0.7 * static_cast<double>(row / n);
        o.simulated.push_back(simulated(o.simulated_x(row, 0), o.simulated_t(row, 0)));
    }
    options.calibrated = {{"t", "K", uniform(10, 14)}};
    options.output_unit = "kWh";
    options.n_predictive = 200;
    options.chains.n_chains = 4;
    options.chains.chains_per_item = 1;
    options.chains.sampler.n_warm_up = 150;
    options.chains.sampler.target_acceptance = 0.9;
    options.chains.sampler.most_depth = 5;
    options.chains.draws_per_round = options.chains.most_draws = 300;
    options.chains.seed = 3;
    return options;
}

std::vector<Dataset> run_all(Stage& stage) {
    std::vector<ItemAnswer> answers;
    int n_items = stage.n_items();
    for (;;) {
        for (int item = static_cast<int>(answers.size()); item < n_items; ++item)
            answers.push_back(stage.run(item));
        const auto round = stage.next_round(answers);
        if (!round) break;
        stage.begin_round(n_items, *round);
        n_items += round->n_items;
    }
    for (const ItemAnswer& answer : answers)
        for (const Failure& failure : answer.failures)
            ADD_FAILURE() << "chain " << failure.point << ": " << failure.reason;
    return stage.conclude(answers).datasets;
}

TEST(KohPosterior, FindsTheInputThatTheMeasurementsWereMadeWith) {
    const auto datasets = run_all(*posterior::make_koh_stage("small", small_problem()));
    const auto find = [&](const char* leaf) -> const Dataset& {
        return test::find(datasets, leaf);
    };
    const double mean = find("posterior_mean").values[0],
                 sd = find("posterior_sd").values[0];
    EXPECT_NEAR(mean, true_t, 3 * sd);
    EXPECT_LT(sd, 0.6);  // of the prior: 1.15
    EXPECT_EQ(find("unknown").texts[0], "t");
    EXPECT_EQ(find("posterior/t").unit, "K");
    EXPECT_EQ(find("covariance_form").texts[0], "kronecker");
}

TEST(KohPosterior, PredictsItsFieldPoints) {
    const posterior::KohOptions options = small_problem();
    const auto datasets = run_all(*posterior::make_koh_stage("small", options));
    const auto value = [&](const char* leaf) {
        return test::find(datasets, leaf).values;
    };
    EXPECT_LT(value("field_cv_rmse")[0], 0.01);
    EXPECT_NEAR(value("field_cv_rmse_n1")[0] / value("field_cv_rmse")[0],
                std::sqrt(8.0 / 7.0), 1e-12);
    EXPECT_NEAR(value("field_nmbe_n1")[0] / value("field_nmbe")[0], 8.0 / 7.0, 1e-12);
    EXPECT_GE(value("measurement_coverage")[1], 7.0 / 8.0);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_LT(value("measurement_q05")[i], value("process_q05")[i]) << i;
        EXPECT_LT(value("process_q05")[i], value("process_mean")[i]) << i;
        EXPECT_LT(value("process_mean")[i], value("process_q95")[i]) << i;
        EXPECT_LT(value("process_q95")[i], value("measurement_q95")[i]) << i;
    }
    EXPECT_EQ(value("field_measured"), options.observations.measured);
}

TEST(KohPosterior, DenseAndKroneckerFormsAreTheSameDensity) {
    posterior::KohOptions options = small_problem();
    options.model.priors.regression = {stats::PriorKind::normal, 1, 0.25};
    options.model.emulator_mean = options.model.discrepancy_mean =
        emulator::Mean::constant;
    const auto kronecker = posterior::make_koh_posterior(options)->make_density();
    options.form = posterior::KohForm::dense;
    const auto dense = posterior::make_koh_posterior(options)->make_density();
    Stream random(1, 0, 0);
    Matrix points(20, dense->dimension());
    for (double& u : points.values) u = -4 + 2 * random.uniform();  // well conditioned
    sampling::Evaluations a, b;
    kronecker->evaluate(points, true, a);
    dense->evaluate(points, true, b);
    for (std::size_t r = 0; r < points.rows; ++r) {
        EXPECT_EQ(a.prior[r], b.prior[r]);
        EXPECT_NEAR(a.likelihood[r], b.likelihood[r],
                    1e-8 * (1 + std::abs(b.likelihood[r])));
    }
}

TEST(KohPosterior, PriorDrawsAreInPhysicalUnits) {
    posterior::KohOptions options = small_problem();
    options.calibrated[0].prior = {stats::PriorKind::normal, 0.5, 0.1, 10, 14, true};
    Stream random(2, 0, 0);
    const Matrix draws =
        posterior::draw_prior(*posterior::make_koh_posterior(options), 2000, random);
    double sum = 0, squares = 0;
    for (std::size_t r = 0; r < draws.rows; ++r) sum += draws(r, 0) / 2000;
    for (std::size_t r = 0; r < draws.rows; ++r)
        squares += (draws(r, 0) - sum) * (draws(r, 0) - sum) / 2000;
    EXPECT_NEAR(sum, 12, 0.05);  // five standard errors
    EXPECT_NEAR(std::sqrt(squares), 0.4, 0.04);
}

TEST(KohPosterior, PriorsOnTheUnitScaleAreTheSameDistribution) {
    for (const stats::Prior& prior :
         {uniform(10, 14), stats::Prior{stats::PriorKind::normal, 11, 2, 10, 14, false},
          stats::Prior{stats::PriorKind::normal, 0.3, 0.2, 10, 14, true},
          stats::Prior{stats::PriorKind::beta, 2, 3, 10, 14, true},
          stats::Prior{stats::PriorKind::gamma, 2, 3, 10, 14, true}})
        for (const double share : {0.1, 0.5, 0.8})
            EXPECT_NEAR(posterior::on_unit_scale(prior).cdf(share),
                        prior.cdf(10 + 4 * share), 1e-12)
                << stats::name_of(prior.kind);
    EXPECT_THROW(posterior::on_unit_scale({stats::PriorKind::gamma, 2, 3, 10, 14, false}),
                 std::invalid_argument);
}

TEST(KohPosterior, WantsAGridForTheKroneckerForm) {
    posterior::KohOptions options = small_problem();
    options.observations.simulated_t(3, 0) = 13.9;
    options.form = posterior::KohForm::kronecker;
    EXPECT_THROW(posterior::make_koh_posterior(options), std::invalid_argument);
    options.form = posterior::KohForm::automatic;
    EXPECT_NO_THROW(posterior::make_koh_posterior(options));
}

emulator::Observations two_hours() {
    emulator::Observations o;
    o.x_names = {"GFA", "HourNum"};
    o.t_names = {"L", "WWR"};
    o.measured = {100, 200};
    o.measured_x = Matrix(2, 2);
    o.measured_x.values = {10000, 9, 20000, 15};
    return o;
}

/// The other fifteen in the middle of their ranges.
posterior::OfficeHourDesign design_of_15_fixed() {
    posterior::OfficeHourDesign design{4, 5, {}};
    for (const auto& input : physics::office_hour_inputs()) {
        const std::string name = input.name;
        if (name != "GFA" && name != "HourNum" && name != "L" && name != "WWR")
            design.fixed.emplace_back(name, (input.least + input.most) / 2);
    }
    return design;
}

TEST(OfficeHourRuns, AreEveryDesignAtEveryFieldPoint) {
    emulator::Observations o = two_hours();
    posterior::add_office_hour_runs(design_of_15_fixed(), o);
    ASSERT_EQ(o.simulated.size(), 8U);
    std::vector<double> inputs;
    for (const auto& input : physics::office_hour_inputs())
        inputs.push_back((input.least + input.most) / 2);
    for (std::size_t row = 0; row < 8; ++row) {
        EXPECT_EQ(o.simulated_x(row, 0), o.measured_x(row % 2, 0));
        EXPECT_EQ(o.simulated_t(row, 1), o.simulated_t(row / 2 * 2, 1));
        inputs[0] = o.simulated_x(row, 0);
        inputs[17] = o.simulated_x(row, 1);
        inputs[1] = o.simulated_t(row, 0);
        inputs[4] = o.simulated_t(row, 1);
        EXPECT_EQ(o.simulated[row], physics::office_hour_energy(inputs)) << row;
        EXPECT_TRUE(inputs[1] >= 15 && inputs[1] <= 80) << inputs[1];
    }
}

TEST(OfficeHourRuns, NeedEveryInputOnce) {
    emulator::Observations o = two_hours();
    posterior::OfficeHourDesign design = design_of_15_fixed();
    design.fixed.pop_back();
    EXPECT_THROW(posterior::add_office_hour_runs(design, o), std::invalid_argument);
    design = design_of_15_fixed();
    design.fixed.emplace_back("GFA", 10000);
    EXPECT_THROW(posterior::add_office_hour_runs(design, o), std::invalid_argument);
    EXPECT_THROW(posterior::office_hour_coordinates({"colour"}), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::study
