#include "job/small_office.hpp"
#include "posterior/posterior.hpp"
#include "posterior/posterior_cases.hpp"
#include "study/find.hpp"
#include "study/points.hpp"
#include "study/sampled_shapes.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::fortnight;
using test::quick_options;

/// Readings of the building at `point`, with noise that is not the model's.
Case with_readings(Case made, const std::vector<double>& point) {
    for (Meter& meter : made.meters) std::ranges::fill(meter.values, 0.0);
    const posterior::BuildingModel model(made, made.periods[0], {});
    Matrix row(1, point.size());
    row.values = point;
    const auto predictions = model.predict(row);
    for (std::size_t m = 0; m < predictions.size(); ++m)
        for (std::size_t k = 0; k < predictions[m].cols; ++k)
            made.meters[m].values[k] =
                predictions[m](0, k) *
                    (1 + 0.03 * std::sin(1.7 * static_cast<double>(k))) +
                0.05 * std::cos(2.9 * static_cast<double>(k));
    return made;
}

struct Ran {
    std::vector<ItemAnswer> answers;
    std::vector<Dataset> datasets;
    std::vector<Summary> found;
    std::string shortfall;
};

/// All rounds of a stage, as run/ does them.
Ran run_all(Stage& stage) {
    Ran ran;
    int n_items = stage.n_items();
    for (;;) {
        for (int item = static_cast<int>(ran.answers.size()); item < n_items; ++item)
            ran.answers.push_back(stage.run(item));
        const auto round = stage.next_round(ran.answers);
        if (!round) break;
        stage.begin_round(n_items, *round);
        n_items += round->n_items;
    }
    Conclusion conclusion = stage.conclude(ran.answers);
    ran.datasets = std::move(conclusion.datasets);
    ran.found = std::move(conclusion.summaries);
    ran.shortfall = stage.shortfall(ran.answers);
    return ran;
}

/// A fortnight of another office, with heat that follows the weather as these values say.
Case office_that_follows(const std::vector<double>& values, double spread) {
    Case made = job::small_office_with(job::effect_that_follows("gains", values, spread));
    made.periods = {{"training", physics::parse_time("2021-01-04"),
                     physics::parse_time("2021-01-18")}};
    made.meters = {test::empty_meter(made, physics::Quantity::heating),
                   test::empty_meter(made, physics::Quantity::air_temperature)};
    return made;
}

TEST(PosteriorDensity, AWeightIsAPowerOfTheLikelihoodAlone) {
    const Case made = with_readings(fortnight(), {0.7, 0.45, 20.6});
    const auto density_of = [&](double weight) {
        const posterior::PosteriorOptions options;
        return posterior::make_posterior_density(test::parts_of(
            std::make_unique<posterior::BuildingModel>(
                made, made.periods[0],
                posterior::training_choice(made, made.periods[0], options)),
            weight));
    };
    const auto whole = density_of(1), part = density_of(0.25);
    Stream random(2, 1, 1);
    Matrix point(1, whole->dimension());
    std::ranges::copy(whole->draw_start(random), point.row(0).begin());
    sampling::Evaluations of_whole, of_part;
    whole->evaluate(point, true, of_whole);
    part->evaluate(point, true, of_part);
    EXPECT_EQ(of_part.prior, of_whole.prior);
    EXPECT_EQ(of_part.likelihood[0], 0.25 * of_whole.likelihood[0]);
    for (std::size_t k = 0; k < point.cols; ++k)
        EXPECT_EQ(of_part.likelihood_gradient(0, k),
                  0.25 * of_whole.likelihood_gradient(0, k));
}

