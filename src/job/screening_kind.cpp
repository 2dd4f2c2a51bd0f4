/// The kind "screening": a sample over the parameters' ranges, and the error of every
/// point against every meter.
/// Follows from `make_screening`.
/// It sees every period, so it has no key for one. Of a [simulator] an emulator of its
/// runs is screened.
#include "calibration/emulated_calibration.hpp"
#include "calibration/screening.hpp"
#include "description/words.hpp"
#include "job/hourly_outputs.hpp"
#include "job/kind.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using calibration::ScreeningOptions;
using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"screening\"", "",
     "Points all over the parameters' ranges, each held against the meters in every "
     "period: the best, and how many meet ASHRAE Guideline 14."}};

constexpr schema::Key keys[] = {
    {"study", "n_points", Type::integer, "", "4096", 1, 1 << 30,
     "Of the sample; the building as described is one more."},
    {"study", "points_per_item", Type::integer, "", "1024", 1, 1 << 20,
     "Points that are handed out together."},
    {"study", "keep_points", Type::flag, "", "true", 0, 0,
     "Store every point, not the best only."},
    {"study", "n_best", Type::integer, "", "20", 1, 100000,
     "So many best points are stored."},
};

void read(const StudySource& source, StudySpec& study) {
    const schema::Section& section = source.section;
    ScreeningOptions options;
    options.seed = source.seed;
    options.n_points = static_cast<std::size_t>(section.integer("n_points"));
    options.points_per_item =
        static_cast<std::size_t>(section.integer("points_per_item"));
    options.keep_points = section.flag("keep_points");
    options.n_best = static_cast<std::size_t>(section.integer("n_best"));
    options.simulator_runs = static_cast<int>(section.integer("runs"));
    study.options = options;
}

/// Runs come near what the first period, by which points are ranked, has.
std::unique_ptr<study::Stage> screening_around(const StudySpec& study, const Job& job) {
    const study::Case& building = job.buildings.at(0);
    const std::string name = stage_name(study, building);
    const auto& screened = study.as<ScreeningOptions>();
    return calibration::make_emulated_calibration(
        name, building, job.hourly_simulator,
        {"screening", screened.simulator_runs, job.seed, {building.periods.at(0).name}},
        [name, screened](const study::Case& of_program,
                         const calibration::MakePeriodModel& model) {
            return calibration::make_screening(name, of_program, screened, model);
        });
}

/// With the hours that [output] asks for.
ScreeningOptions options_of(const StudySpec& study, const Job& job) {
    auto options = study.as<ScreeningOptions>();
    options.hourly_outputs = job.hourly_outputs;
    return options;
}

void check_simulator(const StudyPlace& place, const StudySpec& study) {
    check_hourly_outputs(place, {});
    check_nominal(place, "a screening runs it first");
    description::at_key(place.section, "kind",
                        [&] { return screening_around(study, place.job); });
}

void check(const StudyPlace& place, StudySpec& study) {
    if (place.job.simulator) return check_simulator(place, study);
    check_no_runs(place.section);
    for (const study::Case& building : place.job.buildings)
        if (std::ranges::none_of(building.meters, [](const study::Meter& meter) {
                return study::has_reading(meter.values);
            }))
            place.section.fail("kind", fmt::format("needs readings, and {} has none; add "
                                                   "[[meter]]",
                                                   building.name));
}

Stages stages(const StudySpec& study, const Job& job) {
    if (job.hourly_simulator) return only(screening_around(study, job));
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return calibration::make_screening(std::move(name), building,
                                           options_of(study, job));
    });
}

/// A point is simulated over one period after the other.
void cost(const StudyStage& stage, Effort& effort) {
    if (stage.job.simulator) return;  // its runs are what takes time
    double hours = 0;
    for (const study::Period& period : stage.building->periods)
        hours += study::hours_of(period);
    effort.hours = hours / static_cast<double>(stage.building->periods.size());
}

std::vector<Fitted> fitted(const StudySpec&, const study::Case&) {
    return {{}};
}

}  // namespace

extern const Kind screening_kind{.word = "screening",
                                 .sections = {sections},
                                 .keys = {keys, emulated_hours_keys},
                                 .takes_twin = true,
                                 .takes_stock = true,
                                 .read = read,
                                 .check = check,
                                 .stages = stages,
                                 .cost = cost,
                                 .points_of = stage_name,
                                 .points_around = stage_name,
                                 .fitted = fitted};

}  // namespace bemcal::job
