/// Writes what the loop found: parameters, structures, steps, effects with 90 %
/// intervals, power, decisions, and what plain, before and after predict for every hour
/// of every period.
/// Follows from `LoopResult`; intervals reach 1.645 times `deviation_of` to each side.
/// The page is made by the report's script. The noise floor is not known here: it is NaN.
#include "loop/results.hpp"

#include "base/machine.hpp"
#include "effects/catalogue.hpp"
#include "loop/intervals.hpp"
#include "loop/late_clock.hpp"
#include "loop/loads.hpp"
#include "stats/metrics.hpp"
#include "study/datasets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double half_of_90 = 1.645;
const std::vector<std::string> model_names = {"plain", "before", "after"};

using Standings = std::array<const Standing*, 3>;

Standings standings_of(const LoopResult& result) {
    return {&result.baseline.plain, &result.baseline.chosen, &result.last};
}

/// A model's predictions of every hour of a period. [channels x hours]
std::vector<std::vector<double>> hours_of(
    const LoopData& data, const Baseline& baseline, const Standing& standing,
    const std::shared_ptr<const physics::Drive>& drive) {
    Place place = make_place(data, standing.model.structure, drive);
    if (!standing.model.effects.empty())
        know_loads(place, baseline.chosen, baseline.place.surroundings->model);
    for (kernel::Channel& channel : place.channels)
        channel.interval = physics::Interval::hourly;
    const BuiltModel built = build(place, standing.model.effects);
    Matrix point(1, built.unknowns.size());
    for (std::size_t k = 0; k < point.cols; ++k)
        point(0, k) = built.unknowns[k].within(standing.fit.at.x[k]);
    const Matrix predicted = built.fit_model->predict(point);
    std::vector<std::vector<double>> hours;
    const auto& first = built.fit_model->first();
    for (std::size_t c = 0; c + 1 < first.size(); ++c)
        hours.emplace_back(predicted.values.begin() + static_cast<long>(first[c]),
                           predicted.values.begin() + static_cast<long>(first[c + 1]));
    return hours;
}

/// Sums (means of a temperature) of the hours by calendar month, of those with a reading.
struct Months {
    std::vector<double> simulated, measured;
};

Months months_of(const std::vector<physics::Seconds>& begins,
                 std::span<const double> simulated, std::span<const double> measured,
                 bool is_mean) {
    std::map<std::pair<int, int>, std::array<double, 3>> sums;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        if (std::isnan(measured[k])) continue;
        const auto step = physics::calendar_step(begins[k]);
        auto& [s, m, n] = sums[{step.year, step.month}];
        s += simulated[k], m += measured[k], n += 1;
    }
    Months months;
    for (const auto& [month, sum] : sums) {
        const double by = is_mean ? sum[2] : 1;
        months.simulated.push_back(sum[0] / by);
        months.measured.push_back(sum[1] / by);
    }
    return months;
}

/// The same of a meter that is not read by the hour: the hours of its intervals, then the
/// months of these.
Months read_by_month(const std::vector<physics::Seconds>& begins,
                     std::span<const double> simulated, const kernel::Readings& readings,
                     const physics::TimeAxis& axis) {
    const auto intervals = study::begins_of(axis, readings.interval);
    std::vector<double> sums(intervals.size(), 0.0), hours(intervals.size(), 0.0);
    std::size_t at = 0;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        while (at + 1 < intervals.size() && intervals[at + 1] <= begins[k]) ++at;
        sums[at] += simulated[k];
        hours[at] += 1;
    }
    const bool is_mean = physics::is_temperature(readings.quantity);
    for (std::size_t k = 0; k < sums.size() && is_mean; ++k) sums[k] /= hours[k];
    return months_of(intervals, sums, readings.values, is_mean);
}

/// Mean outdoor temperature of each hour of the drive's period.
std::vector<double> outdoors_of(const physics::Drive& drive) {
    const auto per_hour = static_cast<std::size_t>(3600 / drive.axis.step_s);
    std::vector<double> hours;
    hours.reserve(drive.theta_e.size() / per_hour);
    for (auto k = static_cast<std::size_t>(drive.n_warm_up);
         k + per_hour <= drive.theta_e.size(); k += per_hour) {
        double sum = 0;
        for (std::size_t s = 0; s < per_hour; ++s) sum += drive.theta_e[k + s];
        hours.push_back(sum / static_cast<double>(per_hour));
    }
    return hours;
}

void push(std::vector<double>& to, const stats::FitMetrics& metrics) {
    to.insert(to.end(), {metrics.n, metrics.cv_rmse, metrics.nmbe, metrics.rmse});
}