TEST(PosteriorDensity, GradientIsTheDerivative) {
    const Case made = with_readings(fortnight(), {0.7, 0.45, 20.6});
    posterior::PosteriorOptions options;
    options.residuals.discrepancy = true;
    const auto density = posterior::make_posterior_density(
        test::parts_of(std::make_unique<posterior::BuildingModel>(
            made, made.periods[0],
            posterior::training_choice(made, made.periods[0], options))));
    Stream random(2, 1, 1);
    const std::size_t d = density->dimension();
    const std::vector<double> start = density->draw_start(random);
    Matrix points(1 + 2 * d, d);
    for (std::size_t r = 0; r < points.rows; ++r)
        std::ranges::copy(start, points.row(r).begin());
    const double h = 1e-6;
    for (std::size_t k = 0; k < d; ++k) {
        points(1 + k, k) += h;
        points(1 + d + k, k) -= h;
    }
    sampling::Evaluations found;
    density->evaluate(points, true, found);
    for (std::size_t k = 0; k < d; ++k) {
        const double slope =
            (found.likelihood[1 + k] - found.likelihood[1 + d + k]) / (2 * h);
        EXPECT_NEAR(found.likelihood_gradient(0, k), slope, 2e-4 * (1 + std::abs(slope)))
            << k;
    }
}

/// With 3 % of error from a known point: each of the three lies inside the posterior's
/// mean +- 5 sd (a wrong model of the noise, so no rate is claimed).
TEST(Posterior, FindsTheParametersThatMadeTheData) {
    const std::vector<double> truth{0.7, 0.45, 20.6};
    const auto stage = posterior::make_posterior("p", {with_readings(fortnight(), truth)},
                                                 quick_options());
    const Ran ran = run_all(*stage);
    EXPECT_EQ(ran.shortfall, "");
    const auto& mean = test::find(ran.datasets, "posterior_mean").values;
    const auto& sd = test::find(ran.datasets, "posterior_sd").values;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(mean[k], truth[k], 5 * sd[k]) << k;
        EXPECT_LT(sd[k], 0.1) << k;
    }
    EXPECT_EQ(test::find(ran.datasets, "convergence").texts[0], "converged");
}

TEST(Posterior, HandsOnItsDrawsMeansQuantilesAndErrors) {
    posterior::PosteriorOptions options = quick_options();
    options.chains.sampler.n_warm_up = options.chains.most_draws =
        options.chains.draws_per_round = 20;
    const auto stage = posterior::make_posterior(
        "p", {with_readings(fortnight(), {0.7, 0.45, 20.6})}, options);
    const Ran ran = run_all(*stage);
    ASSERT_EQ(ran.found.size(), 1U);
    const Summary& found = ran.found[0];
    ASSERT_EQ(found.points.parameters.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& draws =
            test::find(ran.datasets, "posterior/" + found.points.parameters[k]).values;
        ASSERT_EQ(found.points.rows.rows, draws.size());
        for (std::size_t r = 0; r < draws.size(); ++r)
            EXPECT_EQ(found.points.rows(r, k), draws[r]);
        EXPECT_EQ(found.values[k].name, found.points.parameters[k]);
        EXPECT_EQ(found.values[k].value,
                  test::find(ran.datasets, "posterior_mean").values[k]);
        EXPECT_EQ(found.values[k].low,
                  test::find(ran.datasets, "posterior_q05").values[k]);
        EXPECT_EQ(found.values[k].high,
                  test::find(ran.datasets, "posterior_q95").values[k]);
    }
    const auto& fit = test::find(ran.datasets, "training/heating/all/validation_fit");
    const auto& metrics = test::find(ran.datasets, "metric").texts;
    const auto cv = std::ranges::find(metrics, "cv_rmse") - metrics.begin();
    const auto after = static_cast<std::ptrdiff_t>(fit.shape[1] * fit.shape[2]) + cv;
    const study::FoundFit& of_heating = found.fits.at(0);
    EXPECT_EQ(of_heating.before, fit.values[static_cast<std::size_t>(cv)]);
    EXPECT_EQ(of_heating.cv_rmse, fit.values[static_cast<std::size_t>(after)]);
    ASSERT_EQ(found.findings.size(), 1U);  // so few draws do not suffice
    EXPECT_EQ(found.findings[0].finding, ran.shortfall);
}

