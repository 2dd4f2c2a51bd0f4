/// Reads runs as meters would, ranks them by the deviance that the loop uses, and fits
/// parameters and scales of effects through an emulator of the readings.
/// Sources: emulator/series_emulator and series_fit. An effect's scale is one more
/// coordinate of the emulator: 0 in runs without it.
/// Parameters have no prior but their ranges.
#include "loop/simulator_runs.hpp"

#include "emulator/series_fit.hpp"
#include "loop/decisions.hpp"
#include "loop/simulator_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::loop {
namespace {

using decisions::largest_scale, decisions::least_fall_around;
using decisions::runs_of_trial, decisions::runs_of_doubt;

/// Of a parameter, whose range is 1 long.
constexpr emulator::ScaledPrior of_parameter{decisions::centre_of_parameter,
                                             decisions::sd_of_parameter};
/// Of the scale of an effect that is left out: so narrow that the readings have no say.
constexpr emulator::ScaledPrior held_at_0{0, 1e-6};

std::vector<emulator::ChannelRange> ranges_of(const study::Targets& targets) {
    std::vector<emulator::ChannelRange> ranges;
    ranges.reserve(targets.n_channels());
    for (std::size_t c = 0; c < targets.n_channels(); ++c)
        ranges.push_back({targets.first[c], targets.first[c + 1] - targets.first[c]});
    return ranges;
}

/// Of those that are 1.
std::vector<std::size_t> places_of(const std::vector<char>& flags) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < flags.size(); ++k)
        if (flags[k] != 0) places.push_back(k);
    return places;
}

/// Whether it has an effect beside those.
bool has_others(const SimulatorRun& run, const KeptEffects& kept) {
    for (std::size_t k = 0; k < run.scales.size(); ++k)
        if (run.scales[k] != 0 && (k >= kept.size() || kept[k] == 0)) return true;
    return false;
}

}  // namespace

RunsSoFar::RunsSoFar(const LoopData& data, const std::vector<SimulatorRun>& runs)
    : data_(data), runs_(runs) {
    const std::size_t training = place_of_training(data);
    for (const SimulatorRun& run : runs)
        readings_.push_back(run.failure.empty() && run.asked[training] != 0
                                ? readings_from(data, run.hours)
                                : std::vector<double>{});
    // All are compared by the noise of one: of the first, then of the best by that.
    rank_by(0);
    if (const auto nearest = best()) rank_by(*nearest);
}

std::vector<double> RunsSoFar::residuals_of(std::size_t run) const {
    return study::residuals_of(data_.targets.measured, readings_[run]);
}

void RunsSoFar::rank_by(std::size_t run) {
    deviances_.assign(runs_.size(), std::numeric_limits<double>::infinity());
    std::vector<ChannelNoise> noise;
    for (std::size_t k = run; k < runs_.size() && noise.empty(); ++k)
        if (!readings_[k].empty()) noise = noise_of(data_, residuals_of(k));
    for (std::size_t k = 0; k < runs_.size(); ++k)
        if (!readings_[k].empty())
            deviances_[k] = deviance(data_.targets, noise, residuals_of(k));
}

std::vector<std::size_t> RunsSoFar::usable(const KeptEffects& kept) const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < runs_.size(); ++k)
        if (std::isfinite(deviances_[k]) && !has_others(runs_[k], kept)) all.push_back(k);
    return all;
}

bool RunsSoFar::are_enough() const {
    const std::size_t n = usable({}).size();
    return n > 0 && n >= emulator::least_runs(runs_[0].point.size());
}

std::optional<std::size_t> RunsSoFar::best(const KeptEffects& kept) const {
    const std::vector<std::size_t> all = usable(kept);
    if (all.empty()) return std::nullopt;
    return *std::ranges::min_element(all, {},
                                     [&](std::size_t run) { return deviances_[run]; });
}

ReportedRuns RunsSoFar::reported(const KeptEffects& kept) const {
    ReportedRuns reported;
    reported[StoredLoop::before] = best();
    if (runs_[0].failure.empty()) reported[StoredLoop::plain] = 0;
    reported[StoredLoop::after] = best(kept);
    return reported;
}

double RunsSoFar::least_deviance(const KeptEffects& kept) const {
    const auto nearest = best(kept);
    return nearest ? deviances_[*nearest] : std::numeric_limits<double>::infinity();
}

