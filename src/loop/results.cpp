/// Makes what is stored of a loop: parameters, structures, steps, effects with 90 %
/// intervals, power, decisions, what plain, before and after predict for every hour of
/// every period; and in short what it found.
/// Follows from `LoopResult`; intervals reach 1.645 times `deviation_of` to each side.
/// The page is made by the report's script.
#include "loop/results.hpp"

#include "base/error.hpp"
#include "base/machine.hpp"
#include "effects/catalogue.hpp"
#include "effects/job_section.hpp"
#include "loop/effect_values.hpp"
#include "loop/find_functions.hpp"
#include "loop/intervals.hpp"
#include "loop/job_parts.hpp"
#include "loop/late_clock.hpp"
#include "loop/level_change.hpp"
#include "loop/loads.hpp"
#include "loop/months.hpp"
#include "loop/next_measurements.hpp"
#include "loop/reading_bands.hpp"
#include "loop/stored_loop.hpp"
#include "loop/unusual_end.hpp"
#include "physics/simulate.hpp"
#include "stats/distributions.hpp"
#include "stats/metrics.hpp"
#include "study/bias.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::loop {
namespace {

/// In the order of the stored models.
using Standings = std::array<const Standing*, StoredLoop::n_models>;

Standings standings_of(const LoopResult& result) {
    return {&result.baseline.plain, &result.baseline.chosen, &result.last};
}

/// Throws what the plain simulation says of a point that is impossible.
void say_why_impossible(const BuiltModel& built, const std::vector<double>& values) {
    physics::simulate(building_at(built, values), built.placed->drive);
    throw CannotSimulate("the model cannot be simulated there");
}

/// A model's predictions of every hour of a period. [channels x hours]
std::vector<std::vector<double>> hours_of(
    const LoopData& data, const Baseline& baseline, const Standing& standing,
    const std::vector<FoundFunction>& functions,
    const std::shared_ptr<const physics::Drive>& drive) {
    Place place = make_place(data, standing.model.structure, drive);
    if (!standing.model.effects.empty())
        know_loads(place, baseline.chosen, baseline.place.surroundings->model);
    if (!functions.empty())
        add_columns(functions, effects::function_drivers(surroundings_of(place)), place);
    for (kernel::Channel& channel : place.channels)
        channel.interval = physics::Interval::hourly;
    const BuiltModel built = build(place, standing.model.effects);
    Matrix point(1, built.unknowns.size());
    for (std::size_t k = 0; k < point.cols; ++k)
        point(0, k) = built.unknowns[k].within(standing.fit.at.x[k]);
    const Matrix predicted = built.fit_model->predict(point);
    if (std::isnan(predicted(0, 0))) say_why_impossible(built, point.values);
    std::vector<std::vector<double>> hours;
    const auto& first = built.fit_model->first();
    for (std::size_t c = 0; c + 1 < first.size(); ++c)
        hours.emplace_back(predicted.values.begin() + static_cast<long>(first[c]),
                           predicted.values.begin() + static_cast<long>(first[c + 1]));
    return hours;
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

/// Fills what is stored, part by part.
class Writer {
  public:
    Writer(const std::string& stage, const LoopData& written, const LoopData& data,
           const LoopResult& result)
        : stage_(stage),
          written_(written),
          data_(data),
          result_(result),
          deviations_(deviations_of(data, result.last, result.misfit)),
          decisions_(data.building.decisions) {}

    study::Conclusion write() {
        names();
        parameters();
        structures();
        steps();
        localisation();
        effects_found();
        functions_found();
        hours_learned();
        job_parts();
        power();
        measurements();
        unusual_ends();
        fits();
        decisions();
        return {datasets_of(stage_, loop_, periods_), {summary()}};
    }

  private:
    void names() {
        for (std::size_t c = 0; c < data_.meters.size(); ++c) {
            const study::Meter& meter = data_.building.meters[data_.meters[c]];
            const Unexplained left =
                c < result_.unexplained.size() ? result_.unexplained[c] : Unexplained{};
            loop_.channels.push_back({meter.name,
                                      std::string(physics::unit_of(meter.quantity)),
                                      left.where, left.share});
        }
        for (const study::Period& period : data_.building.periods)
            loop_.periods.push_back(period.name);
        loop_.models = {"plain", "before", "after"};
        loop_.resolutions = {"hourly", "monthly"};
        loop_.metrics = {"n", "cv_rmse", "nmbe", "rmse"};
        loop_.misfit = result_.misfit;
    }

    void parameters() {
        const auto& unknowns = result_.last.built.unknowns;
        const std::size_t n = result_.last.built.first_effect();
        std::map<std::string, std::size_t> index;
        for (std::size_t k = 0; k < n; ++k) {
            index[unknowns[k].name] = k;
            loop_.parameters.push_back({unknowns[k].name, unknowns[k].unit});
            if (!unknowns[k].has_prior) continue;
            loop_.parameters.back().prior_mean = unknowns[k].centre;
            loop_.parameters.back().prior_sd = unknowns[k].scale;
        }
        loop_.parameter_value.resize({StoredLoop::n_models, n});
        loop_.parameter_sd.resize({StoredLoop::n_models, n});
        const Standings standings = standings_of(result_);
        for (std::size_t m = 0; m < standings.size(); ++m) {
            const auto sds = m == StoredLoop::after
                                 ? deviations_
                                 : deviations_of(data_, *standings[m], result_.misfit);
            const auto& own = standings[m]->built.unknowns;
            for (std::size_t k = 0; k < standings[m]->built.first_effect(); ++k) {
                const std::size_t at = index.at(own[k].name);
                loop_.parameter_value.set({m, at},
                                          own[k].value(standings[m]->fit.at.x[k]));
                loop_.parameter_sd.set({m, at}, sds[k]);
            }
        }
    }

    void structures() {
        for (const TriedStructure& tried : result_.baseline.tried)
            loop_.structures.push_back({tried.name, tried.score});
        loop_.structure_chosen = effects::name_of(
            whole_structure(data_, result_.baseline.chosen.model.structure));
    }

    void steps() {
        loop_.step_error.resize({result_.log.size(), n_channels()});
        for (std::size_t k = 0; k < result_.log.size(); ++k) {
            const LoggedStep& step = result_.log[k];
            loop_.steps.push_back(
                {step.effect, step.verdict, step.gain, step.threshold, step.score});
            for (std::size_t c = 0; c < step.error.size(); ++c)
                loop_.step_error.set({k, c}, step.error[c]);
        }
        for (const auto& [name, gain] : result_.candidates)
            loop_.candidates.push_back({name, gain});
    }

    void localisation() {
        const Localisation& seen = result_.before;
        loop_.hooks = seen.hooks;
        loop_.drivers = seen.drivers;
        const std::vector<std::size_t> shape{seen.hooks.size(), seen.drivers.size()};
        loop_.localisation.shape = loop_.localisation_after.shape = shape;
        loop_.localisation.values = seen.statistic.values;
        loop_.localisation_after.values = result_.after.statistic.values;
    }

    void effects_found() {
        const Standing& last = result_.last;
        for (std::size_t k = 0; k < result_.found.size(); ++k)
            effect_found(k, deviations_[last.built.first_effect() + k]);
        effect_values();
    }

    void effect_values() {
        const Standing& last = result_.last;
        std::vector<double> sds = deviations_;
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            double& sd = sds[last.built.first_effect() + k];
            if (!last.model.effects[k].other_hours)
                sd = deviation_of(result_.found[k], sd, last.coefficient(k));
        }
        const auto accounts = accounts_of(data_);
        const auto worth =
            worth_of_effects(data_, result_.baseline.place, last, result_.found.size(),
                             sds, result_.misfit, accounts);
        for (std::size_t k = 0; k < worth.size(); ++k)
            for (std::size_t a = 0; a < accounts.size(); ++a)
                loop_.effect_values.push_back({static_cast<double>(k), accounts[a].of,
                                               accounts[a].unit, worth[k][a].mean,
                                               worth[k][a].least, worth[k][a].most});
    }

    void effect_found(std::size_t k, double sd) {
        const effects::Effect& effect = result_.last.model.effects[k];
        const Found& found = result_.found[k];
        const double c = result_.last.coefficient(k);
        const double half =
            effect.other_hours ? 0 : stats::z_90_two_sided * deviation_of(found, sd, c);
        const effects::Entry* entry = effects::entry_of(effect);
        StoredLoop::Effect& stored = loop_.effects.emplace_back();
        stored.name = effect.name;
        stored.hook = effects::name_of(effect.hook);
        stored.driver = effects::name_of(effect.driver);
        stored.shape = effects::sentence_of(effect);
        stored.gate = effects::name_of(effect.gate);
        stored.unit = effects::unit_of(effect);
        stored.members = found.equivalents;
        stored.class_in_words = fmt::format("{}", fmt::join(found.equivalents, "; "));
        stored.separates = entry == nullptr ? "" : entry->separates;
        stored.doubt = found.doubt;
        stored.coefficient = c;
        stored.least = c - half;
        stored.most = c + half;
        stored.gain = found.gain;
        stored.adequate = found.doubt.empty() ? 1 : 0;
        stored.section = effects::job_section_of(
            effect, belief_of(k, {c, half / stats::z_90_two_sided}),
            data_.training().from);
    }

    /// An effect of one sign keeps it.
    effects::CoefficientBelief belief_of(std::size_t k,
                                         effects::CoefficientBelief belief) const {
        const effects::Effect& effect = result_.last.model.effects[k];
        const BuiltModel& built = result_.last.built;
        const auto& unknown = built.unknowns[built.first_effect() + k];
        belief.least = effect.least >= 0 ? 0 : unknown.least;
        belief.most = effect.most <= 0 ? 0 : unknown.most;
        return belief;
    }

    void functions_found() {
        for (const FoundFunction& function : result_.functions) {
            points_of(function, static_cast<double>(loop_.functions.size()));
            loop_.functions.push_back({name_of(function), function.at.name,
                                       function.basis.driver,
                                       effects::unit_of(function.at.hook),
                                       effects::unit_of_driver(function.basis.driver),
                                       function.size, function.evidence});
        }
    }

    void points_of(const FoundFunction& function, double index) {
        const auto points = function.basis.points.drivers_at();
        if (points.empty()) return;
        const std::vector<double> values = function.values();
        for (std::size_t p = 0; p < values.size(); ++p) {
            const double half =
                stats::z_90_two_sided * function.at.typical * function.deviations[p];
            loop_.function_points.push_back(
                {index, points[0][p], points.size() > 1 ? points[1][p] : nan, values[p],
                 values[p] - half, values[p] + half});
        }
    }

    void hours_learned() {
        for (const LearnedHours& learned : result_.hours) {
            for (std::size_t kind = 0; kind < learned.runs.size(); ++kind)
                loop_.hours.push_back(daily_hours(learned, kind));
            loop_.schedules.push_back(
                {learned.name, learned.use, sentence_of(learned), learned.evidence});
        }
    }

    StoredLoop::DailyHours daily_hours(const LearnedHours& learned,
                                       std::size_t kind) const {
        const LearnedRun& run = learned.runs[kind];
        StoredLoop::DailyHours stored;
        stored.schedule = static_cast<double>(loop_.schedules.size());
        stored.days = physics::name_of(static_cast<physics::DayKind>(kind));
        stored.from = run.run.from;
        stored.until = run.run.until;
        stored.usual_from = learned.usual[kind].from;
        stored.usual_until = learned.usual[kind].until;
        stored.from_least = run.least.from;
        stored.from_most = run.most.from;
        stored.until_least = run.least.until;
        stored.until_most = run.most.until;
        stored.probability = run.probability;
        return stored;
    }

    void job_parts() {
        loop_.job_parts = job_parts_of(data_, result_.baseline.place, result_.last,
                                       deviations_, result_.hours, result_.functions);
    }

    void power() {
        for (const Power& row : result_.power.rows) {
            loop_.seen.push_back({row.name, row.alias, name_of(row.alias_kind),
                                  row.parameter, row.detectability, row.visibility,
                                  row.correlation, row.bias});
            state_class(row);
        }
    }

    void measurements() {
        loop_.measurements = next_measurements(
            data_, result_.baseline.place, result_.last, result_.found, result_.misfit);
    }

    void unusual_ends() {
        const Standing& last = result_.last;
        for (std::size_t k = 0; k < last.built.first_effect(); ++k) {
            const study::FitUnknown& unknown = last.built.unknowns[k];
            std::string finding = unusual_end(unknown, last.fit.at.x[k]);
            if (!finding.empty())
                decisions_.push_back({unknown.name, std::move(finding),
                                      "may stand for what the description lacks",
                                      study::DecisionKind::parameter});
        }
    }

    /// Itself, at the same meter where it is at one, or as a name of what was found.
    bool is_found(const effects::Effect& effect) const {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const effects::Effect& own = result_.last.model.effects[k];
            const auto& names = result_.found[k].equivalents;
            const bool is_elsewhere =
                own.name == effect.name && !are_of_one_row(own, effect);
            if (!is_elsewhere && std::ranges::find(names, effect.name) != names.end())
                return true;
        }
        return false;
    }

