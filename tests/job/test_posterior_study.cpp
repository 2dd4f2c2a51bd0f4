/// Priors of parameters and studies of kind "posterior": what the keys become.
#include "job/kind.hpp"
#include "job/small_office.hpp"
#include "job/stages.hpp"
#include "plan/plan.hpp"
#include "posterior/posterior_options.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char* screening_study =
    "kind = \"screening\"\nn_points = 256\npoints_per_item = 64";
constexpr const char* infiltration_range = "min = 0.28\nmax = 0.52";

/// The sample job with other lines for the infiltration's range and the last study.
Job job_with(const std::string& range, const std::string& study = screening_study) {
    const Folder folder;
    std::string text = replaced(small_office_text(), screening_study, study);
    text = replaced(text, infiltration_range, range);
    return read_job(write_small_office(folder, text));
}

stats::Prior prior_of(const std::string& prior) {
    return job_with(std::string(infiltration_range) + "\nprior = " + prior)
        .buildings[0]
        .priors[0]
        .prior;
}

TEST(Priors, AreUniformInTheRangeWhereNothingIsSaid) {
    const study::Case building = job_with(infiltration_range).buildings[0];
    ASSERT_EQ(building.priors.size(), building.parameters.size());
    for (std::size_t p = 0; p < building.priors.size(); ++p) {
        const stats::Prior& prior = building.priors[p].prior;
        EXPECT_EQ(prior.kind, stats::PriorKind::uniform);
        EXPECT_EQ(prior.least, building.parameters[p].least);
        EXPECT_EQ(prior.most, building.parameters[p].most);
        EXPECT_TRUE(building.priors[p].values.empty());
    }
}

TEST(Priors, OfEachKindTakeTheirNumbers) {
    using stats::PriorKind;
    struct Example {
        const char* text;
        PriorKind kind;
        double a, b;
    };
    const Example examples[] = {
        {"{kind = \"fixed\", value = 0.45}", PriorKind::fixed, 0.45, 1},
        {"{kind = \"uniform\"}", PriorKind::uniform, 0, 1},
        {"{kind = \"normal\", mean = 0.4, sd = 0.05}", PriorKind::normal, 0.4, 0.05},
        {"{kind = \"lognormal\", median = 0.4, sd_log = 0.2}", PriorKind::lognormal,
         std::log(0.4), 0.2},
        {"{kind = \"beta\", alpha = 2, beta = 3}", PriorKind::beta, 2, 3},
        {"{kind = \"gamma\", shape = 40, rate = 100}", PriorKind::gamma, 40, 100}};
    for (const Example& example : examples) {
        const stats::Prior prior = prior_of(example.text);
        EXPECT_EQ(prior.kind, example.kind) << example.text;
        EXPECT_EQ(prior.a, example.a) << example.text;
        EXPECT_EQ(prior.b, example.b) << example.text;
        EXPECT_EQ(prior.least, 0.28) << example.text;
        EXPECT_EQ(prior.most, 0.52) << example.text;
        EXPECT_FALSE(prior.is_normalised) << example.text;
    }
    EXPECT_TRUE(prior_of("{kind = \"normal\", mean = 0.5, sd = 0.2, normalised = true}")
                    .is_normalised);
}

TEST(Priors, OfADiscreteParameterAreItsValuesAndItsRangeIsFromTheFirstToTheLast) {
    const study::Case building = job_with("values = [0.3, 0.4, 0.5]").buildings[0];
    EXPECT_EQ(building.priors[0].values, (std::vector<double>{0.3, 0.4, 0.5}));
    EXPECT_EQ(building.parameters[0].least, 0.3);
    EXPECT_EQ(building.parameters[0].most, 0.5);
}

TEST(PosteriorStudy, HasTheDefaultsOfTheSchema) {
    const Job job = job_with(infiltration_range, "kind = \"posterior\"");
    ASSERT_EQ(job.studies.size(), 2U);
    EXPECT_STREQ(job.studies[1].kind->word, "posterior");
    const auto& options = job.studies[1].as<posterior::PosteriorOptions>();
    EXPECT_EQ(options.chains.seed, 7U);
    EXPECT_EQ(options.chains.n_chains, 16);
    EXPECT_EQ(options.chains.draws_per_round, 100);
    EXPECT_EQ(options.chains.most_draws, 4000);
    EXPECT_EQ(options.chains.target_rhat, 1.01);
    EXPECT_EQ(options.chains.target_ess, 400);
    EXPECT_EQ(options.chains.sampler.method, sampling::Method::nuts);
    EXPECT_EQ(options.chains.sampler.n_warm_up, 500);
    EXPECT_EQ(options.chains.sampler.inverse_temperatures, std::vector<double>{1});
    EXPECT_TRUE(options.residuals.autocorrelated);
    EXPECT_FALSE(options.residuals.discrepancy);
    EXPECT_EQ(options.n_predictive, 200);
    EXPECT_EQ(options.pooling, posterior::Pooling::none);
}

