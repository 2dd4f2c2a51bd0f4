#include "job/plan.hpp"

#include "base/error.hpp"
#include "study/koh_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using study::Case;
using study::Stage;
using Stages = std::vector<std::unique_ptr<Stage>>;

std::unique_ptr<Stage> stage_of(const StudySpec& study, const Case& building) {
    const std::string name = building.name + "/" + study.name;
    if (study.kind == StudyKind::screening)
        return make_screening(name, building, study.screening);
    const study::Period& period = period_of(building, study.period);
    if (study.kind == StudyKind::hourly_sensitivity)
        return make_hourly_sensitivity(name, building, period, study.quantities.at(0),
                                       study.sensitivity);
    return make_sensitivity(name,
                            make_batch_simulator(building, period, study.quantities),
                            study.sensitivity);
}

/// One stage, or one for each case of fixed inputs: "sobol/case_01", ...
Stages office_hour_stages(const StudySpec& study) {
    using Fixed = std::vector<std::pair<std::string, double>>;
    Stages stages;
    const auto add = [&](const std::string& name, const Fixed& fixed) {
        stages.push_back(make_sensitivity(name, study::make_office_hour_simulator(fixed),
                                          study.sensitivity));
    };
    if (study.fixed.empty()) add(study.name, {});
    const std::size_t n_cases = study.fixed.empty() ? 0 : study.fixed[0].second.size();
    for (std::size_t c = 0; c < n_cases; ++c) {
        Fixed fixed;
        for (const auto& [input, values] : study.fixed)
            fixed.emplace_back(input, values[c]);
        add(fmt::format("{}/case_{:02}", study.name, c + 1), fixed);
    }
    return stages;
}

/// One stage for each building, or one for all.
Stages posterior_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    if (study.posterior.pooling != study::Pooling::none) {
        stages.push_back(make_posterior(study.name, job.buildings, study.posterior));
        return stages;
    }
    for (const Case& building : job.buildings)
        stages.push_back(make_posterior(building.name + "/" + study.name, {building},
                                        study.posterior));
    return stages;
}

/// What only shows when a posterior is put together is a mistake in the job.
Stages checked_posterior_stages(const StudySpec& study, const Job& job) {
    try {
        return posterior_stages(study, job);
    } catch (const std::invalid_argument& error) {
        throw UserError(ExitCode::config,
                        fmt::format("{}: the study {}: {}", job.file.string(), study.name,
                                    error.what()));
    }
}

/// The stages of one study, over all buildings.
Stages stages_of(const StudySpec& study, const Job& job) {
    if (study.kind == StudyKind::office_hour_sensitivity)
        return office_hour_stages(study);
    if (study.kind == StudyKind::posterior) return checked_posterior_stages(study, job);
    Stages stages;
    if (study.kind == StudyKind::kennedy_ohagan) {
        stages.push_back(make_koh_stage(study.name, study.koh));
        return stages;
    }
    for (const Case& building : job.buildings)
        stages.push_back(stage_of(study, building));
    return stages;
}

double hours_of(const study::Period& period) {
    return static_cast<double>((period.to - period.from).count()) / 3600;
}

/// Zone-steps that one simulation of a building takes, on average over the study's
/// periods.
double steps_of(const StudySpec& study, const Case& building) {
    double hours = 0;
    if (study.kind == StudyKind::screening) {
        for (const study::Period& period : building.periods) hours += hours_of(period);
        hours /= static_cast<double>(building.periods.size());
    } else {
        hours = hours_of(period_of(building, study.period));
    }
    return (hours + building.warm_up_hours) * 3600 / building.step_s *
           static_cast<double>(building.building.zones.size());
}

bool is_coupled(const Case& building) {
    return std::any_of(building.building.zones.begin(), building.building.zones.end(),
                       [](const physics::Zone& zone) { return !zone.couplings.empty(); });
}

/// Rough costs of a zone-step on one core with AVX2 [s]: sums only, and errors against
/// meters; `bench kernel` measures the real ones.
constexpr double sums_step_s = 1e-9, errors_step_s = 2e-9, coupled_step_s = 3e-7;
constexpr double office_hour_s = 1e-6;