    /// What readings cannot tell from what is calibrated is no finding, but is said: of
    /// what is the same always, of the rest where it could be seen at all.
    void state_class(const Power& row) {
        if (is_found(row.effect) || !is_in_parameters(row)) return;
        if (row.alias_kind == AliasKind::same)
            decisions_.push_back({row.name, "one class with " + row.alias,
                                  "cannot be told apart: what the readings say of both "
                                  "stands in the calibrated parameters",
                                  study::DecisionKind::one_class});
        else if (can_be_seen(row))
            decisions_.push_back(
                {row.name,
                 "one class with " + row.parameter + " and what else is calibrated",
                 "told apart only where it is large: else what the "
                 "readings say of both stands in the parameters",
                 study::DecisionKind::one_class});
    }

    void fits() {
        const auto& periods = data_.building.periods;
        loop_.fit.resize({StoredLoop::n_models, periods.size(), StoredLoop::n_resolutions,
                          n_channels(), StoredLoop::n_metrics});
        loop_.coverage.resize({periods.size(), StoredLoop::n_resolutions, n_channels()});
        learn_bands();
        for (std::size_t p = 0; p < periods.size(); ++p) fits_of(p);
    }

    /// Of hourly channels, from what was left out.
    void learn_bands() {
        const study::Targets& targets = data_.targets;
        const Standing& last = result_.last;
        const physics::TimeAxis axis = study::axis_of(data_.building, data_.training());
        const auto begins = study::begins_of(axis, physics::Interval::hourly);
        for (std::size_t c = 0; c < n_channels(); ++c) {
            const auto measured = targets.of(c, targets.measured),
                       predicted = targets.of(c, last.fit.at.predicted),
                       left_out = targets.of(c, last.left_out);
            UnseenHours unseen;
            if (measured.size() == begins.size())
                unseen = {begins,
                          {predicted.begin(), predicted.end()},
                          {left_out.begin(), left_out.end()}};
            for (std::size_t k = 0; k < unseen.begins.size(); ++k)
                if (std::isnan(measured[k])) unseen.residuals[k] = nan;
            bands_.emplace_back(unseen,
                                physics::is_temperature(targets.channels[c].quantity));
        }
    }

