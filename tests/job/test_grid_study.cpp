/// The keys of a grid, and what bad ones get.
#include "base/error.hpp"
#include "job/grid_kind.hpp"
#include "job/kinds.hpp"
#include "schema/document.hpp"
#include "study/analytic_simulator.hpp"
#include "study/small_case.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// The study's section as a file of its own.
struct GridText {
    explicit GridText(const std::string& text)
        : tree(schema::parse_document("kind = \"grid\"\n" + text, file)),
          section(open_study(tree, file).section) {}

    StudySpec read() const {
        StudySpec study;
        study.kind = find_kind("grid");
        study.kind->read({section, files, 0, nullptr}, study);
        return study;
    }
    GridStudy grid() const { return read().as<GridStudy>(); }
    /// Read, then checked against the job's building or simulator.
    GridStudy grid_for(const Job& job) const {
        StudySpec study = read();
        study.kind->check({section, section, job}, study);
        return study.as<GridStudy>();
    }

    std::string file = "job.toml";
    schema::Node tree;
    schema::Section section;
    mutable input::InputFiles files;
};

Job job_of(const study::Case& building) {
    Job job;
    job.buildings = {building};
    return job;
}

/// A small office with a plain parameter name and both meters.
study::Case made_case() {
    study::Case building = test::small_case();
    building.parameters[0].name = "air";
    building.parameters[1].name = "sun";
    building.parameters[2].name = "set_point";
    for (const auto quantity : {physics::Quantity::electricity, physics::Quantity::gas}) {
        study::Meter meter;
        meter.name = physics::name_of(quantity);
        meter.quantity = quantity;
        meter.axis = building.weather.axis;
        meter.values.assign(static_cast<std::size_t>(meter.axis.n_steps), 2);
        building.meters.push_back(meter);
    }
    return building;
}

/// What reading and checking the text ends with; "" where it goes well.
std::string message_of(const std::string& text,
                       const study::Case& building = made_case()) {
    try {
        GridText(text).grid_for(job_of(building));
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

constexpr const char* good = "[grid]\nair = [0.5, 1.5, 1]\nset_point = [20, 21, 22]\n";

TEST(GridStudyKeys, ReadTheGridItsTargetsAndItsDefaults) {
    const GridText text(
        "k = 3\nbudget = 8000\ntarget_error = 0.129\n" + std::string(good) +
        "[[target]]\nquantity = \"gas\"\nmeasured = 43842600\nunit = \"kJ\"\n"
        "[[target]]\nquantity = \"heating\"\nstatistic = \"peak\"\nmeasured = 8\n");
    const GridStudy spec = text.grid();
    EXPECT_EQ(spec.options.grids[0][0].second, (std::vector<double>{0.5, 1, 1.5}));
    EXPECT_EQ(spec.options.nearest.k, 3U);
    EXPECT_EQ(spec.options.most_stages, 10);
    EXPECT_EQ(spec.options.budget, 8000);
    ASSERT_EQ(spec.targets.size(), 2U);
    EXPECT_NEAR(spec.targets[0].measured[0], 12178.5, 1e-9);
    EXPECT_EQ(spec.targets[1].output.statistic, calibration::Statistic::peak);
    EXPECT_EQ(find_kind("grid")->sentence(text.read()),
              "air 3 x set_point 3 = 9 points, then refined by itself: at most 8000 "
              "points in 10 stages");
}

TEST(GridStudyKeys, AreElectricityAndGasOfTheMetersByDefault) {
    const GridText text(good);
    const study::Case building = made_case();
    const auto options = options_for(text.grid(), building, building.periods[0]);
    ASSERT_EQ(options.targets.size(), 2U);
    EXPECT_EQ(options.targets[1].output, "gas");
    EXPECT_EQ(options.targets[1].measured, 480);
}

TEST(GridStudyKeys, GivenStagesEndTheStudyUnlessTheJobSaysMore) {
    const GridText text(good + std::string("[[stage]]\nair = [0.9, 1, 1.1]\nset_point = "
                                           "[21, 21.5, 22]\n"));
    const GridStudy spec = text.grid();
    EXPECT_EQ(spec.options.grids.size(), 2U);
    EXPECT_EQ(spec.options.most_stages, 2);
}

struct Bad {
    std::string text, message;
};

TEST(GridStudyKeys, BadOnesGetAMessageThatSaysWhere) {
    const std::string grid = good;
    const Bad cases[] = {
        {"",
         "job.toml:1: study.grid: is missing; expected a section [study.grid] with "
         "values of each parameter: air_change = [1, 3, 5]"},
        {"[grid]\nair = []\n",
         "job.toml:3: study.grid.air: is empty; expected the values to try"},
        {"[grid]\nair = [1, 0.5, 1]\n",
         "job.toml:3: study.grid.air: 1 stands there twice; expected each value once"},
        {"k = 10\n" + grid,
         "job.toml:2: study.k = 10: a grid of this study has 9 points "
         "only; expected at most as many"},
        {"budget = 8\n" + grid,
         "job.toml:2: study.budget: is 8, and the grids given have 9 points; expected "
         "fewer values, or a larger budget"},
        {grid + "sum = [0.4]\n",
         "job.toml:5: study.grid.sum: \"sum\" is no parameter of "
         "small; did you mean \"sun\"?"},
        {grid + "sun = [0.4, 0.8]\n",
         "job.toml:5: study.grid.sun: 0.8 lies outside the parameter's range; expected "
         "0.3 to 0.7"},
        {grid + "[[target]]\nquantity = \"gas\"\nmeasured = 0\n",
         "job.toml:7: study.target.measured = 0: errors are in per cent of it; expected "
         "a "
         "number other than 0"},
        {grid + "[[target]]\nquantity = \"gas\"\nmeasured = 5\nunit = \"degC\"\n",
         "job.toml:8: study.target.unit = \"degC\": expected one like kWh"},
        {grid + "[[target]]\nquantity = \"heating\"\n",
         "job.toml:5: study.target: the target heating is missing: small has no meter of "
         "heating with readings; expected one, or a [[study.target]] with measured"},
    };
    for (const Bad& bad : cases) EXPECT_EQ(message_of(bad.text), bad.message);
}

TEST(GridStudyKeys, AMeterOfZeroIsNoTarget) {
    study::Case building = made_case();
    for (double& value : building.meters[1].values) value = 0;
    EXPECT_EQ(
        message_of("k = 2\n" + std::string(good), building),
        "job.toml:1: study.kind: the target gas is 0, and errors are in per cent of "
        "it; expected another number, or leave it out");
}

TEST(GridStudyKeys, OfASimulatorNameItsOutputs) {
    Job job;
    job.simulator = std::make_shared<test::AnalyticSimulator>();
    const std::string grid = "k = 2\n[grid]\nlights = [1, 2]\n[[target]]\n";
    const auto options = [&](const std::string& target) {
        return options_for(GridText(grid + target).grid_for(job), *job.simulator);
    };
    EXPECT_EQ(options("output = \"heat\"\nmeasured = 4\n").targets[0].measured, 4);
    EXPECT_THROW(options("output = \"hear\"\nmeasured = 4\n"), UserError);
    EXPECT_THROW(options("output = \"heat\"\n"), UserError);
}

}  // namespace
}  // namespace bemcal::job
