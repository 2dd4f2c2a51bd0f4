/// Steps in a meter's scale: days where the week's level changes, four weeks on either
/// side compared by hour and kind of day, then proofs by scatter, years or rounding.
/// Our own rules, without a source. Left out: factors below 2, drifts, series that are 0
/// most of the time, temperatures. Whether to mend is the caller's.
#include "checks/data_steps.hpp"

#include "base/nan.hpp"
#include "checks/data_runs.hpp"

#include <algorithm>

namespace bemcal::checks {

namespace {

constexpr int step_window_d = 28, week_d = 7, year_d = 365;
constexpr double least_log = 0.6931471805599453;  ///< factor 2
constexpr double most_spread = 0.3;     ///< of hours of day about the step's logarithm
constexpr double most_residual = 0.35;  ///< of the days beside the step
constexpr double least_hits = 0.85;     ///< readings of the weeks beside it on their side
constexpr double least_unproven_log = 2.0794415416798357;  ///< factor 8
constexpr double least_scatter = 0.05;
constexpr std::size_t enough_d = 300;   ///< of a year, to know its seasons
constexpr double most_of_season = 0.4;  ///< of the step's logarithm
constexpr double most_of_quantum = 0.2;

/// Logarithm of the readings above 0; NaN elsewhere.
std::vector<double> logarithms(const DataSeries& series) {
    std::vector<double> logs(series.values.size());
    for (std::size_t k = 0; k < logs.size(); ++k)
        logs[k] = series.values[k] > 0 ? std::log(series.values[k]) : nan;
    return logs;
}

class StepSearch {
  public:
    explicit StepSearch(const DataSeries& series)
        : series_(series), logs_(logarithms(series)), day_(series.per_day) {
        for (int first = 0; first + day_ <= series.size(); first += day_)
            levels_.push_back(median(first, first + day_, day_ / 2));
    }

    std::vector<ScaleStep> search() const {
        std::vector<ScaleStep> steps;
        for (const int day : candidates()) {
            ScaleStep step;
            if (!is_step(day * day_, step)) continue;
            if (steps.empty() || step.at - steps.back().at >= step_window_d * day_)
                steps.push_back(step);
        }
        std::vector<ScaleStep> proven;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Years years = years_around(steps, i);
            if (years == Years::differ) continue;
            ScaleStep& step = steps[i];
            if (scatter_agrees(step)) step.proof = Proof::scatter;
            if (years == Years::agree) step.proof = Proof::years;
            if (quantum_agrees(step)) step.proof = Proof::quantum;
            if (series_.driver == Driver::people || step.proof > Proof::scatter ||
                (step.proof == Proof::scatter &&
                 std::abs(std::log(step.ratio)) > least_unproven_log))
                proven.push_back(step);
        }
        return proven;
    }

  private:
    /// Median logarithm by step of the day, working days first, then weekends.
    using Profile = std::vector<double>;

    double median(int from, int to, int least) const {
        std::vector<double> known;
        for (int k = std::max(from, 0); k < std::min(to, series_.size()); ++k)
            if (!std::isnan(logs_[static_cast<std::size_t>(k)]))
                known.push_back(logs_[static_cast<std::size_t>(k)]);
        return static_cast<int>(known.size()) < least
                   ? nan
                   : quantile_of(std::move(known), 0.5);
    }

    std::vector<double> levels_between(int from, int to) const {
        std::vector<double> known;
        for (int d = std::max(from, 0);
             d < std::min<int>(to, static_cast<int>(levels_.size())); ++d)
            if (!std::isnan(levels_[static_cast<std::size_t>(d)]))
                known.push_back(levels_[static_cast<std::size_t>(d)]);
        return known;
    }

    /// Change of the level from the week before a day to the week after.
    double weekly_change(int day) const {
        const auto before = levels_between(day - week_d, day);
        const auto after = levels_between(day, day + week_d);
        if (before.size() < 4 || after.size() < 4) return nan;
        return quantile_of(after, 0.5) - quantile_of(before, 0.5);
    }

