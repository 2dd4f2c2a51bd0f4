/// The life of a ladder's walkers: the best of several starts, climb, warm-up, or draws
/// that are recorded for the coldest; and the state for the next round.
/// Follows from Stan's order of a chain; tempering: Syed et al. 2022. Swaps and
/// temperatures are in ladder_meeting. Draws of hotter walkers are not kept.
#include "sampling/ladder.hpp"

#include "sampling/adaptation.hpp"
#include "sampling/climb.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::sampling {
namespace {

/// Streams of a chain's round: the first for swaps, then one for each temperature.
constexpr std::uint32_t chain_streams = 0x43480000;

/// A chain that starts at its mode needs no long trajectories to arrive; a poor metric
/// would make it follow many.
constexpr int warm_up_depth = 5;

Stream stream_of(const ChainTask& task, std::size_t number) {
    return {task.seed, chain_streams + static_cast<std::uint32_t>(number),
            (std::uint64_t{task.chain} << 32) | task.round};
}

bool is_finite(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

void add_to(Transition& sum, const Transition& one) {
    sum.acceptance += one.acceptance;
    sum.n_steps += one.n_steps;
    sum.depth = std::max(sum.depth, one.depth);
    sum.diverging = sum.diverging || one.diverging;
}

}  // namespace

Ladder::Ladder(const Setting& setting, const ChainTask& task)
    : setting_(setting), task_(task), random_(stream_of(task, 0)) {
    for (const double t : setting.options.inverse_temperatures)
        walkers_.emplace_back(setting.company, setting.coordinates, setting.options, t,
                              stream_of(task, walkers_.size() + 1));
    swapped_.resize(walkers_.size() - 1);
    refused_.resize(walkers_.size() - 1);
    if (task.round == 0 && setting.options.adapt_temperatures) plan_tunings();
    if (task.round > 0) remember(task.state);
    const auto n_draws = task.round > 0 ? static_cast<std::size_t>(setting.n_draws) : 0;
    part_.draws = Matrix(n_draws, setting.coordinates.dimension);
    part_.statistics = Matrix(n_draws, n_statistics);
}

void Ladder::start() {
    if (!part_.failure.empty()) return;
    walks_.reserve(walkers_.size());
    for (Walker& walker : walkers_) walks_.push_back(walk(walker));
    for (Task<>& task : walks_) task.start();
}

Task<> Ladder::walk(Walker& walker) {
    if (task_.round == 0) return warm_up(walker);
    return draw(walker);
}

ChainPart Ladder::finish() {
    for (const Task<>& task : walks_) task.check();
    if (!part_.failure.empty()) return {{}, {}, {}, part_.failure};
    for (const std::span<double> values : memory())
        part_.state.insert(part_.state.end(), values.begin(), values.end());
    return std::move(part_);
}

std::vector<std::span<double>> Ladder::memory() {
    std::vector<std::span<double>> all{{&n_meetings_, 1}};
    for (Walker& walker : walkers_) {
        all.emplace_back(&walker.inverse_temperature, 1);
        all.emplace_back(walker.current.x);
        all.emplace_back(walker.scales);
        all.emplace_back(walker.metric.factor());
    }
    return all;
}

void Ladder::remember(const std::vector<double>& state) {
    const auto parts = memory();
    const std::size_t n = std::accumulate(
        parts.begin(), parts.end(), std::size_t{0},
        [](std::size_t sum, const auto& part) { return sum + part.size(); });
    if (state.size() != n) {
        part_.failure =
            fmt::format("the chain's state has {} numbers, expected {}", state.size(), n);
        return;
    }
    auto from = state.begin();
    for (const std::span<double> part : parts) {
        std::copy_n(from, part.size(), part.begin());
        from += static_cast<std::ptrdiff_t>(part.size());
    }
}

Task<> Ladder::find_start(Walker& walker) {
    const int n_candidates = setting_.options.n_start_candidates;
    bool is_found = false;
    for (int k = 0; k < n_candidates; ++k) {
        walker.trial.x = setting_.density.draw_start(walker.random);
        co_await walker.evaluate(walker.trial);
        const double value = walker.log_density(walker.trial);
        const bool is_usable = std::isfinite(value) &&
                               is_finite(walker.trial.prior_gradient) &&
                               is_finite(walker.trial.likelihood_gradient);
        if (!is_usable || (is_found && value <= walker.log_density(walker.current)))
            continue;
        std::swap(walker.current, walker.trial);
        is_found = true;
    }
    if (!is_found)
        part_.failure = fmt::format(
            "no start with a finite log density among {} draws from the prior",
            n_candidates);
}

Task<> Ladder::warm_up(Walker& walker) {
    const bool is_nuts = walker.method == Method::nuts;
    co_await find_start(walker);
    if (!part_.failure.empty()) co_return;
    if (climbs_first(setting_.options)) {
        co_await climb(walker);
        co_await leave_mode(walker);
        walker.trajectory.set_most_depth(
            std::min(setting_.options.most_depth, warm_up_depth));
    }
    if (is_nuts) co_await find_step_size(walker);
    Adaptation adaptation(walker, setting_.options);
    adaptation.restart(walker);
    for (int i = 0; i < setting_.options.n_warm_up; ++i) {
        const Transition transition = co_await transition_of(walker);
        count(walker, transition);
        const bool is_new_metric = adaptation.learn(walker);
        if (is_new_metric && is_nuts) {
            co_await find_step_size(walker);
            adaptation.restart(walker);
        }
        co_await meet();
    }
    adaptation.finish(walker);
}

Task<> Ladder::draw(Walker& walker) {
    co_await walker.evaluate(walker.current);
    for (std::size_t i = 0; i < part_.draws.rows; ++i) {
        Transition sum;
        for (int k = 0; k < setting_.options.thin; ++k) {
            const Transition transition = co_await transition_of(walker);
            add_to(sum, transition);
            count(walker, transition);
            co_await meet();
        }
        if (&walker == &walkers_.front()) record(i, sum);
    }
}

void Ladder::count(const Walker& walker, const Transition& transition) {
    if (setting_.tally != nullptr && &walker == &walkers_.front())
        setting_.tally->add(transition.acceptance, transition.n_steps);
}

void Ladder::record(std::size_t draw, const Transition& sum) {
    const Walker& walker = walkers_.front();
    std::ranges::copy(walker.current.x, part_.draws.row(draw).begin());
    const double n_pairs = std::max<double>(1, static_cast<double>(swapped_.size()));
    const double n_scales = static_cast<double>(walker.scales.size());
    const double values[n_statistics] = {
        walker.current.prior,
        walker.current.likelihood,
        sum.acceptance / setting_.options.thin,
        std::accumulate(walker.scales.begin(), walker.scales.end(), 0.0) / n_scales,
        static_cast<double>(sum.n_steps),
        static_cast<double>(sum.depth),
        sum.diverging ? 1.0 : 0.0,
        std::accumulate(swapped_.begin(), swapped_.end(), 0.0) / n_pairs};
    std::ranges::copy(values, part_.statistics.row(draw).begin());
}

}  // namespace bemcal::sampling
