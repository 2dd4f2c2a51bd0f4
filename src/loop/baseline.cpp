/// Calibrates the plain building, then adds refinements of its structure, the best first,
/// as long as unseen blocks are foretold better. Fits and scores of the loop are here.
/// Source: Minoux 1978 for the lazy greedy search.
/// A chosen refinement stays until effects are found, unless another of its kind takes
/// its place; two that help only together are not found. They are listed in
/// `effects::refinements`.
#include "loop/baseline.hpp"

#include "base/error.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bemcal::loop {
namespace {

/// Noise to start from: a fifth of what the readings vary.
std::vector<ChannelNoise> first_noise(const LoopData& data) {
    std::vector<double> about_mean = data.targets.measured;
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        double sum = 0, n = 0;
        for (std::size_t k = data.targets.first[c]; k < data.targets.first[c + 1]; ++k)
            if (!std::isnan(about_mean[k])) sum += about_mean[k], ++n;
        for (std::size_t k = data.targets.first[c]; k < data.targets.first[c + 1]; ++k)
            about_mean[k] = std::isnan(about_mean[k])
                                ? 0
                                : decisions::first_error * (about_mean[k] - sum / n);
    }
    std::vector<ChannelNoise> noise = noise_of(data, about_mean);
    for (ChannelNoise& channel : noise) channel.kappa = decisions::first_kappa;
    return noise;
}

/// Where a model starts that has the effects of another, and one refinement more or less.
std::vector<double> start_of(const Place& place, const Standing& from) {
    std::vector<std::string> names;
    names.reserve(place.unknowns.size() + place.always.size());
    for (const study::FitUnknown& unknown : place.unknowns) names.push_back(unknown.name);
    for (const effects::Refinement::Always& always : place.always)
        names.push_back(always.effect.name);
    std::vector<double> start(names.size(), 0.0);
    for (std::size_t k = 0; k < names.size(); ++k)
        for (std::size_t j = 0; j < from.built.first_effect(); ++j)
            if (from.built.unknowns[j].name == names[k]) start[k] = from.fit.at.x[j];
    const auto effects_begin =
        from.fit.at.x.begin() + static_cast<std::ptrdiff_t>(from.built.first_effect());
    start.insert(start.end(), effects_begin, from.fit.at.x.end());
    return start;
}

/// Of a fit with the noise held.
constexpr study::FitOptions with_noise_held{10, 5e-4};

/// A model's fit with the noise held, scored by that noise.
Standing scored(const LoopData& data, const Place& place, const LoopModel& model,
                std::vector<double> start, const std::vector<ChannelNoise>& noise) {
    Standing standing{model, build(place, model.effects), {}, noise, {}, {}, 0};
    refit(data, standing, std::move(start), with_noise_held);
    standing.score = std::numeric_limits<double>::infinity();
    if (standing.fit.failed) return standing;
    score_unseen(data, standing);
    return standing;
}

/// Fits a model that is built from where it stands, until the noise that weighs the
/// channels is that of the residuals.
Standing calibrated(const LoopData& data, Standing standing) {
    standing.noise = first_noise(data);
    for (int round = 0; round < decisions::noise_rounds; ++round) {
        refit(data, standing, with_noise_held);
        if (standing.fit.failed) return standing;
        standing.noise = noise_of(data, standing.residuals);
    }
    score_unseen(data, standing);
    return standing;
}

/// The refinement that lowers the score most; none: none does.
struct Better {
    Standing standing;
    Place place;
};

/// Refinements that may join.
struct Candidates {
    /// By how much each lowered the score when it was last tried. [refinements]
    std::vector<double> promises = std::vector<double>(
        effects::refinements().size(), std::numeric_limits<double>::infinity());
    /// Were chosen: one that gave way to another of its kind does not come back, for
    /// scores of two rounds, each by its own noise, could go in a circle.
    std::vector<std::size_t> joined{};

