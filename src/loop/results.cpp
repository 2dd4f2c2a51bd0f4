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
#include "effects/refinements.hpp"
#include "loop/effect_values.hpp"
#include "loop/intervals.hpp"
#include "loop/job_parts.hpp"
#include "loop/late_clock.hpp"
#include "loop/next_measurements.hpp"
#include "loop/period_hours.hpp"
#include "loop/settings.hpp"
#include "loop/stored_fits.hpp"
#include "loop/stored_loop.hpp"
#include "loop/unusual_end.hpp"
#include "stats/distributions.hpp"

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

/// Of an effect that may be none for what parameters can do in its place.
constexpr const char* doubt_of_zero =
    "its interval holds 0: parameters do nearly the same";

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
          decisions_(data.building.decisions) {
        decisions_.insert(decisions_.end(), result.decisions.begin(),
                          result.decisions.end());
    }

    study::Conclusion write() {
        say();
        fits();
        decisions();
        study::Summary summary = summary_of(stage_, data_, loop_);
        summary.parts = parts();
        summary.undecided = known(result_.undecided);
        summary.of_the_place = result_.of_the_place;
        return {datasets_of(stage_, loop_, periods_), {std::move(summary)}};
    }

    StoredLoop without_predictions() {
        say();
        decisions();
        return std::move(loop_);
    }

  private:
    void say() {
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
        denied_settings();
    }

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
        const Standings standings = standings_of(result_);
        std::map<std::string, std::size_t> index;
        // Those of the last model first: before may have more of its structure.
        for (const Standing* standing : {&result_.last, &result_.baseline.chosen})
            for (std::size_t k = 0; k < standing->built.first_effect(); ++k) {
                const study::FitUnknown& unknown = standing->built.unknowns[k];
                if (!index.emplace(unknown.name, index.size()).second) continue;
                loop_.parameters.push_back({unknown.name, unknown.unit});
                if (!unknown.has_prior) continue;
                loop_.parameters.back().prior_mean = unknown.centre;
                loop_.parameters.back().prior_sd = unknown.scale;
            }
        loop_.parameter_value.resize({StoredLoop::n_models, index.size()});
        loop_.parameter_sd.resize({StoredLoop::n_models, index.size()});
        for (std::size_t m = 0; m < standings.size(); ++m) {
            const auto sds = m == StoredLoop::after
                                 ? deviations_
                                 : deviations_of(data_, *standings[m], result_.misfit);
            const auto& own = standings[m]->built.unknowns;
            for (std::size_t k = 0; k < standings[m]->built.first_effect(); ++k) {
                const std::size_t at = index.at(own[k].name);
                loop_.parameter_value.set({m, at},
                                          own[k].within(standings[m]->fit.at.x[k]));
                loop_.parameter_sd.set({m, at}, sds[k]);
            }
        }
    }

    void structures() {
        for (const TriedStructure& tried : result_.baseline.tried)
            loop_.structures.push_back({tried.name, tried.score});
        const auto chosen =
            whole_structure(data_, result_.baseline.chosen.model.structure);
        loop_.structure_chosen = effects::name_of(chosen);
        for (const std::size_t index :
             whole_structure(data_, result_.last.model.structure)) {
            const effects::Refinement& one = effects::refinements()[index];
            loop_.refinements.push_back({one.name, one.what});
        }
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
        for (std::size_t k = 0; k < result_.found.size(); ++k) effect_found(k);
        effect_values();
    }

    /// Of a coefficient, in its unit; hours are there or not.
    double deviation(std::size_t effect) const {
        const Standing& last = result_.last;
        if (last.model.effects[effect].other_hours) return 0;
        return deviation_of(result_.found[effect],
                            deviations_[last.built.first_effect() + effect]);
    }

    void effect_values() {
        const Standing& last = result_.last;
        std::vector<double> sds = deviations_;
        for (std::size_t k = 0; k < result_.found.size(); ++k)
            sds[last.built.first_effect() + k] = deviation(k);
        const auto accounts = accounts_of(data_);
        const auto worth = worth_of_effects(data_, result_.baseline.place, last, sds,
                                            result_.misfit, accounts);
        for (std::size_t k = 0; k < worth.size(); ++k)
            for (std::size_t a = 0; a < accounts.size(); ++a)
                if (!std::isnan(worth[k][a].mean))
                    loop_.effect_values.push_back({static_cast<double>(k), accounts[a].of,
                                                   accounts[a].unit, worth[k][a].mean,
                                                   worth[k][a].least, worth[k][a].most});
    }

    void effect_found(std::size_t k) {
        const effects::Effect& effect = result_.last.model.effects[k];
        const Found& found = result_.found[k];
        const double c = result_.last.coefficient(k);
        const double half = stats::z_90_two_sided * deviation(k);
        const effects::Entry* entry = effects::entry_of(effect);
        StoredLoop::Effect& stored = loop_.effects.emplace_back();
        stored.name = effect.name;
        stored.hook = effects::name_of(effect.hook);
        stored.driver = effects::name_of(effect.driver);
        stored.shape = effects::sentence_of(effect);
        stored.gate = effects::name_of(effect.gate);
        stored.unit = effects::unit_of(effect);
        for (const Named& named : found.names) {
            stored.members.push_back({named.name, named.probability});
            stored.class_in_words +=
                (stored.class_in_words.empty() ? "" : "; ") + named.name;
        }
        stored.separates = entry == nullptr ? "" : entry->separates;
        stored.doubt = found.doubt;
        if (stored.doubt.empty() && half > std::abs(c)) stored.doubt = doubt_of_zero;
        stored.coefficient = c;
        stored.least = c - half;
        stored.most = c + half;
        stored.gain = found.gain;
        stored.adequate = stored.doubt.empty() ? 1 : 0;
        stored.section = effects::job_section_of(
            effect, belief_of(k, {c, half / stats::z_90_two_sided}),
            data_.training().from, names_before(k));
    }

    /// In a job that has the effects found before.
    std::vector<std::string> names_before(std::size_t effect) const {
        std::vector<std::string> names;
        if (data_.building.declared_effects)
            for (const effects::Effect& own : data_.building.declared_effects->effects)
                names.push_back(own.name);
        for (std::size_t k = 0; k < effect; ++k)
            names.push_back(effects::name_in_job(result_.last.model.effects[k]));
        return names;
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
            loop_.functions.push_back({name_of(function, data_.training().from),
                                       function.at.name, function.basis.driver,
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

    /// Whether the job has a parameter of that name; the others are a refinement's.
    bool is_of_job(const std::string& name) const {
        const auto& known = data_.building.parameters;
        return std::ranges::find(known, name, &physics::Parameter::name) != known.end();
    }

    void unusual_ends() {
        const Standing& last = result_.last;
        for (std::size_t k = 0; k < last.built.first_effect(); ++k) {
            const study::FitUnknown& unknown = last.built.unknowns[k];
            std::string finding =
                unusual_end(unknown, last.fit.at.x[k], !is_of_job(unknown.name));
            if (!finding.empty())
                decisions_.push_back({unknown.name, std::move(finding),
                                      "may stand for what the description lacks",
                                      study::DecisionKind::parameter});
        }
    }

    void denied_settings() {
        const Standing& last = result_.last;
        const study::Case& building = data_.building;
        for (std::size_t k = 0; k < last.built.first_effect(); ++k) {
            const study::FitUnknown& unknown = last.built.unknowns[k];
            const auto parameter = std::ranges::find(building.parameters, unknown.name,
                                                     &physics::Parameter::name);
            if (parameter == building.parameters.end()) continue;
            if (auto denied = denied_setting(building.building, *parameter, unknown,
                                             last.fit.at.x[k], deviations_[k]))
                loop_.settings.push_back(std::move(*denied));
        }
    }

    /// Itself, at the same meter where it is at one, or as a name of what was found.
    bool is_found(const effects::Effect& effect) const {
        for (std::size_t k = 0; k < result_.found.size(); ++k) {
            const effects::Effect& own = result_.last.model.effects[k];
            const auto& names = result_.found[k].names;
            const bool is_elsewhere =
                own.name == effect.name && !are_of_one_row(own, effect);
            if (!is_elsewhere &&
                std::ranges::find(names, effect.name, &Named::name) != names.end())
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
        FitsWriter writer(
            data_, data_.building,
            unseen_of(data_, result_.last.fit.at.predicted, result_.last.left_out),
            result_.hours_late, loop_);
        for (const study::Period& period : data_.building.periods)
            periods_.push_back(writer.add(period, hours_over(period)));
    }

    ModelHours hours_over(const study::Period& period) {
        const auto drive = data_.drive_over(period);
        const auto plain_drive =
            result_.hours.empty() ? drive : written_.drive_over(period);
        const std::size_t n_hours =
            study::begins_of(study::axis_of(data_.building, period),
                             physics::Interval::hourly)
                .size();
        ModelHours hours;
        for (std::size_t m = 0; m < StoredLoop::n_models; ++m)
            hours.models.push_back(predicted(
                m, period, m == StoredLoop::plain ? plain_drive : drive, n_hours));
        hours.outdoors = outdoors_of(*drive);
        return hours;
    }

    /// A model's hours of a period; NaN where it follows something that is missing there,
    /// which a decision then says.
    std::vector<std::vector<double>> predicted(
        std::size_t model, const study::Period& period,
        const std::shared_ptr<const physics::Drive>& drive, std::size_t n_hours) {
        try {
            return hours_of(data_, *standings_of(result_)[model],
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

    /// What a job may adopt.
    std::vector<study::FoundPart> parts() const {
        std::vector<study::FoundPart> parts;
        const auto structure = structure_line();
        if (!structure.empty()) parts.push_back({"", structure, ""});
        for (const StoredLoop::JobPart& part : loop_.job_parts)
            parts.push_back({"", effects::as_tables(part.section), ""});
        for (std::size_t k = 0; k < loop_.effects.size(); ++k) {
            const StoredLoop::Effect& effect = loop_.effects[k];
            parts.push_back({effect.name, effects::as_tables(effect.section), effect.unit,
                             effect.coefficient, effect.least, effect.most,
                             known(result_.found[k].names)});
        }
        return parts;
    }

    /// Those whose probability somebody asked.
    static std::vector<Named> known(std::vector<Named> names) {
        std::erase_if(names,
                      [](const Named& one) { return std::isnan(one.probability); });
        return names;
    }

    /// `structure` with the names of the refinements; empty for the standard's.
    std::string structure_line() const {
        std::string names;
        for (const std::size_t index :
             whole_structure(data_, result_.last.model.structure))
            names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ",
                                 effects::refinements()[index].name);
        return names.empty() ? "" : fmt::format("structure = [{}]\n", names);
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
};

}  // namespace

StoredLoop without_predictions(const std::string& stage, const LoopData& written,
                               const LoopData& data, const LoopResult& result) {
    return Writer(stage, written, data, result).without_predictions();
}

study::Conclusion conclude_loop(const std::string& stage, const LoopData& written,
                                const LoopData& data, const LoopResult& result) {
    return Writer(stage, written, data, result).write();
}

}  // namespace bemcal::loop