/// Mean width of a meter's 90 % interval over a period.
double mean_width(const std::vector<Dataset>& datasets, const std::string& meter) {
    const Dataset& low = test::find(datasets, meter + "/predicted_q05");
    const Dataset& high = test::find(datasets, meter + "/predicted_q95");
    double sum = 0;
    for (std::size_t k = 0; k < low.values.size(); ++k)
        sum += high.values[k] - low.values[k];
    return sum / static_cast<double>(low.values.size());
}

// The residuals of the second meter stand after those of the first, of which there are
// fewer without memory.
TEST(Posterior, OtherPeriodsHaveTheResidualsOfTheTrainingWithoutMemoryToo) {
    Case made = with_readings(fortnight(), {0.7, 0.45, 20.6});
    made.periods.push_back({"again", made.periods[0].from, made.periods[0].to});
    posterior::PosteriorOptions options = quick_options();
    options.residuals.autocorrelated = options.residuals.proportional = false;
    options.chains.draws_per_round = options.chains.most_draws = 50;
    options.chains.sampler.n_warm_up = 50;
    const auto stage = posterior::make_posterior("posterior", {made}, options);
    const auto datasets = run_all(*stage).datasets;
    for (const Meter& meter : made.meters) {
        const double trained = mean_width(datasets, "training/" + meter.name);
        EXPECT_NEAR(mean_width(datasets, "again/" + meter.name), trained, 0.1 * trained);
    }
}

TEST(Posterior, DrawsDoNotDependOnHowChainsAreGrouped) {
    const Case made = with_readings(fortnight(), {0.7, 0.45, 20.6});
    posterior::PosteriorOptions options = quick_options();
    options.chains.sampler.n_warm_up = 60;
    options.chains.most_draws = 20;
    options.chains.draws_per_round = 20;
    const auto together = posterior::make_posterior("p", {made}, options);
    options.chains.chains_per_item = 1;
    const auto alone = posterior::make_posterior("p", {made}, options);
    EXPECT_EQ(test::find(run_all(*together).datasets, "posterior/heating_phi").values,
              test::find(run_all(*alone).datasets, "posterior/heating_phi").values);
}

TEST(Posterior, ABudgetThatDoesNotSufficeIsNamed) {
    posterior::PosteriorOptions options = quick_options();
    options.chains.sampler.n_warm_up = 20;
    options.chains.draws_per_round = 10;
    options.chains.most_draws = 20;
    options.chains.target_ess = 1000;
    const auto stage = posterior::make_posterior(
        "p", {with_readings(fortnight(), {0.7, 0.45, 20.6})}, options);
    const std::string shortfall = run_all(*stage).shortfall;
    EXPECT_NE(shortfall.find("not converged: after 20 draws"), std::string::npos)
        << shortfall;
}

/// The readings of the first meter times `factor`, which no parameter can follow far.
std::string bias_with_heating_times(double factor) {
    Case made = with_readings(fortnight(), {0.7, 0.45, 20.6});
    for (double& reading : made.meters[0].values) reading *= factor;
    posterior::PosteriorOptions options = quick_options();
    options.chains.sampler.n_warm_up = 60;
    options.chains.draws_per_round = options.chains.most_draws = 20;
    return run_all(*posterior::make_posterior("p", {made}, options))
        .found.at(0)
        .shortfall;
}

TEST(Posterior, ABiasThatItsDrawsDoNotTellOfIsAShortfall) {
    EXPECT_EQ(bias_with_heating_times(1), "");
    const std::string shortfall = bias_with_heating_times(4);
    EXPECT_NE(shortfall.find("the bias of heating in training is -"), std::string::npos)
        << shortfall;
    EXPECT_NE(shortfall.find("beyond the 10 % of Guideline 14"), std::string::npos)
        << shortfall;
}