    /// The most promising first.
    std::vector<std::size_t> in_order() const {
        std::vector<std::size_t> order(promises.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
            return promises[a] > promises[b];
        });
        std::erase_if(order, [&](std::size_t k) {
            return std::ranges::find(joined, k) != joined.end();
        });
        return order;
    }
};

/// What one has brought, another seldom brings again: those that promised far less than
/// the best now does are not tried unless nothing else helps (the lazy form of a greedy
/// search: Minoux 1978).
std::optional<Better> best_refinement(const LoopData& data, const Baseline& baseline,
                                      Candidates& candidates,
                                      std::vector<TriedStructure>& tried) {
    std::optional<Better> best;
    double most = decisions::least_evidence_of_refinement;
    std::vector<double>& promises = candidates.promises;
    for (const std::size_t k : candidates.in_order()) {
        if (best && most > decisions::promise_ratio * promises[k]) break;
        const auto structure = effects::joined_by(k, baseline.chosen.model.structure,
                                                  data.building.structure);
        if (!structure) continue;
        LoopModel model = baseline.chosen.model;
        model.structure = *structure;
        try {
            Place place = make_place(data, model.structure, data.drive);
            Standing standing =
                scored(data, place, model, start_of(place, baseline.chosen),
                       baseline.chosen.noise);
            promises[k] = baseline.chosen.score - standing.score;
            tried.push_back({effects::name_of(whole_structure(data, model.structure)),
                             baseline.gained - promises[k]});
            if (promises[k] <= most) continue;
            most = promises[k];
            best = Better{std::move(standing), std::move(place)};
        } catch (const CannotSimulate&) {
            // It cannot enter this building: no cooling, no wind in the weather.
            promises[k] = -std::numeric_limits<double>::infinity();
        }
    }
    return best;
}

}  // namespace

double prior_pull(std::span<const study::FitUnknown> unknowns,
                  std::span<const double> x) {
    double sum = 0;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
        if (unknowns[k].has_prior) sum += x[k] * x[k];
    return sum;
}

std::vector<double> values_in(const BuiltModel& built, const Standing& standing) {
    std::vector<double> values(built.unknowns.size(), 0.0);
    const std::size_t n = std::min(values.size(), standing.fit.at.x.size());
    for (std::size_t k = 0; k < n; ++k)
        values[k] = built.unknowns[k].within(standing.fit.at.x[k]);
    return values;
}

physics::Building building_at(const BuiltModel& built,
                              const std::vector<double>& values) {
    physics::Building building = built.placed->building;
    physics::apply(built.placed->building, built.parameters, values, building);
    return building;
}

void refit(const LoopData& data, Standing& standing, std::vector<double> start,
           const study::FitOptions& options) {
    standing.fit.at = {std::move(start)};
    refit(data, standing, options);
}

void refit(const LoopData& data, Standing& standing, const study::FitOptions& options) {
    standing.fit = study::fit(
        *standing.built.fit_model, standing.built.unknowns, data.targets.measured,
        weights_of(data.targets, standing.noise), std::move(standing.fit.at), options);
    if (!standing.fit.failed)
        standing.residuals =
            study::residuals_of(data.targets.measured, standing.fit.at.predicted);
}

void score_unseen(const LoopData& data, Standing& standing) {
    standing.left_out =
        left_out_of(data, standing.built, standing.fit.at, standing.noise, data.blocks);
    standing.score = deviance(data.targets, standing.noise, standing.left_out);
}

void settle(const LoopData& data, Standing& standing) {
    refit(data, standing, to_settle);
    standing.noise = noise_of(data, standing.residuals);
    score_unseen(data, standing);
}

double evidence(const LoopData& data, const Standing& without, const Standing& with) {
    const auto pull = [](const Standing& standing) {
        return prior_pull(standing.built.unknowns, standing.fit.at.x);
    };
    return deviance(data.targets, without.noise, without.residuals) -
           deviance(data.targets, without.noise, with.residuals) + pull(without) -
           pull(with);
}