    /// By how much a channel's level may differ from what is predicted, as a share.
    double level_of(const study::Period& period, std::size_t channel) const {
        const auto quantity = data_.targets.channels[channel].quantity;
        if (period.from == data_.training().from) return 0;
        const double usual = usual_level_change(quantity);
        return usual == 0 ? 0 : data_.options.level_change.value_or(usual);
    }

    void fits_of(std::size_t p) {
        const study::Period& period = data_.building.periods[p];
        const auto drive = data_.drive_over(period);
        const auto plain_drive =
            result_.hours.empty() ? drive : written_.drive_over(period);
        const physics::TimeAxis axis = study::axis_of(data_.building, period);
        const auto begins = study::begins_of(axis, physics::Interval::hourly);
        Hours hours;
        for (std::size_t m = 0; m < StoredLoop::n_models; ++m)
            hours.push_back(predicted(
                m, period, m == StoredLoop::plain ? plain_drive : drive, begins.size()));
        const auto readings = study::readings_of(data_.building, period);
        StoredPeriod& stored = periods_.emplace_back();
        stored.name = period.name;
        stored.begins = begins;
        stored.months = study::begins_of(axis, physics::Interval::monthly);
        stored.outdoor_temperature =
            by_late_clock_throughout(outdoors_of(*drive), result_.hours_late);
        for (std::size_t c = 0; c < n_channels(); ++c) {
            const kernel::Readings& meter = readings[data_.meters[c]];
            const bool is_hourly = meter.values.size() == begins.size();
            const std::vector<double> measured =
                is_hourly ? meter.values : std::vector<double>(begins.size(), nan);
            const bool is_mean = meter.quantity == physics::Quantity::air_temperature;
            const double level = level_of(period, c);
            for (std::size_t m = 0; m < hours.size(); ++m) {
                const auto& own = hours[m][c];
                const Months months = is_hourly
                                          ? months_of(begins, own, measured, is_mean)
                                          : read_by_month(begins, own, meter, axis);
                set_fit({m, p, StoredLoop::hourly, c}, stats::metrics_of(own, measured));
                set_fit({m, p, StoredLoop::monthly, c},
                        stats::metrics_of(months.simulated, months.measured));
                if (m == StoredLoop::after)
                    loop_.coverage.set(
                        {p, StoredLoop::monthly, c},
                        share_within(bands_[c].months(months.simulated, level),
                                     months.measured));
            }
            stored.channels.push_back(channel_of(c, measured, hours));
            const auto& after = hours.back()[c];
            const auto bands = bands_[c].hours(after, begins, level);
            loop_.coverage.set({p, StoredLoop::hourly, c}, share_within(bands, measured));
            add_hours(bands, stored.channels.back());
            const auto whole = months_of(begins, after, after, is_mean).simulated;
            add_months(whole, bands_[c].months(whole, level), stored.channels.back());
        }
    }

