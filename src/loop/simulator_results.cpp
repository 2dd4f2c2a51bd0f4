/// Puts the program's runs in the place of a model's predictions.
/// Follows from `FitsWriter`; intervals are those of what the last best run leaves in
/// training, of which a dozen parameters have seen thousands of hours.
/// Sections for a job are left out: what was found belongs into the program's model.
#include "loop/simulator_results.hpp"

#include "loop/given_effects.hpp"
#include "loop/simulator_plan.hpp"
#include "loop/simulator_readings.hpp"
#include "loop/stored_fits.hpp"
#include "loop/stored_simulator.hpp"
#include "study/datasets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::loop {
namespace {

/// Which runs are plain, before and after; nothing where none succeeded.
using Chosen = std::array<std::optional<std::size_t>, StoredLoop::n_models>;

std::string hooks_of(const study::GivenEffect& effect) {
    std::vector<std::string> hooks;
    for (const effects::HookSeries& at : effect.at)
        if (std::ranges::find(hooks, at.hook) == hooks.end()) hooks.push_back(at.hook);
    return fmt::format("{}", fmt::join(hooks, ", "));
}

constexpr const char* no_help =
    "left: the program's own runs are no nearer to the readings with it";

class Concluder {
  public:
    explicit Concluder(const Around& around)
        : around_(around), so_far_(around.written, around.runs, around.kept) {
        const bool has_plain = around.runs[0].failure.empty();
        chosen_[StoredLoop::plain] =
            has_plain ? std::optional<std::size_t>(0) : so_far_.best(false);
        chosen_[StoredLoop::before] = so_far_.best(false);
        chosen_[StoredLoop::after] = so_far_.best(true);
    }

    study::Conclusion conclude() {
        study::Conclusion all;
        if (!around_.searched.datasets.empty() && chosen_[StoredLoop::before])
            with_search(all);
        std::ranges::move(datasets_of(around_.stage, simulator()),
                          std::back_inserter(all.datasets));
        study::DatasetBuilder failures(around_.stage);
        failures.failures(failures_of_runs());
        std::ranges::move(failures.take(), std::back_inserter(all.datasets));
        return all;
    }

  private:
    const SimulatorRun& run_of(std::size_t model) const {
        return around_.runs[chosen_[model].value_or(0)];
    }

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
        all.datasets = datasets_of(around_.stage, stored, periods);
    }

    bool is_kept(std::size_t effect) const {
        return effect < around_.kept.size() && around_.kept[effect] != 0;
    }

    /// Effects and functions without which the program is as near to the readings are no
    /// findings; the log of the search says so. Coefficients are those that were given.
    void leave_what_does_not_help(StoredLoop& stored) const {
        const std::size_t n = stored.effects.size();
        const SimulatorRun& after = run_of(StoredLoop::after);
        const auto of_index = [](double index) {
            return static_cast<std::size_t>(index);
        };
        std::vector<double> new_index(n, nan);
        std::vector<StoredLoop::Effect> kept;
        for (std::size_t k = 0; k < n; ++k) {
            StoredLoop::Effect& effect = stored.effects[k];
            if (!is_kept(k)) {
                stored.steps.push_back({effect.name, no_help, effect.gain, nan, nan});
                continue;
            }
            new_index[k] = static_cast<double>(kept.size());
            effect.section.clear();  // it is the program's model that is to have it
            const double scale = k < after.scales.size() ? after.scales[k] : 1;
            for (double* number : {&effect.coefficient, &effect.least, &effect.most})
                *number *= scale;
            kept.push_back(std::move(effect));
        }
        stored.effects = std::move(kept);
        std::erase_if(stored.effect_values, [&](const StoredLoop::EffectValue& value) {
            return std::isnan(new_index[of_index(value.effect)]);
        });
        for (StoredLoop::EffectValue& value : stored.effect_values)
            value.effect = new_index[of_index(value.effect)];
        if (!stored.functions.empty() && !is_kept(n)) {
            stored.steps.push_back({"functions", no_help, nan, nan, nan});
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
                channels.push_back(hours_in(data.building, period, channel));
        }
        hours.outdoors = outdoors_of(*data.drive_over(period));
        return hours;
    }

    StoredSimulator simulator() const {
        StoredSimulator stored;
        const auto& parameters = around_.simulator.parameters();
        for (std::size_t k = 0; k < parameters.size(); ++k) {
            const physics::Parameter& own = parameters[k];
            const auto at = [&](std::size_t model) {
                return own.least + run_of(model).point[k] * (own.most - own.least);
            };
            stored.parameters.push_back({own.name, own.unit, own.least, own.most,
                                         at(StoredLoop::plain), at(StoredLoop::before),
                                         at(StoredLoop::after)});
        }
        add_given(stored);
        add_runs(stored);
        add_channels(stored);
        return stored;
    }

    void add_given(StoredSimulator& stored) const {
        const auto given = effects_in(around_.searched.datasets, given_group);
        const SimulatorRun& after = run_of(StoredLoop::after);
        for (std::size_t k = 0; k < given.size(); ++k)
            stored.given.push_back({given[k].name, hooks_of(given[k]),
                                    k < after.scales.size() ? after.scales[k] : 0});
        add_series(scaled(given, after.scales), stored);
        std::vector<std::string> told;
        for (const SimulatorRun& run : around_.runs)
            for (const std::string& why : run.left_out)
                if (std::ranges::find(told, why) == told.end()) told.push_back(why);
        for (std::string& why : told) stored.left_out.push_back({std::move(why)});
    }

    static void add_series(const std::vector<study::GivenEffect>& given,
                           StoredSimulator& stored) {
        auto& all = stored.series_value.values;
        for (const study::GivenEffect& effect : given)
            for (const effects::HookSeries& at : effect.at) {
                stored.series.push_back({effect.name, at.hook, at.unit,
                                         at.is_factor ? "factor" : "add", at.facade,
                                         at.meter});
                all.insert(all.end(), at.values.begin(), at.values.end());
            }
        const std::size_t n = stored.series.size();
        stored.series_value.shape = {n, n > 0 ? all.size() / n : 0};
    }

    void add_runs(StoredSimulator& stored) const {
        const auto best = so_far_.best(true);
        for (std::size_t k = 0; k < around_.runs.size(); ++k) {
            const bool failed = !around_.runs[k].failure.empty();
            stored.runs.push_back(
                {around_.runs_are_of[k], around_.runs[k].failure,
                 failed || !best ? nan
                                 : so_far_.deviance_at(k) - so_far_.deviance_at(*best)});
        }
    }

    void add_channels(StoredSimulator& stored) const {
        if (!so_far_.are_enough()) return;
        const auto errors = so_far_.emulator_error();
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
    RunsSoFar so_far_;
    Chosen chosen_;
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
