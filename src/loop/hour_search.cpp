/// Takes one step of a search for hours: all runs of one schedule on one kind of days are
/// simulated, the parameters follow along their tangents, the best are calibrated, and
/// the one that explains most stays. Hours on and off have no useful tangent.
/// Follows from the loop's own -2 log likelihood with priors.
/// Left out: two runs a day, other hours by season, runs through midnight.
#include "loop/hour_search.hpp"

#include "stats/least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;
using physics::WeekHours;

constexpr study::FitOptions short_fit{4, 1e-3}, long_fit{8, 3e-4}, only_slopes{0, 0};

double cost_at(const LoopData& data, const std::vector<ChannelNoise>& noise,
               std::span<const study::FitUnknown> unknowns,
               std::span<const double> residuals, std::span<const double> x) {
    double cost = deviance(data.targets, noise, residuals);
    for (std::size_t k = 0; k < x.size(); ++k)
        if (unknowns[k].has_prior) cost += x[k] * x[k];
    return cost;
}

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
            cost_at(data_, noise_, standing_.built.unknowns, residuals, x);
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

/// The few that are calibrated: of those that explain more than the run so far, before
/// their priors are counted.
std::vector<TriedRun> best_of(std::vector<TriedRun> tried, const DailyRun& so_far,
                              const std::function<double(const DailyRun&)>& prior) {
    constexpr std::size_t most_calibrated = 3;
    const auto own = std::ranges::find(tried, so_far, &TriedRun::run);
    if (own != tried.end()) {
        const double least = own->cost - prior(so_far);
        std::erase_if(tried, [&](const TriedRun& one) {
            return one.run == so_far || one.cost - prior(one.run) >= least;
        });
    }
    std::ranges::stable_sort(tried, {}, &TriedRun::cost);
    tried.resize(std::min(tried.size(), most_calibrated));
    return tried;
}

}  // namespace

double cost_of(const LoopData& data, const std::vector<ChannelNoise>& noise,
               const Standing& standing) {
    return cost_at(data, noise, standing.built.unknowns, standing.residuals,
                   standing.fit.at.x);
}

HourSearch::HourSearch(const LoopData& data, const Place& place, const Standing& standing,
                       std::vector<SearchedSchedule> schedules, CostOfRun prior)
    : data_(data),
      place_(place),
      standing_(standing),
      schedules_(std::move(schedules)),
      prior_(std::move(prior)) {}

std::vector<TriedRun> HourSearch::improve(std::size_t schedule, DayKind kind,
                                          bool from_prior) {
    std::vector<TriedRun> tried = tried_from(standing_, schedule, kind);
    if (tried.empty()) return tried;
    const DailyRun so_far = schedules_[schedule].hours[static_cast<std::size_t>(kind)];
    const auto prior = [&](const DailyRun& run) { return prior_of(run, schedule, kind); };
    std::vector<TriedRun> best = best_of(tried, so_far, prior);
    // Parameters may have gone where hours that are wrong have no effect: a set-back of
    // 0 K.
    if (from_prior)
        if (const auto fresh = at_prior()) {
            const auto more = best_of(tried_from(*fresh, schedule, kind), so_far, prior);
            best.insert(best.end(), more.begin(), more.end());
        }
    take_best(best, schedule, kind);
    return tried;
}

void HourSearch::settle_noise() {
    refit(data_, standing_, standing_.fit.at.x, long_fit);
    standing_.noise = noise_of(data_, standing_.residuals);
    refit(data_, standing_, standing_.fit.at.x, long_fit);
}

std::vector<TriedRun> HourSearch::tried_from(const Standing& standing,
                                             std::size_t schedule, DayKind kind) const {
    const Follower follower(data_, standing_.noise, standing);
    std::vector<TriedRun> tried;
    tried.reserve(physics::all_runs().size());
    try_runs({standing.built, schedules_[schedule].schedule, schedules_[schedule].hours},
             place_.channels, kind, standing.fit.at.x,
             [&](const DailyRun& run, std::span<const double> predicted) {
                 if (std::isnan(predicted[0])) return;
                 tried.push_back(follower.follow(run, predicted));
                 tried.back().cost += prior_of(run, schedule, kind);
             });
    return tried;
}

double HourSearch::prior_of(const DailyRun& run, std::size_t schedule,
                            DayKind kind) const {
    return prior_(run, schedules_[schedule].from[static_cast<std::size_t>(kind)]);
}

/// The model with the hours so far; effects stay as they are.
std::optional<Standing> HourSearch::at_prior() const {
    Standing fresh = standing_;
    std::vector<double> start(fresh.fit.at.x.size(), 0.0);
    for (std::size_t k = fresh.built.first_effect(); k < start.size(); ++k)
        start[k] = fresh.fit.at.x[k];
    refit(data_, fresh, std::move(start), only_slopes);
    return fresh.fit.failed ? std::nullopt : std::optional(std::move(fresh));
}

void HourSearch::take_best(const std::vector<TriedRun>& best, std::size_t schedule,
                           DayKind kind) {
    constexpr double least_change = 0.1;  ///< of the cost: else rounds go to and fro
    WeekHours& hours = schedules_[schedule].hours;
    const auto k = static_cast<std::size_t>(kind);
    double least = cost_of(data_, standing_.noise, standing_) +
                   prior_of(hours[k], schedule, kind) - least_change;
    std::optional<Standing> chosen;
    DailyRun taken = hours[k];
    for (const TriedRun& one : best) {
        WeekHours with = hours;
        with[k] = one.run;
        Standing tried = calibrated(schedule, with, one.x);
        if (tried.fit.failed) continue;
        const double cost =
            cost_of(data_, standing_.noise, tried) + prior_of(one.run, schedule, kind);
        if (cost >= least) continue;
        least = cost;
        taken = one.run;
        chosen = std::move(tried);
    }
    if (!chosen) return;
    hours[k] = taken;
    standing_ = std::move(*chosen);
    place_.drive = standing_.built.drive;
}

/// The model with other hours of a schedule, from a start.
Standing HourSearch::calibrated(std::size_t schedule, const WeekHours& hours,
                                const std::vector<double>& start) const {
    const ScheduleHours& own = schedules_[schedule].schedule;
    Place place = place_;
    auto drive = std::make_shared<physics::Drive>(*place_.drive);
    std::ranges::copy(own.row_of(hours), drive->profiles.row(own.profile()).begin());
    place.drive = std::move(drive);
    Standing standing{standing_.model, {}, {}, standing_.noise, {}, {}, 0};
    standing.built = build(place, standing.model.effects);
    refit(data_, standing, start, short_fit);
    return standing;
}

}  // namespace bemcal::loop