    /// [models][channels][hours]
    using Hours = std::vector<std::vector<std::vector<double>>>;

    /// By the meters' clocks.
    StoredPeriod::Channel channel_of(std::size_t c, const std::vector<double>& measured,
                                     const Hours& hours) const {
        StoredPeriod::Channel channel{loop_.channels[c].name,
                                      by_late_clock(measured, result_.hours_late)};
        channel.simulated.shape = {hours.size(), measured.size()};
        for (const auto& model : hours) {
            const auto stamped = by_late_clock_throughout(model[c], result_.hours_late);
            auto& all = channel.simulated.values;
            all.insert(all.end(), stamped.begin(), stamped.end());
        }
        return channel;
    }

    /// After's intervals, by the meters' clocks.
    void add_hours(const std::vector<Band>& bands, StoredPeriod::Channel& channel) const {
        std::vector<double> least, most;
        for (const Band& band : bands) {
            least.push_back(band.least);
            most.push_back(band.most);
        }
        channel.q05 = by_late_clock_throughout(least, result_.hours_late);
        channel.q95 = by_late_clock_throughout(most, result_.hours_late);
    }

    static void add_months(const std::vector<double>& predicted,
                           const std::vector<Band>& bands,
                           StoredPeriod::Channel& channel) {
        channel.month = predicted;
        for (const Band& band : bands) {
            channel.month_q05.push_back(band.least);
            channel.month_q95.push_back(band.most);
        }
    }