class Writer {
  public:
    Writer(const std::string& stage, const LoopData& data, const LoopResult& result)
        : data_(data),
          result_(result),
          decisions_(data.building.decisions),
          out_(stage),
          channels_(data.meters.size()) {
        summary_.study = stage;
        summary_.has_page = true;
    }

    study::Conclusion write() {
        names();
        parameters();
        tables();
        effects_found();
        power();
        fits();
        decisions();
        return {out_.take(), {std::move(summary_)}};
    }

  private:
    void names() {
        std::vector<std::string> names, units, periods;
        for (const std::size_t m : data_.meters) {
            names.push_back(data_.building.meters[m].name);
            units.emplace_back(physics::unit_of(data_.building.meters[m].quantity));
        }
        for (const study::Period& period : data_.building.periods)
            periods.push_back(period.name);
        channel_names_ = names;
        out_.texts("channel", "channel", names);
        out_.texts("channel_unit", "channel", units);
        out_.texts("model", "model", model_names);
        out_.texts("period", "period", periods);
        out_.texts("resolution", "resolution", {"hourly", "monthly"});
        out_.texts("metric", "metric", {"n", "cv_rmse", "nmbe", "rmse"});
    }

    void parameters() {
        const auto& unknowns = result_.last.built.unknowns;
        const std::size_t n = result_.last.built.first_effect();
        std::vector<std::string> names, units;
        std::vector<double> mean, sd;
        std::map<std::string, std::size_t> index;
        for (std::size_t k = 0; k < n; ++k) {
            index[unknowns[k].name] = k;
            names.push_back(unknowns[k].name);
            units.push_back(unknowns[k].unit);
            mean.push_back(unknowns[k].has_prior ? unknowns[k].centre : nan);
            sd.push_back(unknowns[k].has_prior ? unknowns[k].scale : nan);
        }
        std::vector<double> values(3 * n, nan), deviation(3 * n, nan);
        const Standings standings = standings_of(result_);
        for (std::size_t m = 0; m < 3; ++m) {
            const auto sds = deviations_of(data_, *standings[m], result_.misfit);
            const auto& own = standings[m]->built.unknowns;
            for (std::size_t k = 0; k < standings[m]->built.first_effect(); ++k) {
                const std::size_t at = m * n + index.at(own[k].name);
                values[at] = own[k].value(standings[m]->fit.at.x[k]);
                deviation[at] = sds[k];
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            const double value = values[2 * n + k];
            const double half = half_of_90 * deviation[2 * n + k];
            summary_.values.push_back({names[k], value, value - half, value + half});
        }
        out_.texts("parameter", "parameter", names);
        out_.texts("parameter_unit", "parameter", units);
        out_.vector("parameter_prior_mean", "parameter", mean);
        out_.vector("parameter_prior_sd", "parameter", sd);
        out_.array("parameter_value", {"model", "parameter"}, {3, n}, values);
        out_.array("parameter_sd", {"model", "parameter"}, {3, n}, deviation);
    }

    void tables() {
        std::vector<std::string> structures;
        std::vector<double> scores;
        for (const TriedStructure& tried : result_.baseline.tried) {
            structures.push_back(tried.name);
            scores.push_back(tried.score);
        }
        out_.texts("structure", "structure", structures);
        out_.vector("structure_score", "structure", scores);
        out_.scalar("misfit", result_.misfit);
        out_.kind("loop");
        out_.text("structure_chosen", name_of(result_.baseline.chosen.model.structure));
        steps();
        localisation();
        std::vector<double> share;
        std::vector<std::string> where;
        for (const Unexplained& one : result_.unexplained) {
            share.push_back(one.share);
            where.push_back(one.where);
        }
        out_.vector("unexplained", "channel", share);
        out_.texts("unexplained_where", "channel", where);
        out_.vector("noise_floor", "channel", std::vector<double>(channels_, nan));
    }

    void decisions() {
        std::vector<std::string> series, finding, action;
        for (const study::DataDecision& decision : decisions_) {
            series.push_back(decision.series);
            finding.push_back(decision.finding);
            action.push_back(decision.action);
        }
        out_.texts("decision_series", "decision", series);
        out_.texts("decision_finding", "decision", finding);
        out_.texts("decision_action", "decision", action);
    }

    void steps() {
        std::vector<std::string> effect, verdict;
        std::vector<double> gain, threshold, score, error;
        for (const LoggedStep& step : result_.log) {
            effect.push_back(step.effect);
            verdict.push_back(step.verdict);
            gain.push_back(step.gain);
            threshold.push_back(step.threshold);
            score.push_back(step.score);
            for (std::size_t c = 0; c < channels_; ++c)
                error.push_back(c < step.error.size() ? step.error[c] : nan);
        }
        out_.texts("step_effect", "step", effect);
        out_.texts("step_verdict", "step", verdict);
        out_.vector("step_gain", "step", gain);
        out_.vector("step_threshold", "step", threshold);
        out_.vector("step_score", "step", score);
        out_.array("step_error", {"step", "channel"}, {result_.log.size(), channels_},
                   error);
        std::vector<std::string> names;
        std::vector<double> gains;
        for (const auto& [name, value] : result_.candidates) {
            names.push_back(name);
            gains.push_back(value);
        }
        out_.texts("candidate", "candidate", names);
        out_.vector("candidate_gain", "candidate", gains);
    }

    void localisation() {
        const Localisation& before = result_.before;
        out_.texts("hook", "hook", before.hooks);
        out_.texts("driver", "driver", before.drivers);
        const std::vector<std::size_t> shape = {before.hooks.size(),
                                                before.drivers.size()};
        out_.array("localisation", {"hook", "driver"}, shape, before.statistic.values);
        out_.array("localisation_after", {"hook", "driver"}, shape,
                   result_.after.statistic.values);
    }

    void effects_found() {
        std::vector<std::string> name, hook, driver, shape, gate, unit, members,
            separates, doubt;
        std::vector<double> value, least, most, gain, adequate;
        const Standing& last = result_.last;
        const auto sds = deviations_of(data_, last, result_.misfit);
        for (std::size_t k = 0; k < last.model.effects.size(); ++k) {
            const effects::Effect& effect = last.model.effects[k];
            const std::size_t at = last.built.first_effect() + k;
            const double c = last.coefficient(k);
            const double half = half_of_90 * deviation_of(result_.found[k], sds[at], c);
            name.push_back(effect.name);
            hook.emplace_back(effects::name_of(effect.hook));
            driver.emplace_back(effects::name_of(effect.driver));
            shape.push_back(effects::sentence_of(effect));
            gate.emplace_back(effects::name_of(effect.gate));
            unit.push_back(effects::unit_of(effect));
            const effects::Entry* entry = effects::entry_of(effect);
            separates.emplace_back(entry == nullptr ? "" : entry->separates);
            members.push_back(result_.found[k].equivalents);
            value.push_back(c);
            least.push_back(c - half);
            most.push_back(c + half);
            gain.push_back(result_.found[k].gain);
            doubt.push_back(result_.found[k].doubt);
            adequate.push_back(doubt.back().empty() ? 1 : 0);
            summary_.findings.push_back(
                {"loop", fmt::format("found: {}, {:.3g} {}", name.back(), c, unit.back()),
                 doubt.back().empty() ? "accepted" : "accepted, not adequate"});
        }
        out_.texts("effect", "effect", name);
        out_.texts("effect_hook", "effect", hook);
        out_.texts("effect_driver", "effect", driver);
        out_.texts("effect_shape", "effect", shape);
        out_.texts("effect_gate", "effect", gate);
        out_.texts("effect_unit", "effect", unit);
        out_.texts("effect_class", "effect", members);
        out_.texts("effect_separates", "effect", separates);
        out_.vector("effect_coefficient", "effect", value);
        out_.vector("effect_least", "effect", least);
        out_.vector("effect_most", "effect", most);
        out_.vector("effect_gain", "effect", gain);
        out_.vector("effect_adequate", "effect", adequate);
        out_.texts("effect_doubt", "effect", doubt);
    }

    void power() {
        std::vector<std::string> name, alias, parameter;
        std::vector<double> detectability, visibility, correlation, bias;
        for (const Power& row : result_.power.rows) {
            name.push_back(row.name);
            alias.push_back(row.alias);
            parameter.push_back(row.parameter);
            detectability.push_back(row.detectability);
            visibility.push_back(row.visibility);
            correlation.push_back(row.correlation);
            bias.push_back(row.bias);
            state_class(row);
        }
        out_.texts("power_effect", "power", name);
        out_.texts("power_alias", "power", alias);
        out_.texts("power_bias_parameter", "power", parameter);
        out_.vector("power_detectability", "power", detectability);
        out_.vector("power_visibility", "power", visibility);
        out_.vector("power_alias_correlation", "power", correlation);
        out_.vector("power_bias", "power", bias);
    }

    /// Itself, at the same meter where it is at one, or as a name of what was found.
    bool is_found(const effects::Effect& effect) const {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const effects::Effect& own = result_.last.model.effects[k];
            const std::string names = "; " + result_.found[k].equivalents + ";";
            const bool is_elsewhere =
                own.name == effect.name && !are_of_one_row(own, effect);
            if (!is_elsewhere &&
                names.find("; " + effect.name + ";") != std::string::npos)
                return true;
        }
        return false;
    }