    /// Days with the largest change of their week.
    std::vector<int> candidates() const {
        const int n = static_cast<int>(levels_.size());
        std::vector<double> change;
        change.reserve(levels_.size());
        for (int d = 0; d < n; ++d) change.push_back(std::abs(weekly_change(d)));
        std::vector<int> days;
        for (int d = 0; d < n; ++d) {
            if (!(change[static_cast<std::size_t>(d)] > 0.8 * least_log)) continue;
            const auto first = change.begin() + std::max(d - 3, 0);
            const auto last = change.begin() + std::min(d + 4, n);
            const auto larger = [&](double c) {
                return c > change[static_cast<std::size_t>(d)];
            };
            if (std::none_of(first, last, larger)) days.push_back(d);
        }
        return days;
    }

    std::size_t slot(int k) const {
        return static_cast<std::size_t>(series_.slot(k) +
                                        (series_.weekday(k) > 4 ? day_ : 0));
    }

    /// Empty where fewer than 4 readings of a step are above 0, or a third of all are 0.
    Profile profile(int from, int to) const {
        std::vector<std::vector<double>> by_slot(static_cast<std::size_t>(2 * day_));
        int zeros = 0, n = 0;
        for (int k = std::max(from, 0); k < std::min(to, series_.size()); ++k) {
            if (std::isnan(series_.at(k))) continue;
            ++n;
            if (series_.at(k) > 0)
                by_slot[slot(k)].push_back(logs_[static_cast<std::size_t>(k)]);
            else
                ++zeros;
        }
        Profile result;
        result.reserve(by_slot.size());
        for (auto& readings : by_slot) {
            if (readings.size() < 4 || 3 * zeros > n) return {};
            result.push_back(quantile_of(std::move(readings), 0.5));
        }
        return result;
    }

    double residual(int k, const Profile& profile) const {
        return logs_[static_cast<std::size_t>(k)] - profile[slot(k)];
    }

    /// The reading at which the sum of distances to the profiles of both sides is least.
    int refined(int near, const Profile& before, const Profile& after) const {
        const int from = std::max(near - week_d * day_, 0);
        const int to = std::min(near + week_d * day_, series_.size());
        double sum = 0, least = 0;
        int best = from;
        for (int k = from; k < to; ++k) {
            if (!std::isnan(logs_[static_cast<std::size_t>(k)]))
                sum += std::abs(residual(k, before)) - std::abs(residual(k, after));
            if (sum < least) {
                least = sum;
                best = k + 1;
            }
        }
        return best;
    }

    /// Share of readings in [from, to) that are nearer to `own` than to `other`.
    double hits(int from, int to, const Profile& own, const Profile& other) const {
        int n = 0, nearer = 0;
        for (int k = std::max(from, 0); k < std::min(to, series_.size()); ++k) {
            if (std::isnan(logs_[static_cast<std::size_t>(k)])) continue;
            ++n;
            nearer += std::abs(residual(k, own)) < std::abs(residual(k, other)) ? 1 : 0;
        }
        return n > 0 ? 1.0 * nearer / n : 0;
    }

    double median_residual(int from, int to, const Profile& profile) const {
        std::vector<double> known;
        for (int k = std::max(from, 0); k < std::min(to, series_.size()); ++k)
            if (!std::isnan(logs_[static_cast<std::size_t>(k)]))
                known.push_back(residual(k, profile));
        return quantile_of(std::move(known), 0.5);
    }

    bool is_step(int near, ScaleStep& step) const {
        const int window = step_window_d * day_, week = week_d * day_;
        Profile before = profile(near - window, near),
                after = profile(near, near + window);
        if (before.empty() || after.empty()) return false;
        const int at = refined(near, before, after);
        before = profile(at - window, at);
        after = profile(at, at + window);
        if (before.empty() || after.empty() || !same_shape(before, after)) return false;
        const double change = quantile_of(differences(before, after), 0.5);
        const auto small = [&](double value) {
            return std::abs(value) < most_residual * std::abs(change);
        };
        if (hits(at - week, at, before, after) < least_hits ||
            hits(at, at + week, after, before) < least_hits ||
            !small(median_residual(at - 3 * day_, at, before)) ||
            !small(median_residual(at, at + 3 * day_, after)) ||
            !stays(at, before, after))
            return false;
        step.at = at;
        step.ratio = std::exp(median(at, at + week, 1) - median(at - week, at, 1));
        return std::abs(std::log(step.ratio)) > least_log;
    }