std::vector<double> left_out_of(const LoopData& data, const BuiltModel& built,
                                const study::Linearised& from,
                                const std::vector<ChannelNoise>& noise,
                                std::span<const int> blocks) {
    std::vector<double> left(data.targets.size());
    const auto weights = weights_of(data.targets, noise);
    const study::FitOptions options{3, 1e-3, study::without_derivatives};
    for (const int half : {0, 1}) {
        auto of_half = weights;
        for (std::size_t k = 0; k < of_half.size(); ++k)
            if (blocks[k] % 2 == half) of_half[k] = 0;
        const study::Fit fitted =
            study::fit(*built.fit_model, built.unknowns, data.targets.measured, of_half,
                       from, options);
        const auto residuals =
            study::residuals_of(data.targets.measured, fitted.at.predicted);
        for (std::size_t k = 0; k < left.size(); ++k)
            if (blocks[k] % 2 == half) left[k] = residuals[k];
    }
    return left;
}

Standing calibrate(const LoopData& data, const Place& place, const LoopModel& model,
                   std::vector<double> start) {
    Standing standing{model, build(place, model.effects), {}, {}, {}, {}, 0};
    standing.fit.at = {std::move(start)};
    return calibrated(data, std::move(standing));
}

namespace {

/// In prior standard deviations from the prior's mean.
std::vector<double> first_start(const LoopData& data, const Place& place) {
    std::vector<double> start;
    start.reserve(place.unknowns.size());
    for (const study::FitUnknown& unknown : place.unknowns) {
        const auto given = data.options.start.find(unknown.name);
        start.push_back(given == data.options.start.end()
                            ? 0
                            : (std::clamp(given->second, unknown.least, unknown.most) -
                               unknown.centre) /
                                  unknown.scale);
    }
    return start;
}

}  // namespace

Standing calibrate_plain(const LoopData& data) {
    const Place place = make_place(data, {}, data.drive);
    return calibrate(data, place, {}, first_start(data, place));
}

Baseline make_baseline(const LoopData& data) {
    Baseline baseline;
    baseline.place = make_place(data, {}, data.drive);
    baseline.plain =
        calibrate(data, baseline.place, {}, first_start(data, baseline.place));
    baseline.chosen = baseline.plain;
    baseline.tried = {{effects::name_of(data.building.structure), 0}};
    Candidates candidates;
    while (data.options.try_structures && !baseline.chosen.fit.failed) {
        auto better = best_refinement(data, baseline, candidates, baseline.tried);
        if (!better) break;
        baseline.gained += better->standing.score - baseline.chosen.score;
        baseline.place = std::move(better->place);
        candidates.joined.push_back(better->standing.model.structure.back());
        baseline.chosen = calibrated(data, std::move(better->standing));
    }
    return baseline;
}

std::vector<std::size_t> leave_unneeded_refinements(const LoopData& data, Place& place,
                                                    Standing& standing) {
    std::vector<std::size_t> gone;
    score_unseen(data, standing);
    const std::vector<std::size_t> last_first(standing.model.structure.rbegin(),
                                              standing.model.structure.rend());
    for (const std::size_t refinement : last_first) {
        LoopModel model = standing.model;
        std::erase(model.structure, refinement);
        try {
            Place fewer = make_place(data, model.structure, data.drive);
            fewer.surroundings->model = place.surroundings->model;
            Standing without =
                scored(data, fewer, model, start_of(fewer, standing), standing.noise);
            if (!(without.score <= standing.score)) continue;
            gone.push_back(refinement);
            place = std::move(fewer);
            standing = std::move(without);
        } catch (const CannotSimulate&) {
            continue;  // An effect enters there: it is needed.
        }
    }
    if (!gone.empty()) settle(data, standing);
    return gone;
}

}  // namespace bemcal::loop