    /// What readings cannot tell from what is calibrated is no finding, but is said: of
    /// what is the same always, of the rest where it could be seen at all.
    void state_class(const Power& row) {
        if (is_found(row.effect) || !is_in_parameters(row)) return;
        const std::string same = effects::same_as(row.effect);
        if (!same.empty())
            decisions_.push_back({row.name, "one class with " + same,
                                  "cannot be told apart: what the readings say of both "
                                  "stands in the calibrated parameters"});
        else if (can_be_seen(row))
            decisions_.push_back(
                {row.name,
                 "one class with " + row.parameter + " and what else is calibrated",
                 "told apart only where it is large: else what the "
                 "readings say of both stands in the parameters"});
    }

    void fits() {
        const auto& periods = data_.building.periods;
        std::vector<double> all(3 * periods.size() * 2 * channels_ * 4, nan);
        for (std::size_t p = 0; p < periods.size(); ++p) fits_of(p, all);
        out_.array("fit", {"model", "period", "resolution", "channel", "metric"},
                   {3, periods.size(), 2, channels_, 4}, all);
    }

    void fits_of(std::size_t p, std::vector<double>& all) {
        const study::Period& period = data_.building.periods[p];
        const auto drive = data_.drive_over(period);
        const physics::TimeAxis axis = study::axis_of(data_.building, period);
        const auto begins = study::begins_of(axis, physics::Interval::hourly);
        std::vector<std::vector<std::vector<double>>> hours;
        hours.reserve(3);
        for (std::size_t m = 0; m < 3; ++m)
            hours.push_back(predicted(m, period, drive, begins.size()));
        const auto readings = study::readings_of(data_.building, period);
        out_.times(period.name + "/time", begins);
        out_.vector(period.name + "/outdoor_temperature", "time",
                    by_late_clock_throughout(outdoors_of(*drive), result_.hours_late));
        for (std::size_t c = 0; c < channels_; ++c) {
            const kernel::Readings& meter = readings[data_.meters[c]];
            const bool is_hourly = meter.values.size() == begins.size();
            const std::vector<double> measured =
                is_hourly ? meter.values : std::vector<double>(begins.size(), nan);
            std::vector<double> simulated;
            study::FoundFit found{p, data_.meters[c]};
            for (std::size_t m = 0; m < 3; ++m) {
                const auto& own = hours[m][c];
                const auto stamped = by_late_clock_throughout(own, result_.hours_late);
                simulated.insert(simulated.end(), stamped.begin(), stamped.end());
                const bool is_mean = physics::is_temperature(meter.quantity);
                const Months months = is_hourly
                                          ? months_of(begins, own, measured, is_mean)
                                          : read_by_month(begins, own, meter, axis);
                std::vector<double> metrics;
                const stats::FitMetrics hourly = stats::metrics_of(own, measured);
                if (m == 0) found.before = hourly.cv_rmse;
                if (m == 2) found.cv_rmse = hourly.cv_rmse, found.nmbe = hourly.nmbe;
                push(metrics, hourly);
                push(metrics, stats::metrics_of(months.simulated, months.measured));
                for (std::size_t r = 0; r < 2; ++r)
                    for (std::size_t k = 0; k < 4; ++k)
                        all[(((m * data_.building.periods.size() + p) * 2 + r) *
                                 channels_ +
                             c) *
                                4 +
                            k] = metrics[4 * r + k];
            }
            summary_.fits.push_back(found);
            const std::string folder = period.name + "/" + channel_names_[c] + "/";
            out_.vector(folder + "measured", "time",
                        by_late_clock(measured, result_.hours_late));
            out_.array(folder + "simulated", {"model", "time"}, {3, begins.size()},
                       std::move(simulated));
        }
    }

    /// A model's hours of a period; NaN where it follows something that is missing there,
    /// which a decision then says.
    std::vector<std::vector<double>> predicted(
        std::size_t model, const study::Period& period,
        const std::shared_ptr<const physics::Drive>& drive, std::size_t n_hours) {
        try {
            return hours_of(data_, result_.baseline, *standings_of(result_)[model],
                            drive);
        } catch (const std::exception& error) {
            rethrow_of_machine(error);
            decisions_.push_back({"period " + period.name, error.what(),
                                  "not predicted by '" + model_names[model] + "'"});
            return {channels_, std::vector<double>(n_hours, nan)};
        }
    }

    const LoopData& data_;
    const LoopResult& result_;
    std::vector<study::DataDecision>
        decisions_;  ///< of the data, of effects, then of periods
    study::DatasetBuilder out_;
    study::Summary summary_;
    std::size_t channels_;
    std::vector<std::string> channel_names_;
};

}  // namespace

study::Conclusion conclude_loop(const std::string& stage, const LoopData& data,
                                const LoopResult& result) {
    return Writer(stage, data, result).write();
}

}  // namespace bemcal::loop
