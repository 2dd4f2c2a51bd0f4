/// Words the plan of a job for `check`: items, simulations, memory, output size, time.
/// The numbers are those of cost.hpp. A stock is worded by `stock_plan_text`.
#include "plan/plan.hpp"

#include "base/error.hpp"
#include "job/kind.hpp"
#include "job/stages.hpp"
#include "plan/meter_text.hpp"
#include "plan/stock_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::plan {

namespace {

using study::Case;

std::string words_of_bytes(double bytes) {
    constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
    int unit = 0;
    for (; bytes >= 1000 && unit < 4; ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string words_of_seconds(double seconds) {
    if (seconds < 120) return fmt::format("{:.0f} s", std::ceil(seconds));
    if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

std::string line_of(const std::string& name, double items, double simulations,
                    double bytes) {
    return fmt::format("{:<44} {:>8.0f} {:>14.0f} {:>10}\n", name, items, simulations,
                       words_of_bytes(bytes));
}

std::string stage_lines(const std::vector<StageCost>& stages) {
    std::string text = fmt::format("{:<44} {:>8} {:>14} {:>10}\n", "stage", "items",
                                   "simulations", "answers");
    for (const StageCost& stage : stages)
        text += line_of(stage.name, stage.items, stage.simulations, stage.answer_bytes);
    return text;
}

std::string building_lines(const job::Job& job) {
    std::string text;
    for (const Case& building : job.buildings) {
        const std::size_t n_zones = building.building.zones.size();
        text += fmt::format(
            "{}: {:.6g} m2 in {} zone{}, parameters: {}, meters: {}, steps of {} s\n",
            building.name, building.building.floor_area(), n_zones,
            n_zones == 1 ? "" : "s", building.parameters.size(), building.meters.size(),
            building.step_s);
        for (const study::Period& period : building.periods)
            text += fmt::format("  {}: {} to {}\n", period.name,
                                physics::format_time(period.from),
                                physics::format_time(period.to));
        text += meter_lines(building);
        const auto& effects = building.building.effects;
        for (std::size_t k = 0; k < effects.size(); ++k)
            text +=
                fmt::format("  effect: {}, {:.4g} {}\n", effects[k].name,
                            building.declared_effects->coefficients[k], effects[k].unit);
        for (const study::DataDecision& decision : building.decisions)
            text += fmt::format("  data, {}: {}: {}\n", decision.series, decision.finding,
                                decision.action);
    }
    return text;
}

bool has_posterior(const job::Job& job) {
    return std::ranges::any_of(
        job.studies, [](const job::StudySpec& study) { return study.kind->has_chains; });
}

std::string study_lines(const job::Job& job) {
    std::string text;
    for (const job::StudySpec& study : job.studies)
        if (study.kind->sentence != nullptr)
            text += fmt::format("{}: {}\n\n", study.name, study.kind->sentence(study));
    return text;
}

}  // namespace

PlanCost plan_cost(const job::Job& job) {
    job::check_studies(job);
    return job.stock ? stock_cost(job) : cost_of_buildings(job);
}

std::string plan_text(const job::Job& job, int cores) {
    job::check_studies(job);
    if (job.stock) return stock_plan_text(job, cores);
    const std::vector<StageCost> stages = stage_costs(job);
    const PlanCost total = total_of(stages, job);
    std::string text =
        fmt::format("{}: buildings: {}, studies: {}, files read: {}\n", job.name,
                    job.buildings.size(), job.studies.size(), job.inputs.size());
    text += building_lines(job) + "\n" + stage_lines(stages);
    text += line_of("total", total.items, total.simulations, total.answer_bytes) + "\n";
    if (has_posterior(job))
        text +=
            "a posterior is counted with its whole budget; it ends when it has "
            "converged\n\n";
    text += study_lines(job);
    const double data = total.data_bytes, of_each = 3 * data + total.working_bytes;
    text += fmt::format("memory: about {} on rank 0, {} on the others\n",
                        words_of_bytes(2 * total.answer_bytes + of_each),
                        words_of_bytes(of_each));
    text += fmt::format("output: about {}\n", words_of_bytes(total.answer_bytes + data));
    if (job.simulator)
        return text + fmt::format(
                          "time:   that of {:.0f} runs of the command, on {} "
                          "core{}\n",
                          total.simulations, std::max(cores, 1), cores > 1 ? "s" : "");
    text += fmt::format("time:   about {} on {} core{}, by rough costs of a step\n",
                        words_of_seconds(total.core_seconds / std::max(cores, 1)),
                        std::max(cores, 1), cores > 1 ? "s" : "");
    return text;
}

}  // namespace bemcal::plan