TEST(PosteriorStudy, TakesEveryKey) {
    const Job job = job_with(
        infiltration_range,
        "kind = \"posterior\"\nperiod = \"training\"\nn_chains = 4\nwarm_up = 50\n"
        "draws_per_round = 25\ntarget_rhat = 1.05\ntarget_ess = 100\nmost_draws = 200\n"
        "thin = 2\nsampler = \"random_walk\"\ntemperatures = [1, 2, 8]\n"
        "autocorrelated = false\ndiscrepancy = true\nhold_out_weeks = 0.25\n"
        "hold_out_hours = 0.1\nn_predictive = 30\nmeters = [\"air\"]\n"
        "pooling = \"partial\"\nreading_weight = 0.125\nlevel_change = 0.1\n"
        "lasting_weeks = 4\n"
        "proportional = false");
    const auto& options = job.studies[1].as<posterior::PosteriorOptions>();
    EXPECT_EQ(options.period, "training");
    EXPECT_EQ(options.chains.n_chains, 4);
    EXPECT_EQ(options.chains.sampler.n_warm_up, 50);
    EXPECT_EQ(options.chains.draws_per_round, 25);
    EXPECT_EQ(options.chains.target_rhat, 1.05);
    EXPECT_EQ(options.chains.target_ess, 100);
    EXPECT_EQ(options.chains.most_draws, 200);
    EXPECT_EQ(options.chains.sampler.thin, 2);
    EXPECT_EQ(options.chains.sampler.method, sampling::Method::random_walk);
    EXPECT_EQ(options.chains.sampler.inverse_temperatures,
              (std::vector<double>{1, 0.5, 0.125}));
    EXPECT_FALSE(options.residuals.autocorrelated);
    EXPECT_TRUE(options.residuals.discrepancy);
    EXPECT_EQ(options.hold_out_weeks, 0.25);
    EXPECT_EQ(options.hold_out_hours, 0.1);
    EXPECT_EQ(options.n_predictive, 30);
    EXPECT_EQ(options.reading_weight, 0.125);
    EXPECT_EQ(options.level_change, 0.1);
    EXPECT_EQ(options.lasting_weeks, 4);
    EXPECT_FALSE(options.residuals.proportional);
    EXPECT_EQ(options.meters, std::vector<std::string>{"air"});
    EXPECT_EQ(options.pooling, posterior::Pooling::partial);
}

TEST(PosteriorStudy, IsAStageForEachBuildingOrOneForAll) {
    for (const bool is_pooled : {false, true}) {
        const Job job =
            job_with(infiltration_range,
                     std::string("kind = \"posterior\"\nn_chains = 8\n") +
                         (is_pooled ? "pooling = \"full\"\n" : "") + "warm_up = 100\n");
        const auto plan = make_plan(job);
        ASSERT_EQ(plan.size(), 2U);
        EXPECT_EQ(plan[1]->name(), is_pooled ? "posterior" : "small_office/posterior");
        const std::string text = plan::plan_text(job, 2);
        EXPECT_NE(text.find("it ends when it has converged"), std::string::npos) << text;
    }
}

/// What the sample job says of its building.
std::string building_text(const std::string& name) {
    const std::string text = small_office_text();
    const auto run = text.find("[run]"), schedule = text.find("[[schedule]]"),
               study = text.find("[[study]]"), site = text.find("[site]");
    return "name = \"" + name + "\"\n" + text.substr(site, run - site) +
           text.substr(schedule, study - schedule);
}

/// A posterior that learns from one building and predicts another.
std::string message_of_pair(const std::string& unseen) {
    const Folder folder;
    write_small_office(folder);
    folder.write("one.toml", building_text("one"));
    folder.write("other.toml", unseen);
    return message_of(
        folder.write("pair.toml",
                     "seed = 1\nbuildings = [\"one.toml\", \"other.toml\"]\n"
                     "[[study]]\nkind = \"posterior\"\n"
                     "pooling = \"full\"\nunseen = [\"other\"]\n"));
}

TEST(PosteriorStudy, PredictsAnUnseenBuildingByTheMetersOfASeenOne) {
    EXPECT_EQ(message_of_pair(building_text("other")), "");
    const std::string message = message_of_pair(
        replaced(building_text("other"), "name = \"electricity\"", "name = \"power\""));
    EXPECT_NE(message.find("study.unseen: other has no hourly meter \"electricity\" of "
                           "electricity, and one, which is learned from, has"),
              std::string::npos)
        << message;
}

}  // namespace
}  // namespace bemcal::job
