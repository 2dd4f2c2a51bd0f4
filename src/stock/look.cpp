/// Makes residuals of a model that was adopted, and what each effect adds: the model with
/// it less the model without.
/// Follows from job::lay_adopted, by which both are read as any job is.
/// An effect without a section has no pattern; what it does stays in the residual.
#include "stock/look.hpp"

#include "stock/calibration.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace bemcal::stock {

namespace {

/// An effect's step is told where it explains this share of what the best pattern does.
constexpr double nearly_the_best = 0.8;

Matrix difference(const Matrix& one, const Matrix& other) {
    Matrix result = one;
    for (std::size_t k = 0; k < result.values.size(); ++k)
        result.values[k] -= other.values[k];
    return result;
}

void add(const Matrix& pattern, double size, std::size_t from_row, Matrix& to) {
    for (std::size_t d = from_row; d < to.rows; ++d)
        for (std::size_t f = 0; f < to.cols; ++f) to(d, f) += size * pattern(d, f);
}

physics::Seconds time_of(double day) {
    return physics::Seconds(std::chrono::days(static_cast<int>(day)));
}

}  // namespace

double day_of(physics::Seconds time) {
    return static_cast<double>(
        std::chrono::floor<std::chrono::days>(time.time_since_epoch()).count());
}

study::Period known_of(const StockRecord& record) {
    const auto time = [](double seconds) {
        return physics::Seconds(std::chrono::seconds(static_cast<long long>(seconds)));
    };
    return {job::known_period, time(record.known_from), time(record.known_to)};
}

study::Case adopted_building(const job::Job& stock_job, const job::StockLine& line,
                             const StockRecord& record, const study::Period& known,
                             std::vector<input::InputFile>& log,
                             const StockRecord::Effect* without) {
    job::Adopted adopted{record.adopted, known};
    for (const StockRecord::Effect& effect : record.effects)
        if (&effect != without) adopted.text += effect.section;
    job::Job job = read_building(stock_job, line, log, &adopted);
    start_from(values_in(record, job.buildings.at(0)), job.buildings[0]);
    return std::move(job.buildings[0]);
}

Look::Look(const job::Job& stock_job, const job::StockLine& line,
           const StockRecord& record, std::vector<input::InputFile>& log)
    : building_(adopted_building(stock_job, line, record, known_of(record), log)),
      sums_(day_sums(building_)),
      n_known_(sums_.row_of(building_.periods.front().to)),
      n_simulations_(1) {
    for (const StockRecord::Effect& effect : record.effects) {
        if (effect.section.empty()) continue;
        std::vector<input::InputFile> same;
        const study::Case without =
            adopted_building(stock_job, line, record, known_of(record), same, &effect);
        patterns_.push_back(
            {effect.name, "", difference(sums_.predicted, day_sums(without).predicted)});
        n_simulations_ += 1;
    }
    n_effects_ = patterns_.size();
    std::ranges::move(meter_patterns(building_, sums_), std::back_inserter(patterns_));
    spread_ = stats::spread_of(difference(sums_.measured, sums_.predicted),
                               sums_.predicted, n_known_);
}

bool Look::sees_new_days() const {
    for (std::size_t d = n_known_; d < sums_.n_days(); ++d)
        for (std::size_t f = 0; f < sums_.features.size(); ++f)
            if (!std::isnan(sums_.measured(d, f) - sums_.predicted(d, f))) return true;
    return false;
}

Matrix Look::residuals(const std::vector<StockRecord::Change>& changes) const {
    Matrix left = difference(sums_.measured, sums_.predicted);
    for (const StockRecord::Change& change : changes) {
        const auto pattern = std::ranges::find(patterns_, change.of, &Pattern::name);
        if (pattern != patterns_.end())
            add(pattern->values, -change.size, sums_.row_of(time_of(change.day)), left);
    }
    return left;
}

bool Look::has_name(const StockRecord::Change& change) const {
    const auto effects = std::span(patterns_).first(n_effects_);
    return std::ranges::find(effects, change.of, &Pattern::name) != effects.end();
}

std::vector<double> Look::wander_behind(
    const std::vector<StockRecord::Change>& changes) const {
    std::vector<StockRecord::Change> named, unnamed;
    for (const StockRecord::Change& change : changes)
        (has_name(change) ? named : unnamed).push_back(change);
    std::vector<stats::Told> days(sums_.n_days(), stats::Told::nothing);
    for (std::size_t d = 0; d < days.size(); ++d) {
        std::map<std::string_view, double> amounts;
        bool begins = false;
        for (const StockRecord::Change& change : unnamed) {
            const std::size_t row = sums_.row_of(time_of(change.day));
            if (row <= d) amounts[change.of] += change.size;
            begins = begins || row == d;
        }
        const bool is_left = std::ranges::any_of(
            amounts, [](const auto& amount) { return amount.second != 0; });
        if (is_left) days[d] = begins ? stats::Told::first_day : stats::Told::behind;
    }
    return stats::wander_behind(residuals(named), spread_, days);
}

std::optional<Look::Found> Look::next_step(
    const std::vector<StockRecord::Change>& changes,
    const std::vector<StockRecord::Change>& told, double false_alarms) const {
    std::vector<Matrix> values;
    values.reserve(patterns_.size());
    for (const Pattern& pattern : patterns_) values.push_back(pattern.values);
    const stats::StepTest test(residuals(changes), spread_, values,
                               {n_known_, false_alarms, wander_behind(told)});
    std::optional<stats::Step> effect, any;
    const auto is_surer = [](const stats::Step& step, const auto& than) {
        return !than || std::abs(step.statistic) > std::abs(than->statistic);
    };
    for (std::size_t k = 0; k < patterns_.size(); ++k) {
        const auto step = test.surest(k);
        if (!step || !test.is_told(*step)) continue;
        if (is_surer(*step, any)) any = step;
        if (k < n_effects_ && is_surer(*step, effect)) effect = step;
    }
    if (!any) return std::nullopt;
    const bool is_of_effect = effect && std::abs(effect->statistic) >=
                                            nearly_the_best * std::abs(any->statistic);
    const stats::Step& step = is_of_effect ? *effect : *any;
    const Pattern& pattern = patterns_[step.pattern];
    return Found{step, pattern.name, pattern.unit, is_of_effect,
                 day_of(sums_.day_at(step.day))};
}

double Look::misfit_from(double day, const Matrix& residuals) const {
    double sum = 0;
    for (std::size_t d = sums_.row_of(time_of(day)); d < residuals.rows; ++d)
        for (std::size_t f = 0; f < residuals.cols; ++f) {
            const double e = residuals(d, f) / spread_(d, f);
            if (!std::isnan(e)) sum += e * e;
        }
    return sum;
}

double Look::misfit_from(double day,
                         const std::vector<StockRecord::Change>& changes) const {
    return misfit_from(day, residuals(changes));
}

double Look::misfit_from(double day, const DaySums& other) const {
    return misfit_from(day, difference(sums_.measured, other.predicted));
}

}  // namespace bemcal::stock
