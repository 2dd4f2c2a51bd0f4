/// Puts the program's runs in the place of a model's predictions.
/// Follows from `FitsWriter`; intervals are those of what the last best run leaves in
/// training, of which a dozen parameters have seen thousands of hours.
/// Sections for a job are left out: what was found belongs into the program's model.
#include "loop/simulator_results.hpp"

#include "base/nan.hpp"
#include "loop/given_effects.hpp"
#include "loop/simulator_plan.hpp"
#include "loop/simulator_readings.hpp"
#include "loop/stored_fits.hpp"
#include "loop/stored_simulator.hpp"
#include "study/datasets.hpp"
#include "study/simulated_hours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::loop {
namespace {

bool are_at_one_point(const SimulatorRun& one, const SimulatorRun& other) {
    const auto n = std::max(one.scales.size(), other.scales.size());
    std::vector<double> left = one.scales, right = other.scales;
    left.resize(n, 0.0);
    right.resize(n, 0.0);
    return one.point == other.point && left == right;
}

/// Fills the periods that other runs at the same point are of.
SimulatorRun completed(SimulatorRun run, const std::vector<SimulatorRun>& runs) {
    for (const SimulatorRun& other : runs) {
        if (!other.failure.empty() || other.asked == run.asked ||
            !are_at_one_point(run, other))
            continue;
        for (std::size_t c = 0; c < run.hours.size(); ++c)
            for (std::size_t h = 0; h < run.hours[c].size(); ++h)
                if (std::isnan(run.hours[c][h])) run.hours[c][h] = other.hours[c][h];
    }
    return run;
}

/// As many hours as another run has, none of them known.
std::vector<std::vector<double>> unknown_like(const SimulatorRun& run) {
    auto hours = run.hours;
    for (std::vector<double>& channel : hours) std::ranges::fill(channel, nan);
    return hours;
}

constexpr const char* no_help =
    "taken out: the program's own runs are no nearer to the readings with it";
constexpr const char* not_tried = "taken out: as many as are tried had more evidence";

class Concluder {
  public:
    explicit Concluder(const Around& around) : around_(around), so_far_(around.so_far) {
        const ReportedRuns reported = so_far_.reported(around.kept);
        has_runs_ = reported[StoredLoop::before].has_value();
        for (const auto& run : reported)
            reported_.push_back(completed(around.runs[run.value_or(0)], around.runs));
        // Of a nominal run that failed there are no hours.
        for (SimulatorRun& run : reported_)
            if (!run.failure.empty())
                run.hours = unknown_like(reported_[StoredLoop::before]);
    }

    study::Conclusion conclude() {
        study::Conclusion all;
        if (!around_.searched.datasets.empty() && has_runs_) with_search(all);
        std::ranges::move(datasets_of(around_.stage, simulator()),
                          std::back_inserter(all.datasets));
        study::DatasetBuilder failures(around_.stage);
        failures.failures(failures_of_runs());
        std::ranges::move(failures.take(), std::back_inserter(all.datasets));
        return all;
    }

  private:
    const SimulatorRun& run_of(std::size_t model) const { return reported_[model]; }

    void with_search(study::Conclusion& all) {
        StoredLoop stored = stored_loop(around_.searched.datasets, around_.stage);
        const LoopData& data = around_.written;
        const auto predicted = readings_from(data, run_of(StoredLoop::after).hours);
        const auto unseen = unseen_of(
            data, predicted, study::residuals_of(data.targets.measured, predicted));
        leave_what_does_not_help(stored);
        FitsWriter writer(data, data.building, unseen, 0, stored);
        std::vector<StoredPeriod> periods;
        periods.reserve(data.building.periods.size());
        for (const study::Period& period : data.building.periods)
            periods.push_back(writer.add(period, hours_in_period(period)));
        all.summaries.push_back(summary_of(around_.stage, data, stored));
        add_point(all.summaries.back());
        all.datasets = datasets_of(around_.stage, stored, periods);
    }

    /// The run that is after: the program's parameters, and what it was given.
    void add_point(study::Summary& summary) const {
        const auto& parameters = around_.simulator.parameters();
        for (const physics::Parameter& parameter : parameters)
            summary.points.parameters.push_back(parameter.name);
        summary.points.rows = Matrix(0, parameters.size());
        summary.points.rows.add_row(
            study::values_at(run_of(StoredLoop::after).point, parameters));
        summary.given = study::scaled(around_.effects, scales());
    }

    bool is_kept(std::size_t effect) const {
        return effect < around_.kept.size() && around_.kept[effect] != 0;
    }

    const char* why_left(std::size_t effect) const {
        return effect < around_.kept.size() ? no_help : not_tried;
    }

