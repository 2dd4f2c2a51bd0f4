/// Takes one step of a search for hours: all runs of one schedule on one kind of days are
/// simulated, the parameters follow along their tangents, the best are calibrated, and
/// the one that explains most stays. Hours on and off have no useful tangent.
/// Follows from the loop's own -2 log likelihood with priors.
/// Left out: two runs a day, other hours by season, runs through midnight.
#include "loop/hour_search.hpp"

#include "loop/decisions.hpp"
#include "stats/least_squares.hpp"
#include "stats/sums.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;
using physics::WeekHours;

constexpr study::FitOptions short_fit{4, 1e-3};

/// Lets the parameters of a model follow a change of what it predicts, along its
/// tangents. Residuals are seen through their products with these, channel by channel:
/// squares of what is left when the parameters have moved follow from that.
class Follower {
  public:
    Follower(const LoopData& data, const std::vector<ChannelNoise>& noise,
             const Standing& standing)
        : targets_(data.targets),
          noise_(noise),
          standing_(standing),
          slopes_(standing.fit.at.derivatives),
          matrix_(slopes_.rows, slopes_.rows) {
        for (std::size_t p = 0; p < slopes_.rows; ++p)
            for (std::size_t k = 0; k < slopes_.cols; ++k)
                if (std::isnan(targets_.measured[k])) slopes_(p, k) = 0;
        for (std::size_t c = 0; c < targets_.n_channels(); ++c) add_channel(c);
        diagonal_ = study::prior_diagonal(standing.built.unknowns);
        for (double& entry : diagonal_) entry += 1e-9;
    }

    TriedRun follow(const DailyRun& run, std::span<const double> predicted) const {
        const auto residuals = study::residuals_of(targets_.measured, predicted);
        const std::vector<Products> products = products_of(residuals);
        const std::vector<double> by = moves_by(products);
        std::vector<double> x = standing_.fit.at.x, squares;
        for (std::size_t p = 0; p < x.size(); ++p) x[p] += by[p];
        for (std::size_t c = 0; c < targets_.n_channels(); ++c) {
            const double left = products[c].with_itself -
                                2 * dot(by, products[c].with_slopes) +
                                squared(by, grams_[c]);
            squares.push_back(n_[c] > 0 ? std::max(0.0, left) / n_[c] : 0);
        }
        const double cost = deviance_of_squares(targets_, noise_, squares) +
                            prior_pull(standing_.built.unknowns, x);
        return {run, cost, std::move(x)};
    }

  private:
    /// Of a channel's residuals.
    struct Products {
        std::vector<double> with_slopes;  ///< [parameters]
        double with_itself;
    };

    void add_channel(std::size_t c) {
        stats::Rows& rows = rows_.emplace_back();
        for (std::size_t p = 0; p < slopes_.rows; ++p)
            rows.push_back(targets_.of(c, slopes_.row(p)).data());
        const auto measured = targets_.of(c, targets_.measured);
        Matrix gram(slopes_.rows, slopes_.rows);
        gram.values =
            stats::weighted_gram(rows, std::vector<double>(measured.size(), 1.0));
        for (std::size_t k = 0; k < gram.values.size(); ++k)
            matrix_.values[k] += noise_[c].weight() * gram.values[k];
        grams_.push_back(std::move(gram));
        n_.push_back(static_cast<double>(std::ranges::count_if(
            measured, [](double value) { return !std::isnan(value); })));
    }

    /// [channels]
    std::vector<Products> products_of(std::span<const double> residuals) const {
        std::vector<Products> all;
        for (std::size_t c = 0; c < targets_.n_channels(); ++c) {
            const auto own = targets_.of(c, residuals);
            stats::Rows rows = rows_[c];
            rows.push_back(own.data());
            Products& of_channel = all.emplace_back(stats::products(rows, own), 0.0);
            of_channel.with_itself = of_channel.with_slopes.back();
            of_channel.with_slopes.pop_back();
        }
        return all;
    }

    static double dot(std::span<const double> a, std::span<const double> b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    }

    static double squared(std::span<const double> by, const Matrix& gram) {
        double sum = 0;
        for (std::size_t p = 0; p < by.size(); ++p) sum += by[p] * dot(gram.row(p), by);
        return sum;
    }

    /// By how much the parameters move, within their ranges.
    std::vector<double> moves_by(const std::vector<Products>& products) const {
        const auto& unknowns = standing_.built.unknowns;
        const auto& x = standing_.fit.at.x;
        std::vector<double> right(x.size(), 0.0);
        for (std::size_t p = 0; p < x.size(); ++p) {
            for (std::size_t c = 0; c < products.size(); ++c)
                right[p] += noise_[c].weight() * products[c].with_slopes[p];
            if (unknowns[p].has_prior) right[p] -= x[p];
        }
        std::vector<double> by =
            stats::solve(matrix_, diagonal_, right, standing_.fit.bound);
        for (std::size_t p = 0; p < x.size(); ++p)
            by[p] =
                std::clamp(x[p] + by[p], unknowns[p].lowest(), unknowns[p].highest()) -
                x[p];
        return by;
    }