    struct FitPlace {
        std::size_t model, period, resolution, channel;
    };
    void set_fit(const FitPlace& at, const stats::FitMetrics& metrics) {
        const auto set = [&](StoredLoop::Metric metric, double value) {
            loop_.fit.set({at.model, at.period, at.resolution, at.channel, metric},
                          value);
        };
        set(StoredLoop::n_readings, metrics.n);
        set(StoredLoop::cv_rmse, metrics.cv_rmse);
        set(StoredLoop::nmbe, metrics.nmbe);
        set(StoredLoop::rmse, metrics.rmse);
    }

    /// A model's hours of a period; NaN where it follows something that is missing there,
    /// which a decision then says.
    std::vector<std::vector<double>> predicted(
        std::size_t model, const study::Period& period,
        const std::shared_ptr<const physics::Drive>& drive, std::size_t n_hours) {
        try {
            return hours_of(data_, result_.baseline, *standings_of(result_)[model],
                            model == StoredLoop::after ? result_.functions
                                                       : std::vector<FoundFunction>{},
                            drive);
        } catch (const std::exception& error) {
            rethrow_of_machine(error);
            decisions_.push_back({"period " + period.name, error.what(),
                                  "not predicted by '" + loop_.models[model] + "'",
                                  study::DecisionKind::period});
            return {n_channels(), std::vector<double>(n_hours, nan)};
        }
    }

