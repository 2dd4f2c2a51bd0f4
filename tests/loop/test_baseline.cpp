#include "loop/baseline.hpp"
#include "loop/windy_case.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

struct WithBaseline {
    WithBaseline() {
        Case made = test::windy_case();
        test::measure(made, test::named("wind infiltration"), 0.08, 3);
        data = std::make_unique<LoopData>(made, LoopOptions{});
        baseline = make_baseline(*data);
    }
    std::unique_ptr<LoopData> data;
    Baseline baseline;
};

const WithBaseline& windy() {
    static const WithBaseline one;
    return one;
}

}  // namespace

// Not all are tried in each round, but all that are left are in the last.
TEST(LoopBaseline, NoRefinementThatIsLeftWouldHelp) {
    const Baseline& baseline = windy().baseline;
    const auto& chosen = baseline.chosen.model.structure;
    ASSERT_FALSE(chosen.empty());
    std::size_t n_left = 0;
    for (std::size_t k = 0; k < effects::refinements().size(); ++k) {
        const auto more = effects::joined_by(k, chosen, {});
        if (!more) continue;
        const auto tried = std::ranges::find(baseline.tried, effects::name_of(*more),
                                             &TriedStructure::name);
        if (tried == baseline.tried.end()) continue;
        EXPECT_GT(tried->score, baseline.gained - 6) << tried->name;
        ++n_left;
    }
    EXPECT_GE(n_left + chosen.size() + 4,
              effects::refinements().size());  // some cannot enter
}

TEST(LoopBaseline, EachRefinementThatWasChosenLoweredTheScore) {
    const Baseline& baseline = windy().baseline;
    double before = 0;
    std::vector<std::size_t> structure;
    for (const std::size_t refinement : baseline.chosen.model.structure) {
        structure.push_back(refinement);
        const auto tried = std::ranges::find(baseline.tried, effects::name_of(structure),
                                             &TriedStructure::name);
        ASSERT_NE(tried, baseline.tried.end()) << effects::name_of(structure);
        EXPECT_LT(tried->score, before - 6) << tried->name;
        before = tried->score;
    }
}

/// Heating that stops at a running mean of 13.4 degC, in weather that swings about 14, in
/// a building whose leaks let in so much for each m/s of wind.
Case seasonal_case(double wind) {
    constexpr double limit = 13.4, warmer = 11;
    Case made = test::windy_case();
    for (double& theta : made.weather.theta_e) theta += warmer;
    physics::Structure& structure = made.building.zones[0].structure;
    structure.heating_limit = limit;
    test::measure(made, test::named("wind infiltration"), wind, 3);
    structure.heating_limit = physics::unlimited;
    return made;
}

std::size_t refinement_named(const char* name) {
    const auto& all = effects::refinements();
    return static_cast<std::size_t>(
        std::ranges::find(all, std::string_view(name), &effects::Refinement::name) -
        all.begin());
}

TEST(LoopBaseline, FindsTheHeatingSeason) {
    const LoopData data(seasonal_case(0), LoopOptions{});
    const Standing chosen = make_baseline(data).chosen;
    const auto& unknowns = chosen.built.unknowns;
    const auto found =
        std::ranges::find(unknowns, "heating_limit", &study::FitUnknown::name);
    ASSERT_NE(found, unknowns.end());
    const auto k = static_cast<std::size_t>(found - unknowns.begin());
    EXPECT_NEAR(values_in(chosen.built, chosen)[k], 13.4, 0.3);
}

// What stood for the wind leaves when the wind is there; what the building has stays.
TEST(LoopBaseline, RefinementsLeaveThatAModelWithEffectsNoLongerNeeds) {
    const LoopData data(seasonal_case(0.08), LoopOptions{});
    const std::size_t season = refinement_named("heating season"),
                      leaks = refinement_named("wind in leaks"),
                      gains = refinement_named("gains to air");
    const LoopModel model{{leaks, season, gains}, {test::named("wind infiltration")}};
    Place place = make_place(data, model.structure, data.drive);
    Standing standing =
        calibrate(data, place, model,
                  std::vector<double>(place.unknowns.size() + place.always.size() + 1));
    const double coefficient = standing.coefficient(0);
    const auto gone = leave_unneeded_refinements(data, place, standing);
    EXPECT_EQ(gone, (std::vector{gains, leaks}));  // the last first
    EXPECT_EQ(standing.model.structure, std::vector{season});
    EXPECT_EQ(standing.built.first_effect(), place.unknowns.size());
    EXPECT_NEAR(standing.coefficient(0), 0.08, 0.01);
    EXPECT_NE(standing.coefficient(0), coefficient);
    EXPECT_TRUE(leave_unneeded_refinements(data, place, standing).empty());
}
