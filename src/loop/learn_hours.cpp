/// Learns hours by coordinate rounds: all runs of one schedule on one kind of days are
/// simulated, the parameters follow along their tangents, the best are calibrated, and
/// the one that explains most stays. Hours on and off have no useful tangent.
/// Follows from the loop's own -2 log likelihood with priors; hours as far from the usual
/// ones are as likely before the readings.
/// Left out: two runs a day, other hours by season, runs through midnight.
#include "loop/learn_hours.hpp"

#include "base/error.hpp"
#include "loop/hour_trials.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;
using physics::WeekHours;

/// Of -2 log prior: an hour that is not the usual one is as likely as exp(-1/4). Eight of
/// them are then seven times less likely, which a few weeks of readings outweigh.
constexpr double cost_of_hour = 0.5;
constexpr int most_rounds = 6;
constexpr double least_change = 0.1;  ///< of the cost, for hours to change: else rounds
                                      ///< go to and fro
constexpr study::FitOptions short_fit{4, 1e-3}, long_fit{8, 3e-4}, only_slopes{0, 0};

/// -2 log likelihood by the noise, with what the prior adds.
double cost_of(const LoopData& data, const std::vector<ChannelNoise>& noise,
               std::span<const study::FitUnknown> unknowns,
               std::span<const double> residuals, std::span<const double> x) {
    double cost = deviance(data.targets, noise, residuals);
    for (std::size_t k = 0; k < x.size(); ++k)
        if (unknowns[k].has_prior) cost += x[k] * x[k];
    return cost;
}

double cost_of(const LoopData& data, const std::vector<ChannelNoise>& noise,
               const Standing& standing) {
    return cost_of(data, noise, standing.built.unknowns, standing.residuals,
                   standing.fit.at.x);
}

/// A run, where the parameters would go with it, and what it costs there.
struct TriedRun {
    DailyRun run;
    double cost;  ///< with the prior of the run
    std::vector<double> x;
};

/// Lets the parameters of a model follow a change of what it predicts, along its
/// tangents.
class Follower {
  public:
    Follower(const LoopData& data, const std::vector<ChannelNoise>& noise,
             const Standing& standing)
        : data_(data),
          noise_(noise),
          standing_(standing),
          weights_(weights_of(data.targets, noise)),
          prior_(study::prior_diagonal(standing.built.unknowns)),
          matrix_(stats::normal_equations(derivatives(), standing.residuals, weights_)
                      .matrix) {}

    TriedRun follow(const DailyRun& run, std::span<const double> predicted) const {
        auto residuals = study::residuals_of(data_.targets.measured, predicted);
        std::vector<double> x = moved(residuals);
        const auto& from = standing_.fit.at.x;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double by = x[k] - from[k];
            const auto row = derivatives().row(k);
            for (std::size_t i = 0; i < residuals.size(); ++i)
                if (weights_[i] > 0) residuals[i] -= by * row[i];
        }
        const double cost =
            cost_of(data_, noise_, standing_.built.unknowns, residuals, x);
        return {run, cost, std::move(x)};
    }

  private:
    const Matrix& derivatives() const { return standing_.fit.at.derivatives; }

    std::vector<double> moved(std::span<const double> residuals) const {
        const auto& unknowns = standing_.built.unknowns;
        std::vector<double> x = standing_.fit.at.x, right(x.size(), 0.0),
                            diagonal = prior_;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const auto row = derivatives().row(k);
            for (std::size_t i = 0; i < residuals.size(); ++i)
                right[k] += weights_[i] * row[i] * residuals[i];
            right[k] -= prior_[k] * x[k];
            diagonal[k] += 1e-9;
        }
        const std::vector<double> by =
            stats::solve(matrix_, diagonal, right, standing_.fit.bound);
        for (std::size_t k = 0; k < x.size(); ++k)
            x[k] = std::clamp(x[k] + by[k], unknowns[k].lowest(), unknowns[k].highest());
        return x;
    }

    const LoopData& data_;
    const std::vector<ChannelNoise>& noise_;
    const Standing& standing_;
    std::vector<double> weights_, prior_;
    Matrix matrix_;
};

