/// Studies of kind "optimisation": what the keys become, and what is refused.
#include "job/kind.hpp"
#include "job/optimisation_kind.hpp"
#include "job/small_results.hpp"
#include "plan/plan.hpp"
#include "study/analytic_simulator.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* screening_study =
    "kind = \"screening\"\nn_points = 256\npoints_per_item = 64";

std::filesystem::path write_job(const Folder& folder, const std::string& keys) {
    return write_small_office(folder, replaced(small_office_text(), screening_study,
                                               "kind = \"optimisation\"\n" + keys));
}

/// Paths of what the stages of a study store.
std::vector<std::string> paths_of(const Job& job, const std::string& study) {
    std::vector<std::string> paths;
    for (const auto& stage : make_plan(job))
        if (stage->name().ends_with("/" + study))
            for (const study::Dataset& dataset :
                 stage->conclude(test::answers_of(*stage)).datasets)
                paths.push_back(dataset.path);
    return paths;
}

TEST(OutputHourly, IsStoredOfNominalAndBestByScreeningAndOptimisation) {
    const Folder folder;
    const std::string small =
        replaced(small_office_text(), "n_points = 256", "n_points = 8");
    const auto screening =
        paths_of(read_job(write_small_office(folder, small)), "screening");
    const auto optimisation =
        paths_of(read_job(write_job(folder, "evaluations = 20")), "optimisation");
    for (const auto& [study, paths] :
         {std::pair{"screening", screening}, {"optimisation", optimisation}})
        EXPECT_EQ(std::ranges::count(paths, std::string("small_office/") + study +
                                                "/training/hourly/electricity"),
                  1)
            << study;
}

TEST(OptimisationStudy, TakesEveryKey) {
    const Folder folder;
    const Job job = read_job(write_job(
        folder,
        "period = \"training\"\nparameters = [\"infiltration\"]\nmeters = [\"air\"]\n"
        "objective = \"fraction\"\ncv_weight = 0.6\nr2_weight = 0.4\n"
        "meter_weights = [2]\nresolution = \"monthly\"\nevaluations = 300\n"
        "n_particles = 12\nrestart = false"));
    ASSERT_STREQ(job.studies[1].kind->word, "optimisation");
    const calibration::OptimisationOptions& options =
        job.studies[1].as<OptimisationStudy>().options;
    EXPECT_EQ(options.method, calibration::OptimisationMethod::swarm_then_pattern);
    EXPECT_EQ(options.objective, calibration::Objective::fraction);
    EXPECT_EQ(options.resolution, calibration::ObjectiveResolution::monthly);
    EXPECT_EQ(options.parameters, Texts{"infiltration"});
    EXPECT_EQ(options.meters, Texts{"air"});
    EXPECT_EQ(options.cv_weight, 0.6);
    EXPECT_EQ(options.r2_weight, 0.4);
    EXPECT_EQ(options.meter_weights, std::vector<double>{2});
    EXPECT_EQ(options.evaluations, 300U);
    EXPECT_EQ(options.n_particles, 12);
    EXPECT_FALSE(options.restart);
    EXPECT_EQ(options.seed, job.seed);
    EXPECT_NE(plan::plan_text(job, 1).find("300"), std::string::npos);
}

TEST(OptimisationStudy, TakesNsga2AndItsKeys) {
    const Folder folder;
    const Job job = read_job(write_job(folder,
                                       "method = \"nsga2\"\nerrors = \"signed\"\n"
                                       "n_population = 20\nn_generations = 7"));
    const calibration::OptimisationOptions& options =
        job.studies[1].as<OptimisationStudy>().options;
    EXPECT_EQ(options.method, calibration::OptimisationMethod::nsga2);
    EXPECT_EQ(options.errors, calibration::MeterError::signed_);
    EXPECT_EQ(options.n_population, 20);
    EXPECT_EQ(options.n_generations, 7);
}

TEST(OptimisationStudy, TakesTargetsInPlaceOfMeters) {
    const Folder folder;
    const Job job = read_job(write_job(folder,
                                       "evaluations = 300\n[[study.target]]\n"
                                       "quantity = \"electricity\"\nmeasured = 5\n"
                                       "unit = \"MWh\""));
    const TargetSpecs& targets = job.studies[1].as<OptimisationStudy>().targets;
    ASSERT_EQ(targets.size(), 1U);
    EXPECT_NEAR(targets[0].measured.at(0), 5000, 1e-9);
    EXPECT_NE(plan::plan_text(job, 1).find("300"), std::string::npos);
}

struct Bad {
    const char *keys, *message;
};

TEST(OptimisationStudy, GoesOnAnEmulatorAfterItHasBeenRead) {
    const Folder folder;
    Job job = read_job(write_job(
        folder, "evaluations = 40\n[[study.target]]\nquantity = \"gas\"\nmeasured = 1"));
    job.simulator = std::make_shared<test::AnalyticSimulator>();
    StudySpec& study = job.studies.back();
    ASSERT_STREQ(study.kind->word, "optimisation");
    auto made = study.as<OptimisationStudy>();
    made.n_runs = 14;
    made.targets = {TargetSpec{}};
    made.targets[0].simulator_output = job.simulator->outputs()[0].name;
    made.targets[0].measured = {3};
    study.options = made;
    const auto stages = study.kind->stages(study, job);
    EXPECT_GT(test::answers_of(*stages.at(0)).size(), 14U);
}

TEST(OptimisationStudy, RefusesWhatCannotBeFitted) {
    for (const Bad& bad : std::initializer_list<Bad>{
             {"meters = [\"water\"]", "study.meters: \"water\" is no meter of"},
             {"parameters = [\"height\"]",
              "study.parameters: \"height\" is no parameter"},
             {"meters = [\"air\"]\nmeter_weights = [1, 2]",
              "study.meter_weights: has 2 numbers, but meters has 1 names; expected one "
              "for each"},
             {"method = \"nsga2\"\nn_population = 21",
              "study.n_population = 21: expected an even number"},
             {"method = \"nsga2\"\nevaluations = 100", "study.evaluations"},
             {"meters = [\"air\"]\n[[study.target]]\nquantity = \"gas\"\nmeasured = 1",
              "study.meters"},
             {"[[study.target]]\nquantity = \"gas\"\nmeasured = 0",
              "study.target.measured = 0: errors are in per cent of it; expected a "
              "number other than 0"},
             {"[[study.target]]\nquantity = \"district\"",
              "study.target: the target district is missing"},
             {"method = \"swarms\"",
              "study.method = \"swarms\": expected one of swarm_then_pattern, swarm, "
              "pattern, nsga2; did you mean \"swarm\"?"}}) {
        const Folder folder;
        EXPECT_NE(message_of(write_job(folder, bad.keys)).find(bad.message),
                  std::string::npos)
            << message_of(write_job(folder, bad.keys));
    }
}

}  // namespace
}  // namespace bemcal::job
