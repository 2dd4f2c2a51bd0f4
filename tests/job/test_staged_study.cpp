/// Studies of kind "stages": what the keys become, and what is refused.
#include "calibration/staged.hpp"
#include "job/kind.hpp"
#include "job/small_office.hpp"
#include "plan/plan.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* screening_study =
    "kind = \"screening\"\nn_points = 256\npoints_per_item = 64";

constexpr const char* envelope =
    "[[study.stage]]\nname = \"envelope\"\nperiods = [\"training\"]\n"
    "parameters = [\"infiltration\"]\nranges = {infiltration = [0.3, 0.5]}\n"
    "seed = 9\nevaluations = 50\n";

std::filesystem::path write_job(const Folder& folder, const std::string& keys) {
    return write_small_office(folder, replaced(small_office_text(), screening_study,
                                               "kind = \"stages\"\n" + keys));
}

TEST(StagedStudy, TakesEveryKey) {
    const Folder folder;
    const Job job = read_job(write_job(
        folder,
        "meters = [\"air\"]\nmeter_weights = [2]\nobjective = \"rmsd\"\naccuracy = 0.2\n"
        "evaluations = 300\nn_particles = 12\nrestart = false\nbeside = [\"sensitivity\"]\n"
        "at_once_evaluations = 77\n" +
            std::string(envelope) +
            "[[study.stage]]\nname = \"again\"\nperiods = [\"training\"]\n"
            "parameters = [\"infiltration\"]\naround = 0.1\nobjective = \"percent\"\n"
            "set = {walls = 1.1}\n"
            "[[study.validation]]\nperiod = \"held_out\"\nstage = \"envelope\"\n"));
    ASSERT_STREQ(job.studies.at(1).kind->word, "stages");
    const auto& options = job.studies[1].as<calibration::StagedOptions>();
    ASSERT_EQ(options.stages.size(), 2U);
    const calibration::CalibrationStage &first = options.stages[0],
                                        &second = options.stages[1];
    EXPECT_EQ(first.from, calibration::initial_values);
    EXPECT_EQ(first.periods, Texts{"training"});
    EXPECT_EQ(first.parameters, Texts{"infiltration"});
    ASSERT_EQ(first.ranges.size(), 1U);
    EXPECT_EQ(first.ranges[0].most, 0.5);
    EXPECT_EQ(first.fit.evaluations, 50U);
    EXPECT_EQ(first.fit.seed, 9U);
    EXPECT_EQ(first.fit.meters, Texts{"air"});
    EXPECT_EQ(first.fit.meter_weights, std::vector<double>{2});
    EXPECT_EQ(first.fit.objective, calibration::Objective::rmsd);
    EXPECT_FALSE(first.fit.restart);
    EXPECT_EQ(second.from, "envelope");
    EXPECT_EQ(second.around, 0.1);
    ASSERT_EQ(second.set.size(), 1U);
    EXPECT_EQ(second.set[0].parameter, "walls");
    EXPECT_EQ(second.set[0].value, 1.1);
    EXPECT_EQ(second.fit.evaluations, 300U);
    EXPECT_EQ(second.fit.seed, job.seed);
    EXPECT_EQ(second.fit.objective, calibration::Objective::percent);
    ASSERT_EQ(options.validation.size(), 1U);
    EXPECT_EQ(options.validation[0].stage, "envelope");
    EXPECT_EQ(options.beside, Texts{"sensitivity"});
    EXPECT_EQ(options.at_once_evaluations, 77U);
    EXPECT_EQ(options.accuracy, 0.2);
    EXPECT_NE(plan::plan_text(job, 1).find("427"), std::string::npos);
}

struct Bad {
    std::string keys, message;
};

TEST(StagedStudy, RefusesWhatCannotBe) {
    const std::string validation = "[[study.validation]]\nperiod = ";
    for (const Bad& bad : std::initializer_list<Bad>{
             {"", "study.stage: is missing; expected sections [[study.stage]]"},
             {envelope + validation + "\"training\"",
              "study.kind: the validation period training overlaps training, on which "
              "the stage envelope calibrates"},
             {envelope + validation + "\"summer\"",
              "study.validation.period: \"summer\" is no period of small_office"},
             {replaced(envelope, "\"infiltration\"", "\"height\""),
              "parameters: \"height\" is no parameter of small_office"},
             {replaced(envelope, "\"training\"", "\"spring\""),
              "periods: \"spring\" is no period of small_office"},
             {replaced(envelope, "0.5]", "60]"),
              "expected a part of the parameter's range"},
             {replaced(envelope, "0.5]", "0.1]"),
              "expected two rising numbers: [0.1, 1.5]"},
             {replaced(envelope, "seed = 9", "from = \"later\""),
              "study.stage.name: the stage envelope starts from later, which is no "
              "stage before it"},
             {replaced(envelope, "seed = 9", "set = {walls = 2}"),
              "set: walls = 2 is outside the parameter's range, 0.8 to 1.2"},
             {replaced(envelope, "seed = 9", "set = {infiltration = 0.3}"),
              "study.stage.name: the stage envelope sets infiltration, which is no "
              "parameter or which it calibrates"},
             {replaced(envelope, "\"envelope\"", "\"at_once\""),
              "stands for something else; expected another name"},
             {std::string("method = \"nsga2\"\n") + envelope,
              "study.method = \"nsga2\": expected one of swarm_then_pattern"}}) {
        const Folder folder;
        EXPECT_NE(message_of(write_job(folder, bad.keys)).find(bad.message),
                  std::string::npos)
            << message_of(write_job(folder, bad.keys)) << "\n"
            << bad.message;
    }
}

}  // namespace
}  // namespace bemcal::job
