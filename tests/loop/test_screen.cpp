#include "base/error.hpp"
#include "effects/catalogue.hpp"
#include "loop/closed_days.hpp"
#include "loop/moves.hpp"
#include "loop/search.hpp"
#include "loop/windy_model.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using test::named;

namespace {

/// While it lives no batch of points can be made, whatever the building: an error that
/// says nothing of a candidate.
struct NoKernel {
    NoKernel() { setenv("BEMCAL_KERNEL", "none", 1); }
    ~NoKernel() { unsetenv("BEMCAL_KERNEL"); }
};

/// The first effect of the catalogue that cannot enter the building.
effects::Effect outsider(const Place& place) {
    for (const effects::Entry& entry : effects::catalogue())
        if (effects::objection(entry.effect, *place.surroundings)) return entry.effect;
    throw std::out_of_range("every effect can enter");
}

}  // namespace

TEST(LoopScreen, AnEffectThatCannotEnterTheBuildingIsLeftOut) {
    const test::WindyModel model({});
    const effects::Effect outside = outsider(model.place);
    EXPECT_THROW(build(model.place, {outside}), CannotSimulate);
    const auto screened =
        screen(model.data, model.place, model.standing,
               {outside, named("wind infiltration"), outside}, Keep::gains);
    ASSERT_EQ(screened.size(), 1U);
    EXPECT_EQ(screened[0].effect.name, "wind infiltration");
}

TEST(LoopScreen, OneMoreEffectIsPlacedAsAllAtOnce) {
    const test::WindyModel model({"holidays"});
    const auto& standing = model.standing.model.effects;
    OneMore one_more(model.place, standing);
    for (const char* name : {"use at night", "wind infiltration"}) {
        auto all = standing;
        all.push_back(named(name));
        const BuiltModel built = build(model.place, all);
        Matrix point(1, built.unknowns.size());
        for (std::size_t k = 0; k < point.cols; ++k)
            point(0, k) = std::clamp(built.unknowns[k].value(0.3),
                                     built.unknowns[k].least, built.unknowns[k].most);
        const auto own = one_more.with({&all.back()}).predict(point).values;
        EXPECT_EQ(own, built.fit_model->predict(point).values);
        EXPECT_EQ(one_more.coefficients().back().name, name);
    }
}

// Several stand side by side, of which one acts.
TEST(LoopScreen, CandidatesAreWhatTheyAreAlone) {
    const test::WindyModel model({"holidays"});
    const auto candidates =
        effects::named_candidates(*model.place.surroundings, model.data.quantities());
    ASSERT_GT(candidates.size(), 50U);
    const auto screened =
        screen(model.data, model.place, model.standing, candidates, Keep::gains);
    std::size_t k = 0;
    for (const effects::Effect& effect : candidates) {
        const auto alone =
            screen(model.data, model.place, model.standing, {effect}, Keep::gains);
        if (alone.empty()) continue;
        ASSERT_LT(k, screened.size());
        EXPECT_EQ(screened[k].effect.name, effect.name);
        EXPECT_NEAR(screened[k].gain, alone[0].gain, 1e-9 * (1 + alone[0].gain))
            << effect.name;
        k += 1;
    }
    EXPECT_EQ(k, screened.size());
}

TEST(LoopScreen, AnEffectThatMovesNoMeterIsLeftOut) {
    test::WindyModel model({});
    effects::Effect still = named("wind infiltration");
    still.most = 0;  // no amplitude that is tried lies in its range
    still.least = 0;
    EXPECT_TRUE(
        screen(model.data, model.place, model.standing, {still}, Keep::gains).empty());
}

TEST(LoopScreen, AnErrorThatIsNotTheCandidatesEndsTheSearch) {
    test::WindyModel model({"holidays"});
    const effects::Effect moved = model.standing.model.effects[0];
    const NoKernel none;
    EXPECT_TRUE(screen(model.data, model.place, model.standing, {}, Keep::gains).empty());
    EXPECT_THROW(screen(model.data, model.place, model.standing, {moved}, Keep::gains),
                 std::invalid_argument);
    EXPECT_THROW(search(model.data, model.place, model.standing), std::invalid_argument);
    EXPECT_THROW(closed_days(model.data, model.place, model.standing),
                 std::invalid_argument);
    EXPECT_THROW(split(model.data, model.place, model.standing, 0, 0),
                 std::invalid_argument);
    EXPECT_THROW(swap(model.data, model.place, model.standing, 0, {moved}),
                 std::invalid_argument);
}