    static std::vector<double> differences(const Profile& before, const Profile& after) {
        std::vector<double> result;
        result.reserve(before.size());
        for (std::size_t i = 0; i < before.size(); ++i)
            result.push_back(after[i] - before[i]);
        return result;
    }

    static bool same_shape(const Profile& before, const Profile& after) {
        const std::vector<double> change = differences(before, after);
        const double middle = quantile_of(change, 0.5);
        if (std::abs(middle) < least_log) return false;
        return std::abs(quantile_of(change, 0.05) - middle) < most_spread &&
               std::abs(quantile_of(change, 0.95) - middle) < most_spread;
    }

    /// The four weeks beyond, where there are any, are nearer to their own side.
    bool stays(int at, const Profile& before, const Profile& after) const {
        const int window = step_window_d * day_;
        const auto beyond = [&](int from, int to, const Profile& own,
                                const Profile& other) {
            if (from < 0 || to > series_.size()) return true;
            if (std::isnan(median(from, to, window / 3))) return true;
            return hits(from, to, own, other) > 0.7;
        };
        return beyond(at + window, at + 2 * window, after, before) &&
               beyond(at - 2 * window, at - window, before, after);
    }

    enum class Years { unknown, agree, differ };

    /// Low and high season of up to a year on either side, cut at other steps.
    Years years_around(const std::vector<ScaleStep>& steps, std::size_t i) const {
        const int at = steps[i].at / day_;
        const int first = i > 0 ? steps[i - 1].at / day_ + 1 : 0;
        const int last = i + 1 < steps.size() ? steps[i + 1].at / day_
                                              : static_cast<int>(levels_.size());
        const auto before = levels_between(std::max(first, at - year_d), at);
        const auto after = levels_between(at + 1, std::min(last, at + 1 + year_d));
        if (before.size() < enough_d || after.size() < enough_d) return Years::unknown;
        const double change = std::log(steps[i].ratio);
        for (const double p : {0.1, 0.9}) {
            const double of_season = quantile_of(after, p) - quantile_of(before, p);
            if (std::abs(of_season - change) > most_of_season * std::abs(change))
                return Years::differ;
        }
        return Years::agree;
    }

    /// Change of the level from day to day, its median size.
    double scatter(int from, int to) const {
        std::vector<double> changes;
        for (int d = std::max(from, 0) + 1;
             d < std::min(to, static_cast<int>(levels_.size())); ++d) {
            const auto at = static_cast<std::size_t>(d);
            const double change = std::abs(levels_[at] - levels_[at - 1]);
            if (!std::isnan(change)) changes.push_back(change);
        }
        return quantile_of(std::move(changes), 0.5);
    }

    /// Weather moves the days on both sides, and alike: of base load and heating season
    /// it moves one only.
    bool scatter_agrees(const ScaleStep& step) const {
        const int at = step.at / day_;
        const double before = scatter(at - step_window_d, at);
        const double after = scatter(at + 1, at + 1 + step_window_d);
        return std::min(before, after) > least_scatter &&
               std::max(before, after) < 2 * std::min(before, after);
    }

    /// Of four weeks on either side.
    bool quantum_agrees(const ScaleStep& step) const {
        const auto window = static_cast<std::size_t>(step_window_d * day_);
        const auto at = static_cast<std::size_t>(step.at);
        const auto from = at > window ? at - window : 0;
        const double before = quantum_of(series_.values.subspan(from, at - from));
        const double after = quantum_of(
            series_.values.subspan(at, std::min(window, series_.values.size() - at)));
        return before > 0 && after > 0 &&
               std::abs(std::log(after / before / step.ratio)) < most_of_quantum;
    }

    const DataSeries& series_;
    std::vector<double> logs_;
    int day_;
    std::vector<double> levels_;  ///< median logarithm of each day
};

}  // namespace

std::vector<ScaleStep> scale_steps(const DataSeries& series) {
    if (series.driver == Driver::temperature || series.size() < 2 * series.per_day)
        return {};
    return StepSearch(series).search();
}

}  // namespace bemcal::checks
