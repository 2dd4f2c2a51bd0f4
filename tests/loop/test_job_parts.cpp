/// Sections of a job that carry on a model's structure and functions.
#include "job/small_office.hpp"
#include "loop/baseline.hpp"
#include "loop/job_parts.hpp"
#include "loop/windy_model.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

/// Of a model with this structure, beside what the job names, as it was calibrated.
std::vector<StoredLoop::JobPart> parts_of(
    const study::Case& building, const std::vector<std::size_t>& structure,
    const std::vector<FoundFunction>& functions = {}) {
    const LoopData data(building, test::WindyModel::options());
    const Place place = make_place(data, structure, data.drive);
    const std::size_t n = place.unknowns.size() + place.always.size();
    const Standing standing =
        calibrate(data, place, {structure, {}}, std::vector<double>(n));
    return job_parts_of(data, place, standing, std::vector<double>(n, 0.1), {},
                        functions);
}

/// The model with rooms that reach their set-point late, which have hours or not.
std::vector<StoredLoop::JobPart> parts_of_slow_start(
    bool cooling_has_hours, const std::vector<FoundFunction>& functions = {}) {
    study::Case measured = test::WindyModel::measured();
    physics::Thermostat& control = measured.building.zones[0].thermostat;
    control.heating_set_point = {20, 15, 0};
    control.cooling_set_point = {25, 30, cooling_has_hours ? 0 : -1};
    const auto& all = effects::refinements();
    const auto slow =
        static_cast<std::size_t>(std::ranges::find(all, std::string_view("slow start"),
                                                   &effects::Refinement::name) -
                                 all.begin());
    return parts_of(measured, {slow}, functions);
}

/// The office whose job names a structure.
std::vector<StoredLoop::JobPart> parts_of_office(const std::string& text) {
    const job::Folder folder;
    const std::string named = "structure = [\"slow start\", \"surfaces\"]\n" + text;
    return parts_of(job::read_job(job::write_small_office(folder, named)).buildings.at(0),
                    {});
}

bool has(const std::vector<StoredLoop::JobPart>& parts, const char* words) {
    return std::ranges::any_of(parts, [&](const auto& part) {
        return part.section.find(words) != std::string::npos;
    });
}

TEST(JobParts, AnEffectOfTheStructureThatDoesNothingHereIsLeftOut) {
    for (const bool cooling_has_hours : {true, false}) {
        const auto parts = parts_of_slow_start(cooling_has_hours);
        EXPECT_TRUE(has(parts, "heating set-point in the first hour"));
        EXPECT_EQ(has(parts, "cooling set-point in the first hour"), cooling_has_hours);
    }
}

TEST(JobParts, FunctionsComeFirst) {
    FoundFunction constant;
    constant.at = test::gains_of_the_morning();
    constant.basis.driver = "one";
    constant.basis.at_points = Matrix(1, 1, 1.0);
    constant.mean = {0.5};
    const auto parts = parts_of_slow_start(true, {constant});
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_STREQ(parts[0].of.c_str(), "functions");
    EXPECT_STREQ(parts[1].of.c_str(), "structure");
}

/// Its numbers and effects are parameters of the building, and of no list of the job.
TEST(JobParts, AStructureThatTheJobNamesIsWrittenAsWell) {
    const auto parts = parts_of_office(job::small_office_text());
    for (const char* name : {"[[effect]]\nname = \"heating set-point in the first hour\"",
                             "[[parameter]]\nname = \"surface_area_ratio\""})
        EXPECT_TRUE(has(parts, name)) << name;
    for (const char* name : {"\"infiltration\"", "\"heating_set_point\""})
        EXPECT_FALSE(has(parts, name)) << name;
}

TEST(JobParts, AnEffectOfAStructureThatTheJobNamesIsLeftOutWhereItDoesNothing) {
    const std::string hours = "{value = 25, low = 28, schedule = \"plant\"}";
    const char* cooling = "cooling set-point in the first hour";
    EXPECT_TRUE(has(parts_of_office(job::small_office_text()), cooling));
    EXPECT_FALSE(has(
        parts_of_office(job::replaced(job::small_office_text(), hours, "25")), cooling));
}

/// A job takes a spread only where effects add up.
TEST(JobParts, AFunctionHasASpreadWhereEffectsAddUp) {
    for (const auto& [hook, has_spread] :
         {std::pair{effects::Hook::gains, true}, {effects::Hook::loads, false}}) {
        FoundFunction function;
        function.at = test::gains_of_the_morning();
        function.at.hook = hook;
        function.at.typical = 2;
        function.deviations = {0.3, 0.3};
        function.basis.points.kind = functions::Points::Kind::knots;
        EXPECT_EQ(function.spread() > 0, has_spread);
    }
}

}  // namespace
}  // namespace bemcal::loop