/// By the residuals of the best run. [targets] 1 / standard deviation
std::vector<double> RunsSoFar::weights(const KeptEffects& kept) const {
    std::vector<double> weights =
        weights_of(data_.targets, noise_of(data_, residuals_of(best(kept).value_or(0))));
    for (double& weight : weights) weight = std::sqrt(weight);
    return weights;
}

/// The scales of those kept are coordinates, too.
emulator::SeriesEmulator RunsSoFar::emulator_of(
    const KeptEffects& kept, const std::vector<double>& weights) const {
    const std::size_t p = runs_[0].point.size();
    const auto used = usable(kept), fitted = places_of(kept);
    Matrix points(used.size(), p + fitted.size()),
        series(used.size(), data_.targets.size());
    for (std::size_t r = 0; r < used.size(); ++r) {
        const SimulatorRun& run = runs_[used[r]];
        std::ranges::copy(run.point, points.row(r).begin());
        for (std::size_t k = 0; k < fitted.size() && !run.scales.empty(); ++k)
            points(r, p + k) = run.scales[fitted[k]] / largest_scale;
        std::ranges::copy(readings_[used[r]], series.row(r).begin());
    }
    return {points, std::move(series), weights, emulator::usual_share,
            ranges_of(data_.targets)};
}

NextRuns RunsSoFar::next(std::size_t n, const KeptEffects& kept,
                         std::optional<std::size_t> without) const {
    const std::size_t p = runs_[0].point.size();
    const auto fitted = places_of(kept);
    std::vector<emulator::ScaledPrior> priors(p, of_parameter);
    priors.resize(p + fitted.size(), {decisions::usual_scale / largest_scale,
                                      decisions::sd_of_scale / largest_scale});
    for (std::size_t k = 0; k < fitted.size(); ++k)
        if (fitted[k] == without) priors[p + k] = held_at_0;
    const auto weighing = weights(kept);
    const auto fit = emulator::fit_series(emulator_of(kept, weighing),
                                          data_.targets.measured, weighing, priors);
    const Matrix proposed = emulator::next_points(fit, n);
    NextRuns next{Matrix(n, p), Matrix(n, kept.size())};
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t k = 0; k < p; ++k) next.points(r, k) = proposed(r, k);
        for (std::size_t k = 0; k < fitted.size(); ++k)
            next.scales(r, fitted[k]) =
                fitted[k] == without ? 0 : largest_scale * proposed(r, p + k);
    }
    return next;
}

/// Least deviance of some runs in a row.
double RunsSoFar::nearest_of(std::size_t first, std::size_t n) const {
    const auto from = deviances_.begin() + static_cast<std::ptrdiff_t>(first);
    return *std::min_element(from, from + static_cast<std::ptrdiff_t>(n));
}

Judged RunsSoFar::judge_effects(std::size_t first, std::size_t n_effects,
                                std::size_t n_refinement) const {
    Judged judged;
    double least = least_deviance();
    std::size_t at = first;
    for (; judged.kept.size() < n_effects; at += runs_of_trial) {
        if (at + runs_of_trial > runs_.size()) return judged;
        const double with = nearest_of(at, runs_of_trial);
        const bool is_kept = least - with >= least_fall_around;
        judged.kept.push_back(is_kept ? 1 : 0);
        if (is_kept) least = with;
    }
    judged.is_over = places_of(judged.kept).empty();
    if (judged.is_over || at + n_refinement > runs_.size()) return judged;
    at += n_refinement;
    for (std::size_t k = n_effects; k-- > 0;) {
        if (judged.kept[k] == 0) continue;
        judged.in_doubt = k;
        if (at + runs_of_doubt > runs_.size()) return judged;
        const double without = nearest_of(at, runs_of_doubt);
        at += runs_of_doubt;
        if (without - least_deviance(judged.kept) < least_fall_around) judged.kept[k] = 0;
    }
    judged.in_doubt.reset();
    judged.is_over = true;
    // Doubts of the others may have come nearest without one that had stayed.
    if (const auto nearest = best(judged.kept)) {
        std::vector<double> scales = runs_[*nearest].scales;
        scales.resize(n_effects, 0.0);
        for (std::size_t k = 0; k < n_effects; ++k)
            if (scales[k] == 0) judged.kept[k] = 0;
    }
    return judged;
}

std::vector<double> RunsSoFar::emulator_error(const KeptEffects& kept) const {
    return emulator_of({}, weights(kept)).leave_one_out(ranges_of(data_.targets));
}

}  // namespace bemcal::loop
