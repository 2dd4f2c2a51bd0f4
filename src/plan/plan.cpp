/// Words the plan of a job for `check`: items, simulations, memory, output size, time.
/// Follows from the stages' own counts times rough costs of a zone-step with AVX2.
/// A posterior is counted with its whole budget; a stage over several buildings is timed
/// by the first; runs of a command are not timed. A stock is worded by `stock_plan_text`.
#include "plan/plan.hpp"

#include "base/error.hpp"
#include "job/readers.hpp"
#include "job/stages.hpp"
#include "loop/loop.hpp"
#include "plan/stock_text.hpp"
#include "posterior/koh_posterior.hpp"
#include "stock/stage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::plan {

namespace {

using study::Case;
using study::Stage;

double hours_of(const study::Period& period) {
    return static_cast<double>((period.to - period.from).count()) / 3600;
}

/// Zone-steps that one simulation of a building takes, on average over the study's
/// periods.
double steps_of(const job::StudySpec& study, const Case& building) {
    double hours = 0;
    if (study.kind == job::StudyKind::screening) {
        for (const study::Period& period : building.periods) hours += hours_of(period);
        hours /= static_cast<double>(building.periods.size());
    } else {
        hours = hours_of(period_of(building, study.period));
    }
    return (hours + building.warm_up_hours) * 3600 / building.step_s *
           static_cast<double>(building.building.zones.size());
}

/// Rough costs of a zone-step on one core with AVX2 [s]: sums only, and errors against
/// meters; `bench kernel` measures the real ones.
constexpr double sums_step_s = 1e-9, errors_step_s = 2e-9, plain_step_s = 3e-7,
                 radiator_step_s = 2e-6;
constexpr double office_hour_s = 1e-6;

bool has_radiator(const Case& building) {
    return std::ranges::any_of(building.building.zones, [](const physics::Zone& zone) {
        return zone.radiator.has_value();
    });
}

/// Rough numbers of simulations for one transition of a chain: a nuts trajectory has
/// about 2^4 gradients, at three times the cost of a simulation.
double simulations_per_transition(const job::StudySpec& study, const Case& building) {
    switch (study.posterior.chains.sampler.method) {
        case sampling::Method::nuts:
            return 48;
        case sampling::Method::random_walk:
            return 1;
        case sampling::Method::gibbs:
            return static_cast<double>(building.parameters.size());
    }
    return 1;
}

/// Of a posterior, where it uses its whole budget; else what the stage says.
double most_simulations(const job::StudySpec& study, const job::Job& job,
                        const Stage& stage) {
    if (study.kind != job::StudyKind::posterior)
        return static_cast<double>(stage.n_simulations());
    const posterior::ChainOptions& chains = study.posterior.chains;
    const double transitions =
        chains.sampler.n_warm_up +
        static_cast<double>(chains.most_draws) * chains.sampler.thin;
    const std::size_t n_buildings =
        study.posterior.pooling == posterior::Pooling::none ? 1 : job.buildings.size();
    return chains.n_chains * transitions *
           static_cast<double>(chains.sampler.inverse_temperatures.size()) *
           static_cast<double>(n_buildings) *
           simulations_per_transition(study, job.buildings.at(0));
}

bool has_chains(const job::StudySpec& study) {
    return study.kind == job::StudyKind::posterior ||
           study.kind == job::StudyKind::kennedy_ohagan;
}

/// A posterior keeps the answers of all its rounds; the first one is the warm-up.
double rounds_of(const job::StudySpec& study, const Stage& stage) {
    if (study.kind == job::StudyKind::optimisation)
        return static_cast<double>(stage.n_simulations()) /
               static_cast<double>(study.optimisation.points_per_item) / stage.n_items();
    if (study.kind == job::StudyKind::stages)
        return static_cast<double>(stage.n_simulations()) /
               (stage.n_items() * calibration::points_per_staged_item);
    if (!has_chains(study)) return 1;
    const posterior::ChainOptions& chains = study.kind == job::StudyKind::posterior
                                                ? study.posterior.chains
                                                : study.koh.options.chains;
    return 1 + std::ceil(static_cast<double>(chains.most_draws) / chains.draws_per_round);
}

double seconds_of(const job::StudySpec& study, const Case* building, double n) {
    if (study.kind == job::StudyKind::kennedy_ohagan)
        return study.koh.runs ? 0 : posterior::koh_seconds(study.koh.options);
    if (building == nullptr) return n * office_hour_s;
    const double steps = n * steps_of(study, *building);
    if (has_radiator(*building)) return steps * radiator_step_s;
    if (kernel::runs_plain(building->building)) return steps * plain_step_s;
    return steps *
           (study.kind == job::StudyKind::sensitivity ? sums_step_s : errors_step_s);
}

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

struct Total {
    double items = 0, simulations = 0;
    double answers = 0;  ///< bytes on rank 0, and about those of the result
    double seconds = 0;  ///< on one core
};

double series_bytes(const Case& building) {
    std::size_t n = building.weather.theta_e.size() *
                    (4 + building.building.planes.size() + building.profiles.size());
    for (const study::Meter& meter : building.meters) n += meter.values.size();
    return 8.0 * static_cast<double>(n);
}

double series_bytes(const job::Job& job) {
    double bytes = 0;
    for (const Case& building : job.buildings) bytes += series_bytes(building);
    return bytes;
}

std::string stage_lines(const job::Job& job, Total& total) {
    std::string text = fmt::format("{:<44} {:>8} {:>14} {:>10}\n", "stage", "items",
                                   "simulations", "answers");
    for (const job::StudySpec& study : job.studies) {
        std::size_t number = 0;
        for (const auto& stage : job::stages_of(study, job)) {
            const Case* building = job::is_of_buildings(study.kind) && !job.simulator
                                       ? &job.buildings.at(number++)
                                       : nullptr;
            const double items = stage->n_items() * rounds_of(study, *stage);
            const double bytes = static_cast<double>(stage->answer_bytes()) * items;
            const double simulations = most_simulations(study, job, *stage);
            text += fmt::format("{:<44} {:>8.0f} {:>14.0f} {:>10}\n", stage->name(),
                                items, simulations, words_of_bytes(bytes));
            total.items += items;
            total.simulations += simulations;
            total.answers += bytes;
            total.seconds += seconds_of(study, building, simulations);
        }
    }
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
        for (const study::DataDecision& decision : building.decisions)
            text += fmt::format("  data, {}: {}: {}\n", decision.series, decision.finding,
                                decision.action);
    }
    return text;
}