TEST(Posterior, BuildingsOfAHierarchyAreEachCalibratedAndAnUnseenOneIsPredicted) {
    std::vector<Case> buildings;
    for (const double air_change : {0.6, 0.8, 1.0}) {
        buildings.push_back(with_readings(fortnight(), {air_change, 0.45, 20.6}));
        buildings.back().name = "b" + std::to_string(buildings.size());
    }
    posterior::PosteriorOptions options = quick_options();
    options.pooling = posterior::Pooling::partial;
    options.unseen = {"b3"};
    options.chains.sampler.n_warm_up = 20;
    options.chains.sampler.most_depth = 4;
    options.chains.most_draws = 20;
    options.chains.draws_per_round = 20;
    const auto stage = posterior::make_posterior("p", buildings, options);
    const Ran ran = run_all(*stage);
    const auto& names = test::find(ran.datasets, "unknown").texts;
    EXPECT_EQ(
        std::ranges::count(names, std::string("zone.office.flow.air.air_change_b1")), 1);
    EXPECT_FALSE(
        std::ranges::count(names, std::string("zone.office.flow.air.air_change_b3")));
    EXPECT_TRUE(test::has(ran.datasets, "b3/training/heating/predicted_q95"));
    const std::string air = "zone.office.flow.air.air_change";
    const auto draws_of = [&](const std::string& building) {
        const FoundPoints& points = find_summary(ran.found, "p", building)->points;
        EXPECT_EQ(points.parameters[0], air);
        std::vector<double> draws;
        for (std::size_t r = 0; r < points.rows.rows; ++r)
            draws.push_back(points.rows(r, 0));
        return draws;
    };
    EXPECT_EQ(draws_of("b2"),
              test::find(ran.datasets, "posterior/" + air + "_b2").values);
    EXPECT_EQ(draws_of("b3"), test::find(ran.datasets, "posterior/" + air).values);
}

TEST(Posterior, BuildingsThatShareMustHaveTheSameParameters) {
    std::vector<Case> buildings(2, with_readings(fortnight(), {0.7, 0.45, 20.6}));
    buildings[1].parameters.pop_back();
    posterior::PosteriorOptions options = quick_options();
    options.pooling = posterior::Pooling::full;
    EXPECT_THROW(posterior::make_posterior("p", buildings, options),
                 std::invalid_argument);
}

TEST(Posterior, WithoutReadingsThereIsNothingToLearnFrom) {
    EXPECT_THROW(posterior::make_posterior("p", {fortnight()}, quick_options()),
                 std::invalid_argument);
}

/// Nothing is known of the function but that it is about 1 W/m2.
TEST(Posterior, SamplesTheValuesOfAFunctionBesideParameters) {
    Case made = office_that_follows({0, 0, 0, 0}, 1);
    std::vector<SampledFunction> functions;
    with_sampled_shapes(made, made.periods.at(0), functions);
    std::vector<double> truth;
    for (std::size_t p = 0; p < 4; ++p)
        truth.push_back(4 * functions.at(0).columns(p, 0));
    const Case with_it = office_that_follows(truth, 0);
    made.meters = with_readings(with_it, nominal_point(with_it.parameters)).meters;
    posterior::PosteriorOptions options = quick_options();
    options.chains.most_draws = 100;
    const Ran ran = run_all(*posterior::make_posterior("p", {made}, options));
    const auto& names = ran.found.at(0).points.parameters;
    EXPECT_NE(std::ranges::find(names, functions[0].size_name()), names.end());
    const auto& value = test::find(ran.datasets, "function_point_value").values;
    const auto& least = test::find(ran.datasets, "function_point_least").values;
    const auto& most = test::find(ran.datasets, "function_point_most").values;
    for (std::size_t p = 0; p < 4; ++p) {
        EXPECT_NEAR(value[p], truth[p], 0.5 * std::abs(truth[p]) + 0.5) << p;
        EXPECT_LT(least[p], most[p]);
    }
}

}  // namespace
}  // namespace bemcal::study