/// The first and last number between which 90 % of the weight lies.
std::pair<int, int> middle_of(const std::vector<double>& weights) {
    double all = 0;
    for (const double weight : weights) all += weight;
    int least = -1, most = 0;
    double below = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        if (below <= 0.95 * all && weights[k] > 0) most = static_cast<int>(k);
        below += weights[k];
        if (least < 0 && below >= 0.05 * all) least = static_cast<int>(k);
    }
    return {std::max(least, 0), most};
}

/// How certain the run with the least cost is, by what all of them cost.
LearnedRun certainty_of(const std::vector<TriedRun>& tried) {
    const auto best = std::ranges::min_element(tried, {}, &TriedRun::cost);
    LearnedRun learned{best->run, 0, {}, {}};
    double sum = 0;
    std::vector<double> begins(25, 0.0), ends(25, 0.0);
    for (const TriedRun& one : tried) {
        const double weight = std::exp(-0.5 * (one.cost - best->cost));
        sum += weight;
        if (one.run.is_off()) continue;
        begins[static_cast<std::size_t>(one.run.from)] += weight;
        ends[static_cast<std::size_t>(one.run.until)] += weight;
    }
    learned.probability = 1 / sum;
    std::tie(learned.least.from, learned.most.from) = middle_of(begins);
    std::tie(learned.least.until, learned.most.until) = middle_of(ends);
    return learned;
}

/// Schedules with their hours so far, and the model that stands with them.
class HourLearner {
  public:
    HourLearner(const LoopData& data, const Standing& plain)
        : data_(data), standing_(plain), place_(make_place(data, {}, data.drive)) {
        for (const study::UnknownHours& unknown : data.building.unknown_hours) {
            const std::string& name = data.building.profiles[unknown.profile].name;
            learned_.push_back(
                {unknown.profile, name, unknown.use, unknown.usual, {}, 0});
            hours_.push_back(unknown.usual);
            schedules_.emplace_back(data, unknown.profile);
        }
    }

    std::vector<LearnedHours> learn() {
        const double usual = cost_of(data_, standing_.noise, standing_);
        const std::vector<ChannelNoise> noise = standing_.noise;
        bool is_changed = true;
        for (int round = 0; round < most_rounds && is_changed; ++round) {
            is_changed = false;
            for (std::size_t kind = 0; kind < physics::n_day_kinds; ++kind)
                for (std::size_t s = 0; s < schedules_.size(); ++s)
                    is_changed |= learn(s, kind, round == 0);
            if (is_changed) settle_noise();
        }
        for (LearnedHours& learned : learned_)
            learned.evidence = usual - cost_of(data_, noise, standing_);
        return std::move(learned_);
    }

  private:
    /// The best run of a schedule on one kind of days; says whether it is another one.
    bool learn(std::size_t schedule, std::size_t kind, bool is_first) {
        const std::vector<TriedRun> tried = tried_from(standing_, schedule, kind);
        if (tried.empty()) return false;
        std::vector<TriedRun> best = best_of(tried);
        // Parameters may have gone where hours that are wrong have no effect: a set-back
        // of 0 K.
        if (is_first)
            if (const auto fresh = from_prior()) {
                const auto more = best_of(tried_from(*fresh, schedule, kind));
                best.insert(best.end(), more.begin(), more.end());
            }
        const DailyRun before = hours_[schedule][kind];
        take_best(best, schedule, kind);
        learned_[schedule].runs[kind] = certainty_of(tried);
        learned_[schedule].runs[kind].run = hours_[schedule][kind];
        return hours_[schedule][kind] != before;
    }

    std::vector<TriedRun> tried_from(const Standing& standing, std::size_t schedule,
                                     std::size_t kind) const {
        const Follower follower(data_, standing_.noise, standing);
        std::vector<TriedRun> tried;
        tried.reserve(physics::all_runs().size());
        try_runs({standing.built, schedules_[schedule], hours_[schedule]},
                 place_.channels, static_cast<DayKind>(kind), standing.fit.at.x,
                 [&](const DailyRun& run, std::span<const double> predicted) {
                     if (std::isnan(predicted[0])) return;
                     tried.push_back(follower.follow(run, predicted));
                     tried.back().cost += prior_of(run, schedule, kind);
                 });
        return tried;
    }