bool has_posterior(const job::Job& job) {
    return std::any_of(job.studies.begin(), job.studies.end(), has_chains);
}

std::string study_lines(const job::Job& job) {
    std::string text;
    for (const job::StudySpec& study : job.studies)
        if (study.kind == job::StudyKind::loop)
            text += fmt::format("{}: {}\n\n", study.name, job::sentence_of(study.loop));
        else if (study.kind == job::StudyKind::grid)
            text += fmt::format("{}: {}\n\n", study.name,
                                job::sentence_of(study.grid.options));
    return text;
}

}  // namespace

PlanCost plan_cost(const job::Job& job) {
    job::check_studies(job);
    if (job.stock) return stock_cost(job);
    Total total;
    stage_lines(job, total);
    return {total.items, total.simulations, total.answers, series_bytes(job),
            total.seconds};
}

std::string plan_text(const job::Job& job, int cores) {
    job::check_studies(job);
    if (job.stock) return stock_plan_text(job, cores);
    Total total;
    std::string text =
        fmt::format("{}: buildings: {}, studies: {}, files read: {}\n", job.name,
                    job.buildings.size(), job.studies.size(), job.inputs.size());
    text += building_lines(job) + "\n" + stage_lines(job, total);
    const double data = series_bytes(job);
    text += fmt::format("{:<44} {:>8.0f} {:>14.0f} {:>10}\n\n", "total", total.items,
                        total.simulations, words_of_bytes(total.answers));
    if (has_posterior(job))
        text +=
            "a posterior is counted with its whole budget; it ends when it has "
            "converged\n\n";
    text += study_lines(job);
    text += fmt::format("memory: about {} on rank 0, {} on the others\n",
                        words_of_bytes(2 * total.answers + 3 * data),
                        words_of_bytes(3 * data));
    text += fmt::format("output: about {}\n", words_of_bytes(total.answers + data));
    if (job.simulator)
        return text + fmt::format(
                          "time:   that of {:.0f} runs of the command, on {} "
                          "core{}\n",
                          total.simulations, std::max(cores, 1), cores > 1 ? "s" : "");
    text += fmt::format("time:   about {} on {} core{}, by rough costs of a step\n",
                        words_of_seconds(total.seconds / std::max(cores, 1)),
                        std::max(cores, 1), cores > 1 ? "s" : "");
    return text;
}

}  // namespace bemcal::plan