    void decisions() {
        for (const study::DataDecision& decision : decisions_)
            loop_.decisions.push_back({decision.series, decision.finding, decision.action,
                                       study::name_of(decision.kind)});
    }

    /// What the last model says, and by the hour its errors beside the plain model's.
    study::Summary summary() const {
        study::Summary summary;
        summary.study = stage_;
        for (std::size_t k = 0; k < loop_.parameters.size(); ++k) {
            const double value = loop_.parameter_value.at({StoredLoop::after, k});
            const double half =
                stats::z_90_two_sided * loop_.parameter_sd.at({StoredLoop::after, k});
            summary.values.push_back(
                {loop_.parameters[k].name, value, value - half, value + half});
        }
        for (std::size_t p = 0; p < loop_.periods.size(); ++p)
            for (std::size_t c = 0; c < n_channels(); ++c) {
                const auto error = [&](StoredLoop::Model model,
                                       StoredLoop::Metric metric) {
                    return loop_.fit.at({model, p, StoredLoop::hourly, c, metric});
                };
                summary.fits.push_back({p, data_.meters[c],
                                        error(StoredLoop::plain, StoredLoop::cv_rmse),
                                        error(StoredLoop::after, StoredLoop::cv_rmse),
                                        error(StoredLoop::after, StoredLoop::nmbe)});
            }
        const auto period =
            static_cast<std::size_t>(&data_.training() - data_.building.periods.data());
        summary.shortfall = study::bias_beyond(data_.building, period, summary.fits);
        for (const StoredLoop::Effect& effect : loop_.effects)
            summary.findings.push_back(
                {"loop",
                 fmt::format("found: {}, {:.3g} {}", effect.name, effect.coefficient,
                             effect.unit),
                 effect.is_adequate() ? "accepted" : "accepted, not adequate"});
        return summary;
    }

    std::size_t n_channels() const { return data_.meters.size(); }

    std::string stage_;
    const LoopData& written_;
    const LoopData& data_;
    const LoopResult& result_;
    std::vector<double> deviations_;  ///< of last's unknowns, of what noise leaves
    std::vector<study::DataDecision>
        decisions_;  ///< of the data, of effects, then of periods
    StoredLoop loop_;
    std::vector<StoredPeriod> periods_;
    std::vector<ReadingBands> bands_;  ///< [channels] of the last model
};

}  // namespace

study::Conclusion conclude_loop(const std::string& stage, const LoopData& written,
                                const LoopData& data, const LoopResult& result) {
    return Writer(stage, written, data, result).write();
}

}  // namespace bemcal::loop