/// Rough numbers of simulations for one transition of a chain: a nuts trajectory has
/// about 2^4 gradients, at three times the cost of a simulation.
double simulations_per_transition(const StudySpec& study, const Case& building) {
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
double most_simulations(const StudySpec& study, const Job& job, const Stage& stage) {
    if (study.kind != StudyKind::posterior)
        return static_cast<double>(stage.n_simulations());
    const study::ChainOptions& chains = study.posterior.chains;
    const double transitions =
        chains.sampler.n_warm_up +
        static_cast<double>(chains.most_draws) * chains.sampler.thin;
    const std::size_t n_buildings =
        study.posterior.pooling == study::Pooling::none ? 1 : job.buildings.size();
    return chains.n_chains * transitions *
           static_cast<double>(chains.sampler.inverse_temperatures.size()) *
           static_cast<double>(n_buildings) *
           simulations_per_transition(study, job.buildings.at(0));
}

bool has_chains(const StudySpec& study) {
    return study.kind == StudyKind::posterior || study.kind == StudyKind::kennedy_ohagan;
}

/// A posterior keeps the answers of all its rounds; the first one is the warm-up.
double rounds_of(const StudySpec& study) {
    if (!has_chains(study)) return 1;
    const study::ChainOptions& chains =
        study.kind == StudyKind::posterior ? study.posterior.chains : study.koh.chains;
    return 1 + std::ceil(static_cast<double>(chains.most_draws) / chains.draws_per_round);
}

double seconds_of(const StudySpec& study, const Case* building, double n) {
    if (study.kind == StudyKind::kennedy_ohagan) return koh_seconds(study.koh);
    if (building == nullptr) return n * office_hour_s;
    const double steps = n * steps_of(study, *building);
    if (is_coupled(*building)) return steps * coupled_step_s;
    return steps * (study.kind == StudyKind::sensitivity ? sums_step_s : errors_step_s);
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

std::string stage_lines(const Job& job, Total& total) {
    std::string text = fmt::format("{:<44} {:>8} {:>14} {:>10}\n", "stage", "items",
                                   "simulations", "answers");
    for (const StudySpec& study : job.studies) {
        std::size_t number = 0;
        for (const auto& stage : stages_of(study, job)) {
            const Case* building =
                is_of_buildings(study.kind) ? &job.buildings.at(number++) : nullptr;
            const double items = stage->n_items() * rounds_of(study);
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

std::string building_lines(const Job& job) {
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

bool has_posterior(const Job& job) {
    return std::any_of(job.studies.begin(), job.studies.end(), has_chains);
}

/// A job without studies can be read, but there is nothing to plan.
void check_studies(const Job& job) {
    if (job.studies.empty())
        throw UserError(
            ExitCode::config,
            fmt::format("{}:1: study: is missing; expected sections [[study]] "
                        "with a kind, like \"screening\"",
                        job.file.string()));
}

}  // namespace

Stages make_plan(const Job& job) {
    check_studies(job);
    Stages stages;
    for (const StudySpec& study : job.studies)
        for (auto& stage : stages_of(study, job)) stages.push_back(std::move(stage));
    return stages;
}

std::string plan_text(const Job& job, int cores) {
    check_studies(job);
    Total total;
    std::string text =
        fmt::format("{}: buildings: {}, studies: {}, files read: {}\n", job.name,
                    job.buildings.size(), job.studies.size(), job.inputs.size());
    text += building_lines(job) + "\n" + stage_lines(job, total);
    double data = 0;
    for (const Case& building : job.buildings) data += series_bytes(building);
    text += fmt::format("{:<44} {:>8.0f} {:>14.0f} {:>10}\n\n", "total", total.items,
                        total.simulations, words_of_bytes(total.answers));
    if (has_posterior(job))
        text +=
            "a posterior is counted with its whole budget; it ends when it has "
            "converged\n\n";
    text += fmt::format("memory: about {} on rank 0, {} on the others\n",
                        words_of_bytes(2 * total.answers + 3 * data),
                        words_of_bytes(3 * data));
    text += fmt::format("output: about {}\n", words_of_bytes(total.answers + data));
    text += fmt::format("time:   about {} on {} core{}, by rough costs of a step\n",
                        words_of_seconds(total.seconds / std::max(cores, 1)),
                        std::max(cores, 1), cores > 1 ? "s" : "");
    return text;
}

}  // namespace bemcal::job