    /// Effects and functions without which the program is as near to the readings are no
    /// findings; the log of the search says so. Coefficients are those that were given.
    void leave_what_does_not_help(StoredLoop& stored) const {
        const std::size_t n = stored.effects.size();
        const std::vector<double> given = scales();
        const auto of_index = [](double index) {
            return static_cast<std::size_t>(index);
        };
        std::vector<double> new_index(n, nan);
        std::vector<StoredLoop::Effect> kept;
        for (std::size_t k = 0; k < n; ++k) {
            StoredLoop::Effect& effect = stored.effects[k];
            if (!is_kept(k)) {
                stored.steps.push_back({effect.name, why_left(k), effect.gain, nan, nan});
                continue;
            }
            new_index[k] = static_cast<double>(kept.size());
            effect.section.clear();  // it is the program's model that is to have it
            for (double* number : {&effect.coefficient, &effect.least, &effect.most})
                *number *= given[k];
            kept.push_back(std::move(effect));
        }
        stored.effects = std::move(kept);
        std::erase_if(stored.effect_values, [&](const StoredLoop::EffectValue& value) {
            return std::isnan(new_index[of_index(value.effect)]);
        });
        for (StoredLoop::EffectValue& value : stored.effect_values)
            value.effect = new_index[of_index(value.effect)];
        stored.settings.clear();  // The twin's are its program's.
        if (!stored.functions.empty() && !is_kept(n)) {
            stored.steps.push_back({"functions", why_left(n), nan, nan, nan});
            stored.functions.clear();
            stored.function_points.clear();
        }
        stored.step_error.shape = {stored.steps.size(), stored.channels.size()};
        stored.step_error.values.resize(stored.steps.size() * stored.channels.size(),
                                        nan);
    }

    ModelHours hours_in_period(const study::Period& period) const {
        const LoopData& data = around_.written;
        ModelHours hours;
        for (std::size_t m = 0; m < StoredLoop::n_models; ++m) {
            auto& channels = hours.models.emplace_back();
            for (const auto& channel : run_of(m).hours)
                channels.push_back(study::hours_in(data.building, period, channel));
        }
        hours.outdoors = outdoors_of(*data.drive_over(period));
        return hours;
    }

    StoredSimulator simulator() const {
        StoredSimulator stored;
        const auto& parameters = around_.simulator.parameters();
        std::vector<std::vector<double>> at;  // [models][parameters]
        at.reserve(StoredLoop::n_models);
        for (std::size_t m = 0; m < StoredLoop::n_models; ++m)
            at.push_back(study::values_at(run_of(m).point, parameters));
        stored.parameters.reserve(parameters.size());
        for (std::size_t k = 0; k < parameters.size(); ++k)
            stored.parameters.push_back(
                {parameters[k].name, parameters[k].unit, parameters[k].least,
                 parameters[k].most, at[StoredLoop::plain][k], at[StoredLoop::before][k],
                 at[StoredLoop::after][k]});
        add_given(around_.effects, scales(), stored);
        add_left_out(stored);
        add_runs(stored);
        add_channels(stored);
        return stored;
    }

    /// Of the effects tried; 0 of all where the nearest run has none.
    std::vector<double> scales() const {
        std::vector<double> scales = run_of(StoredLoop::after).scales;
        scales.resize(around_.effects.size(), 0.0);
        return scales;
    }

    void add_left_out(StoredSimulator& stored) const {
        std::vector<std::string> told;
        for (const SimulatorRun& run : around_.runs)
            for (const std::string& why : run.left_out)
                if (std::ranges::find(told, why) == told.end()) told.push_back(why);
        for (std::string& why : told) stored.left_out.push_back({std::move(why)});
    }

    void add_runs(StoredSimulator& stored) const {
        const double least = so_far_.least_deviance(around_.kept);
        for (std::size_t k = 0; k < around_.runs.size(); ++k) {
            const bool failed = std::isinf(so_far_.deviance_at(k));
            stored.runs.push_back(
                {around_.runs_are_of[k], around_.runs[k].failure,
                 failed ? nan : so_far_.deviance_at(k) - least,
                 study::years_of_run(around_.written.building.periods, around_.runs[k])});
        }
    }

    void add_channels(StoredSimulator& stored) const {
        if (!so_far_.are_enough()) return;
        const auto errors = so_far_.emulator_error(around_.kept);
        for (std::size_t c = 0; c < errors.size(); ++c)
            stored.channels.push_back(
                {around_.written.building.meters[around_.written.meters[c]].name,
                 errors[c]});
    }

    std::vector<study::Failure> failures_of_runs() const {
        std::vector<study::Failure> failures;
        for (std::size_t k = 0; k < around_.runs.size(); ++k)
            if (!around_.runs[k].failure.empty())
                failures.push_back({static_cast<long long>(k), around_.runs[k].failure});
        return failures;
    }

    const Around& around_;
    const RunsSoFar& so_far_;
    std::vector<SimulatorRun> reported_;  ///< [StoredLoop::Model] with all periods
    bool has_runs_ = false;
};

}  // namespace

study::Conclusion conclude_search(const std::string& stage, const LoopData& written,
                                  const LoopData& data, const LoopResult& result) {
    StoredLoop stored = without_predictions(stage, written, data, result);
    stored.job_parts.clear();
    study::Conclusion all;
    all.datasets = datasets_of(stage, stored, {});
    std::ranges::move(datasets_of(given_group, given_effects(data, result)),
                      std::back_inserter(all.datasets));
    return all;
}

study::Conclusion conclude_around(const Around& around) {
    return Concluder(around).conclude();
}

}  // namespace bemcal::loop