    const study::Targets& targets_;
    const std::vector<ChannelNoise>& noise_;
    const Standing& standing_;
    Matrix slopes_;  ///< 0 where nothing is measured [parameters x targets]
    std::vector<stats::Rows> rows_;  ///< [channels] of slopes_
    std::vector<Matrix> grams_;      ///< [channels] of the slopes
    std::vector<double> n_;          ///< [channels] readings
    Matrix matrix_;
    std::vector<double> diagonal_;
};

/// The few that are calibrated: of those that explain more than the run so far, before
/// their priors are counted.
std::vector<TriedRun> best_of(std::vector<TriedRun> tried, const DailyRun& so_far,
                              const std::function<double(const DailyRun&)>& prior) {
    const auto own = std::ranges::find(tried, so_far, &TriedRun::run);
    if (own != tried.end()) {
        const double least = own->cost - prior(so_far);
        std::erase_if(tried, [&](const TriedRun& one) {
            return one.run == so_far || one.cost - prior(one.run) >= least;
        });
    }
    std::ranges::stable_sort(tried, {}, &TriedRun::cost);
    tried.resize(std::min(tried.size(), decisions::most_runs_calibrated));
    return tried;
}

bool is_among(const std::vector<TriedRun>& tried, const DailyRun& run) {
    return std::ranges::find(tried, run, &TriedRun::run) != tried.end();
}

/// The runs that were left out between those that were tried and the best of them, and
/// those beside the run so far.
std::vector<RunGrid> beside_the_best(std::vector<TriedRun> tried,
                                     const DailyRun& so_far) {
    constexpr int by = decisions::hours_apart_at_first - 1;
    std::ranges::stable_sort(tried, {}, &TriedRun::cost);
    tried.resize(std::min(tried.size(), decisions::most_runs_calibrated));
    std::vector<DailyRun> centres{so_far};
    for (const TriedRun& one : tried) centres.push_back(one.run);
    std::vector<RunGrid> grids;
    for (const DailyRun& run : centres) {
        if (run.is_off()) continue;
        grids.push_back({std::max(run.from - by, 0), run.from + by,
                         std::max(run.until - by, 0), std::min(run.until + by, 24), 1});
    }
    return grids;
}

}  // namespace

double cost_of(const LoopData& data, const std::vector<ChannelNoise>& noise,
               const Standing& standing) {
    return deviance(data.targets, noise, standing.residuals) +
           prior_pull(standing.built.unknowns, standing.fit.at.x);
}

HourSearch::HourSearch(const LoopData& data, const Place& place, const Standing& standing,
                       std::vector<SearchedSchedule> schedules, CostOfRun prior,
                       Tries tries)
    : data_(data),
      place_(place),
      standing_(standing),
      schedules_(std::move(schedules)),
      prior_(std::move(prior)),
      tries_(tries) {}

std::vector<TriedRun> HourSearch::improve(std::size_t schedule, DayKind kind,
                                          bool from_prior) {
    std::vector<TriedRun> tried = tried_from(standing_, schedule, kind);
    if (tried.empty()) return tried;
    const DailyRun so_far = run_so_far(schedule, kind);
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
    refit(data_, standing_, to_settle);
    standing_.noise = noise_of(data_, standing_.residuals);
    refit(data_, standing_, to_settle);
}

std::vector<TriedRun> HourSearch::tried_from(const Standing& standing,
                                             std::size_t schedule, DayKind kind) const {
    const Follower follower(data_, standing_.noise, standing);
    const HourModel model{standing.built, schedules_[schedule].schedule,
                          schedules_[schedule].hours};
    std::vector<TriedRun> tried;
    const auto try_grid = [&](const RunGrid& grid) {
        try_runs(model, place_.channels, kind, grid, standing.fit.at.x,
                 [&](const DailyRun& run, std::span<const double> predicted) {
                     if (std::isnan(predicted[0]) || is_among(tried, run)) return;
                     tried.push_back(follower.follow(run, predicted));
                     tried.back().cost += prior_of(run, schedule, kind);
                 });
    };
    if (tries_ == Tries::all) {
        try_grid({});
        return tried;
    }
    RunGrid every_second;
    every_second.apart = decisions::hours_apart_at_first;
    try_grid(every_second);
    for (const RunGrid& near : beside_the_best(tried, run_so_far(schedule, kind)))
        try_grid(near);
    return tried;
}

const DailyRun& HourSearch::run_so_far(std::size_t schedule, DayKind kind) const {
    return schedules_[schedule].hours[static_cast<std::size_t>(kind)];
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
    refit(data_, fresh, std::move(start), only_derivatives);
    return fresh.fit.failed ? std::nullopt : std::optional(std::move(fresh));
}

void HourSearch::take_best(const std::vector<TriedRun>& best, std::size_t schedule,
                           DayKind kind) {
    WeekHours& hours = schedules_[schedule].hours;
    const auto k = static_cast<std::size_t>(kind);
    double least = cost_of(data_, standing_.noise, standing_) +
                   prior_of(hours[k], schedule, kind) - decisions::least_change_of_hours;
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
