/// Runs a calibration in stages as one stage of the plan: a round is what the optimiser
/// at work asks for; all follows from the answers, on rank 0, as in `optimisation`.
/// Source: paper 2; all parameters at once are one stage more.
/// Leaves out the order of stages (`staged_path`), objectives (`staged_goal`) and
/// judgement (`staged_results`).
#include "calibration/staged.hpp"

#include "base/nan.hpp"
#include "calibration/staged_results.hpp"
#include "study/bias.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace bemcal::calibration {
namespace {

constexpr std::size_t points_per_item = points_per_staged_item;

template <class Names>
bool is_in(const Names& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

void add_new(const std::vector<std::string>& some, std::vector<std::string>& all) {
    for (const std::string& name : some)
        if (!is_in(all, name)) all.push_back(name);
}

/// Meters of all stages; all with readings where one has these. Their weights where the
/// stages agree on them.
void take_meters(const std::vector<CalibrationStage>& stages, OptimisationOptions& fit) {
    const OptimisationOptions& first = stages.front().fit;
    const auto agrees = [&](const CalibrationStage& stage) {
        return stage.fit.meters == first.meters &&
               stage.fit.meter_weights == first.meter_weights;
    };
    if (std::ranges::all_of(stages, agrees)) return;
    fit.meters.clear();
    fit.meter_weights.clear();
    for (const CalibrationStage& stage : stages) add_new(stage.fit.meters, fit.meters);
    const auto has_all = [](const CalibrationStage& stage) {
        return stage.fit.meters.empty();
    };
    if (std::ranges::any_of(stages, has_all)) fit.meters.clear();
}

/// All that the stages do, as one stage.
CalibrationStage at_once_stage(const StagedOptions& options) {
    CalibrationStage all = options.stages.front();
    all.name = all_at_once;
    all.from = initial_values;
    all.around = 0;
    all.ranges.clear();
    all.set.clear();
    take_meters(options.stages, all.fit);
    std::size_t n = 0;
    for (const CalibrationStage& stage : options.stages) {
        if (stage.fit.objective != all.fit.objective)
            all.fit.objective = options.objective;
        add_new(stage.periods, all.periods);
        add_new(stage.parameters, all.parameters);
        n += stage.fit.evaluations;
    }
    all.fit.evaluations =
        options.at_once_evaluations > 0 ? options.at_once_evaluations : n;
    return all;
}

std::vector<CalibrationStage> all_stages(const StagedOptions& options) {
    if (options.stages.empty()) throw std::invalid_argument("there is no stage");
    std::vector<CalibrationStage> stages = options.stages;
    if (options.at_once) stages.push_back(at_once_stage(options));
    return stages;
}

const study::Period& exact_period(const study::Case& building, const std::string& name) {
    const auto found = std::ranges::find(building.periods, name, &study::Period::name);
    if (found == building.periods.end())
        throw std::invalid_argument(building.name + " has no period " + name);
    return *found;
}

void check_parameters(const study::Case& building, const CalibrationStage& stage) {
    if (stage.periods.empty() || stage.parameters.empty())
        throw std::invalid_argument("the stage " + stage.name +
                                    " needs a period and a parameter");
    const auto has = [&](const std::string& name) {
        return std::ranges::find(building.parameters, name, &physics::Parameter::name) !=
               building.parameters.end();
    };
    for (const std::string& name : stage.parameters)
        if (!has(name))
            throw std::invalid_argument(building.name + " has no parameter " + name +
                                        ", of the stage " + stage.name);
    for (const NamedValue& each : stage.set)
        if (!has(each.parameter) || is_in(stage.parameters, each.parameter))
            throw std::invalid_argument("the stage " + stage.name + " sets " +
                                        each.parameter +
                                        ", which is no parameter or which it calibrates");
    for (const NamedRange& range : stage.ranges)
        if (!is_in(stage.parameters, range.parameter) || !(range.least < range.most))
            throw std::invalid_argument("the stage " + stage.name + " has a range for " +
                                        range.parameter +
                                        ", which it does not calibrate, or it is empty");
}

void check_stage(const study::Case& building, const CalibrationStage& stage,
                 const std::vector<std::string>& before) {
    check_parameters(building, stage);
    if (!is_in(before, stage.from))
        throw std::invalid_argument("the stage " + stage.name + " starts from " +
                                    stage.from + ", which is no stage before it");
    if (is_in(before, stage.name))
        throw std::invalid_argument("two stages are called " + stage.name);
    for (const std::string& period : stage.periods) exact_period(building, period);
}

/// Does something of a stage, and says of which it was where that throws.
template <class Do>
auto of_stage(std::size_t n, Do make) {
    try {
        return make();
    } catch (const std::invalid_argument& error) {
        throw StageFault(n, error.what());
    }
}

void check_stages(const study::Case& building,
                  const std::vector<CalibrationStage>& stages) {
    std::vector<std::string> before{initial_values};
    for (std::size_t n = 0; n < stages.size(); ++n) {
        of_stage(n, [&] { check_stage(building, stages[n], before); });
        before.push_back(stages[n].name);
    }
}

/// A period that was seen says nothing of those that were not.
void check_validation(const study::Case& building, const StagedOptions& options) {
    for (const ValidationPeriod& validation : options.validation) {
        const study::Period& unseen = exact_period(building, validation.period);
        for (const CalibrationStage& stage : options.stages)
            for (const std::string& name : stage.periods) {
                const study::Period& seen = exact_period(building, name);
                if (seen.from < unseen.to && unseen.from < seen.to)
                    throw std::invalid_argument(
                        "the validation period " + unseen.name + " overlaps " + name +
                        ", on which the stage " + stage.name + " calibrates");
            }
        if (std::ranges::find(options.stages, validation.stage,
                              &CalibrationStage::name) == options.stages.end())
            throw std::invalid_argument("the validation period " + unseen.name +
                                        " takes the values of " + validation.stage +
                                        ", which is no stage");
    }
}

PeriodModels models_of(const study::Case& building, const StagedOptions& options,
                       const MakePeriodModel& model) {
    std::vector<std::string> names;
    for (const CalibrationStage& stage : options.stages) add_new(stage.periods, names);
    for (const ValidationPeriod& validation : options.validation)
        add_new({validation.period}, names);
    PeriodModels models;
    for (const std::string& name : names)
        models[name] = model(building, exact_period(building, name));
    return models;
}

/// The way with all that it was told.
struct StagedHistory {
    StagedPath path;
    std::size_t n_items = 0;   ///< told
    std::size_t n_points = 0;  ///< told
    std::vector<study::Failure> failures;
};

class StagedCalibration : public study::Stage {
  public:
    StagedCalibration(std::string name, const study::Case& building,
                      StagedOptions options, const MakePeriodModel& model);

    std::string name() const override { return name_; }
    void see(const std::vector<study::Summary>& found) override;
    int n_items() const override { return static_cast<int>(items_of(points_.rows)); }
    long long n_simulations() const override;
    bool has_rounds() const override { return true; }
    std::size_t answer_bytes() const override { return sizeof(double) * points_per_item; }
    study::ItemAnswer run(int item) const override;
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override;
    void begin_round(int first_item, const study::Round& round) override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    /// What the last stage ends with; all at once is no stage.
    std::vector<double> best_point(
        const std::vector<study::ItemAnswer>& answers) const override {
        StagedHistory history = start();
        follow(answers, history);
        return history.path.found().at(options_.stages.size() - 1).value;
    }

  private:
    static std::size_t items_of(std::size_t n_points) {
        return (n_points + points_per_item - 1) / points_per_item;
    }
    StagedHistory start() const {
        return {{building_.parameters, building_.priors, stages_}, 0, 0, {}};
    }
    void follow(const std::vector<study::ItemAnswer>& answers,
                StagedHistory& history) const;
    void add_stages(const StagedPath& path, study::DatasetBuilder& datasets) const;
    std::vector<std::vector<double>> spreads_of(
        const std::vector<StageFound>& found) const;
    void add_comparisons(const StagedPath& path, study::DatasetBuilder& datasets) const;
    std::vector<Version> versions_beside(const StagedPath& path) const;
    study::Summary summary_of(const StagedPath& path) const;

    std::string name_;
    study::Case building_;
    StagedOptions options_;
    std::vector<CalibrationStage> stages_;  ///< with the one of all at once
    PeriodModels models_;
    std::vector<StageGoal> goals_;                  ///< [stages]
    std::vector<Version> beside_;                   ///< of studies above
    std::size_t stage_ = 0;                         ///< of this round
    Matrix points_;                                 ///< of this round
    int first_item_ = 0;                            ///< of this round
    std::size_t n_before_ = 0;                      ///< points before it
    mutable std::optional<StagedHistory> history_;  ///< of rank 0, from round to round
};

StagedCalibration::StagedCalibration(std::string name, const study::Case& building,
                                     StagedOptions options, const MakePeriodModel& model)
    : name_(std::move(name)),
      building_(building),
      options_(std::move(options)),
      stages_(all_stages(options_)) {
    check_stages(building_, stages_);
    check_validation(building_, options_);
    models_ = models_of(building_, options_, model);
    goals_.reserve(stages_.size());
    for (std::size_t n = 0; n < stages_.size(); ++n)
        of_stage(n, [&] { goals_.emplace_back(building_, models_, stages_[n]); });
    points_ = start().path.next_points();
}

long long StagedCalibration::n_simulations() const {
    std::size_t n = 0;
    for (const CalibrationStage& stage : stages_)
        n += stage.fit.evaluations * stage.periods.size();
    return static_cast<long long>(n);
}

void StagedCalibration::see(const std::vector<study::Summary>& found) {
    for (const std::string& study : options_.beside) {
        const study::Summary* summary =
            study::find_summary(found, building_.name + "/" + study, building_.name);
        if (summary == nullptr || summary->values.empty()) continue;
        std::vector<double> point = study::nominal_point(building_.parameters);
        for (std::size_t k = 0; k < point.size(); ++k)
            if (const auto* value =
                    study::find_value(*summary, building_.parameters[k].name))
                point[k] = value->value;
        beside_.push_back({study, std::move(point)});
    }
}

study::ItemAnswer StagedCalibration::run(int item) const {
    const std::size_t first =
        static_cast<std::size_t>(item - first_item_) * points_per_item;
    const std::size_t n = std::min(points_per_item, points_.rows - first);
    std::vector<std::string> failures;
    study::ItemAnswer answer;
    answer.values = goals_[stage_].evaluate(study::part_of(points_, first, n), failures);
    answer.failures = study::failures_of_points(failures, n_before_ + first);
    return answer;
}

/// Tells the way the answers that it does not know yet.
void StagedCalibration::follow(const std::vector<study::ItemAnswer>& answers,
                               StagedHistory& history) const {
    while (history.n_items < answers.size()) {
        const std::size_t n = history.path.next_points().rows;
        if (n == 0) return;
        std::vector<double> values(n, nan);
        for (std::size_t first = 0; first < n && history.n_items < answers.size();
             first += points_per_item) {
            const study::ItemAnswer& answer = answers[history.n_items++];
            study::append_failures(
                answer, {history.n_points + first, std::min(points_per_item, n - first)},
                history.failures);
            if (answer.error.empty())
                std::ranges::copy(answer.values,
                                  values.begin() + static_cast<std::ptrdiff_t>(first));
        }
        history.path.tell(values);
        history.n_points += n;
    }
}

std::optional<study::Round> StagedCalibration::next_round(
    const std::vector<study::ItemAnswer>& answers) const {
    if (!history_ || history_->n_items > answers.size()) history_.emplace(start());
    follow(answers, *history_);
    const Matrix points = history_->path.next_points();
    if (points.rows == 0) return std::nullopt;
    study::Round round{static_cast<int>(items_of(points.rows)),
                       {static_cast<double>(history_->path.stage()),
                        static_cast<double>(history_->n_points)}};
    round.needed.insert(round.needed.end(), points.values.begin(), points.values.end());
    return round;
}

void StagedCalibration::begin_round(int first_item, const study::Round& round) {
    first_item_ = first_item;
    stage_ = static_cast<std::size_t>(round.needed.at(0));
    n_before_ = static_cast<std::size_t>(round.needed.at(1));
    points_.cols = building_.parameters.size();
    points_.values.assign(round.needed.begin() + 2, round.needed.end());
    points_.rows = points_.values.size() / points_.cols;
}

/// [stages x parameters], one row after the other.
template <class Row>
std::vector<double> rows_of(const std::vector<StageFound>& found, Row row) {
    std::vector<double> values;
    for (std::size_t s = 0; s < found.size(); ++s) {
        const std::vector<double> part = row(s);
        values.insert(values.end(), part.begin(), part.end());
    }
    return values;
}

std::vector<double> at_bounds(const StageFound& found) {
    std::vector<double> ends;
    ends.reserve(found.value.size());
    for (std::size_t k = 0; k < found.value.size(); ++k)
        ends.push_back(
            study::end_of_range(found.value[k], found.least[k], found.most[k]));
    return ends;
}

void StagedCalibration::add_stages(const StagedPath& path,
                                   study::DatasetBuilder& datasets) const {
    const auto& found = path.found();
    const std::size_t n = found.size(), p = building_.parameters.size();
    std::vector<std::string> names, from;
    std::vector<double> objective, evaluated;
    for (std::size_t s = 0; s < n; ++s) {
        names.push_back(stages_[s].name);
        from.push_back(stages_[s].from);
        objective.push_back(found[s].objective);
        evaluated.push_back(static_cast<double>(found[s].n_evaluated));
    }
    datasets.texts("calibration_stage", "calibration_stage", std::move(names));
    datasets.texts("calibration_from", "calibration_stage", std::move(from));
    datasets.vector("calibration_objective", "calibration_stage", std::move(objective));
    datasets.vector("calibration_evaluations", "calibration_stage", std::move(evaluated));
    const auto add = [&](const char* leaf, auto row) {
        datasets.array(leaf, {"calibration_stage", "parameter"}, {n, p},
                       rows_of(found, row));
    };
    add("calibration_start", [&](std::size_t s) { return found[s].start; });
    add("calibration_value", [&](std::size_t s) { return found[s].value; });
    add("calibration_least", [&](std::size_t s) { return found[s].least; });
    add("calibration_most", [&](std::size_t s) { return found[s].most; });
    add("calibration_at_bound", [&](std::size_t s) { return at_bounds(found[s]); });
    const auto spreads = spreads_of(found);
    add("calibration_sd", [&](std::size_t s) { return spreads[s]; });
}

/// [stages][parameters of the case]
std::vector<std::vector<double>> StagedCalibration::spreads_of(
    const std::vector<StageFound>& found) const {
    const StagedJudge judge(building_, models_, options_.accuracy);
    const std::size_t p = building_.parameters.size();
    std::vector<std::vector<double>> spreads, known;  // known: with what is carried over
    for (std::size_t s = 0; s < found.size(); ++s) {
        const auto before =
            std::ranges::find(stages_, stages_[s].from, &CalibrationStage::name);
        std::vector<double> carried(p, nan);
        if (before != stages_.end())
            carried = known[static_cast<std::size_t>(before - stages_.begin())];
        for (std::size_t k = 0; k < p; ++k)
            if (std::ranges::count(stages_[s].set, building_.parameters[k].name,
                                   &NamedValue::parameter) > 0)
                carried[k] = nan;
        spreads.push_back(
            judge.spread_of(stages_[s], found[s], goals_[s].meters(), carried));
        for (std::size_t k = 0; k < p; ++k)
            if (!std::isnan(spreads[s][k])) carried[k] = spreads[s][k];
        known.push_back(std::move(carried));
    }
    return spreads;
}

/// All at once, and studies above.
std::vector<Version> StagedCalibration::versions_beside(const StagedPath& path) const {
    std::vector<Version> versions;
    if (options_.at_once) versions.push_back({all_at_once, path.found().back().value});
    versions.insert(versions.end(), beside_.begin(), beside_.end());
    return versions;
}

void StagedCalibration::add_comparisons(const StagedPath& path,
                                        study::DatasetBuilder& datasets) const {
    const StagedJudge judge(building_, models_, options_.accuracy);
    const std::vector<Version> others = versions_beside(path);
    const auto compare = [&](const std::string& folder,
                             const std::vector<std::string>& periods,
                             std::vector<Version> versions, std::size_t stage) {
        versions.insert(versions.end(), others.begin(), others.end());
        judge.compare({folder, periods, std::move(versions), goals_[stage].meters()},
                      datasets);
    };
    for (std::size_t s = 0; s < options_.stages.size(); ++s) {
        const StageFound& found = path.found()[s];
        compare("calibration/" + stages_[s].name, stages_[s].periods,
                {{"before", found.start}, {"after", found.value}}, s);
    }
    for (const ValidationPeriod& validation : options_.validation) {
        const auto stage = static_cast<std::size_t>(
            std::ranges::find(stages_, validation.stage, &CalibrationStage::name) -
            stages_.begin());
        compare("validation/" + validation.period, {validation.period},
                {{initial_values, study::nominal_point(building_.parameters)},
                 {validation.stage, path.found()[stage].value}},
                stage);
    }
}

/// What the last stage ends with, over the periods and meters of all of them.
study::Summary StagedCalibration::summary_of(const StagedPath& path) const {
    std::vector<std::string> biases;
    const auto& last = path.found().at(options_.stages.size() - 1);
    for (std::size_t s = 0; s < options_.stages.size(); ++s)
        for (const std::string& name : stages_[s].periods) {
            const auto period = static_cast<std::size_t>(&exact_period(building_, name) -
                                                         building_.periods.data());
            const auto fits =
                models_.at(name)->fits_at(last.value, period, goals_[s].meters());
            const std::string bias = study::bias_beyond(building_, period, fits);
            if (std::ranges::find(biases, bias) == biases.end()) biases.push_back(bias);
        }
    study::Summary summary;
    summary.study = name_;
    summary.shortfall = study::joined_sentences(biases);
    return summary;
}

study::Conclusion StagedCalibration::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    StagedHistory history = start();
    follow(answers, history);
    study::DatasetBuilder datasets(name_);
    datasets.kind("stages");
    datasets.parameters(building_.parameters);
    datasets.scalar("accuracy", options_.accuracy);
    add_stages(history.path, datasets);
    add_comparisons(history.path, datasets);
    datasets.failures(history.failures);
    return {datasets.take(), {summary_of(history.path)}};
}

}  // namespace

std::unique_ptr<study::Stage> make_staged(std::string name, const study::Case& building,
                                          StagedOptions options,
                                          const MakePeriodModel& model) {
    return std::make_unique<StagedCalibration>(std::move(name), building,
                                               std::move(options), model);
}

}  // namespace bemcal::calibration