    double prior_of(const DailyRun& run, std::size_t schedule, std::size_t kind) const {
        return cost_of_hour * physics::hours_apart(run, learned_[schedule].usual[kind]);
    }

    /// The few that are calibrated.
    static std::vector<TriedRun> best_of(std::vector<TriedRun> tried) {
        constexpr std::size_t most_calibrated = 3;
        std::ranges::stable_sort(tried, {}, &TriedRun::cost);
        tried.resize(std::min(tried.size(), most_calibrated));
        return tried;
    }

    /// The model with the hours so far, at the prior's means.
    std::optional<Standing> from_prior() const {
        Standing fresh = standing_;
        refit(data_, fresh, std::vector<double>(fresh.fit.at.x.size(), 0.0), only_slopes);
        return fresh.fit.failed ? std::nullopt : std::optional(std::move(fresh));
    }

    void take_best(const std::vector<TriedRun>& best, std::size_t schedule,
                   std::size_t kind) {
        double least = cost_of(data_, standing_.noise, standing_) +
                       prior_of(hours_[schedule][kind], schedule, kind) - least_change;
        std::optional<Standing> chosen;
        WeekHours hours = hours_[schedule];
        for (const TriedRun& one : best) {
            WeekHours with = hours_[schedule];
            with[kind] = one.run;
            Standing tried = calibrated(schedule, with, one.x);
            if (tried.fit.failed) continue;
            const double cost = cost_of(data_, standing_.noise, tried) +
                                prior_of(one.run, schedule, kind);
            if (cost >= least) continue;
            least = cost;
            hours = with;
            chosen = std::move(tried);
        }
        if (!chosen) return;
        standing_ = std::move(*chosen);
        hours_[schedule] = hours;
        place_.drive = standing_.built.drive;
    }

    /// The model with other hours of a schedule, from a start.
    Standing calibrated(std::size_t schedule, const WeekHours& hours,
                        const std::vector<double>& start) const {
        Place place = place_;
        auto drive = std::make_shared<physics::Drive>(*place_.drive);
        std::ranges::copy(schedules_[schedule].row_of(hours),
                          drive->profiles.row(schedules_[schedule].profile()).begin());
        place.drive = std::move(drive);
        Standing standing{standing_.model, {}, {}, standing_.noise, {}, {}, 0};
        standing.built = build(place, standing.model.effects);
        refit(data_, standing, start, short_fit);
        return standing;
    }

    /// With better hours errors are smaller, and alike for shorter.
    void settle_noise() {
        refit(data_, standing_, standing_.fit.at.x, long_fit);
        standing_.noise = noise_of(data_, standing_.residuals);
        refit(data_, standing_, standing_.fit.at.x, long_fit);
    }

    const LoopData& data_;
    Standing standing_;
    Place place_;  ///< with the hours so far
    std::vector<ScheduleHours> schedules_;
    std::vector<WeekHours> hours_;
    std::vector<LearnedHours> learned_;
};

/// From here on hours are as good as certain.
constexpr double certain = 0.9;

}  // namespace

WeekHours LearnedHours::hours() const {
    WeekHours hours;
    for (std::size_t kind = 0; kind < hours.size(); ++kind) hours[kind] = runs[kind].run;
    return hours;
}

std::vector<LearnedHours> learn_hours(const LoopData& data, const Standing& plain) {
    return HourLearner(data, plain).learn();
}

study::Case with_hours(const study::Case& building,
                       const std::vector<LearnedHours>& learned) {
    study::Case made = building;
    for (const LearnedHours& one : learned)
        physics::set_hours(one.hours(), made.profiles[one.profile].schedule);
    return made;
}

std::string sentence_of(const LearnedHours& learned) {
    std::string unsure;
    for (std::size_t kind = 0; kind < physics::n_day_kinds; ++kind)
        if (learned.runs[kind].probability < certain)
            unsure += fmt::format("{}{} (probability {:.2f})", unsure.empty() ? "" : ", ",
                                  physics::name_of(static_cast<DayKind>(kind)),
                                  learned.runs[kind].probability);
    return fmt::format("schedule {}: {}; learned, nobody declared it{}{}", learned.name,
                       physics::sentence_of(learned.hours()),
                       unsure.empty() ? "" : "; not certain: ", unsure);
}

}  // namespace bemcal::loop
