/// Runs chains as a stage: an item is a few of them in lockstep. The first round warms
/// them up; each later one adds draws until all unknowns have converged or the budget is
/// spent.
/// Source: Vehtari et al. 2021 for the targets, rank R-hat and effective draws.
/// Leaves out the samplers (`run_chains`) and what is sampled (a `Posterior`).
#include "posterior/chain_stage.hpp"

#include "posterior/chain_draws.hpp"
#include "posterior/chain_results.hpp"
#include "sampling/chain.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

/// The chains of an item that runs.
struct ChainsAtWork {
    ChainsAtWork(std::size_t its_chains, int its_round, int its_transitions)
        : n_chains(static_cast<double>(its_chains)),
          round(its_round),
          n_transitions(its_transitions) {}

    double n_chains;
    int round, n_transitions;  ///< of each chain
    sampling::Tally tally;
};

/// Over all chains that run here.
struct TallySum {
    double transitions = 0, steps = 0, acceptance = 0, n_chains = 0;
    int round = 0, of_each = 0, n_items = 0;

    void add(const ChainsAtWork& item) {
        transitions += static_cast<double>(item.tally.transitions.load());
        steps += static_cast<double>(item.tally.steps.load());
        acceptance += item.tally.acceptance.load();
        n_chains += item.n_chains;
        round = item.round;
        of_each = item.n_transitions;
        ++n_items;
    }
    double share() const {
        const double planned = n_chains * of_each;
        return planned > 0 ? transitions / planned : 0;
    }
};

class ChainStage : public study::Stage {
  public:
    ChainStage(std::string name, std::shared_ptr<const Posterior> posterior,
               const ChainOptions& options)
        : name_(std::move(name)),
          posterior_(std::move(posterior)),
          options_(options),
          layout_{options.n_chains, options.chains_per_item,
                  posterior_->make_density()->dimension()} {}

    std::string name() const override { return name_; }
    int n_items() const override { return layout_.n_groups(); }
    long long n_simulations() const override { return 0; }
    std::size_t answer_bytes() const override {
        return sizeof(double) * static_cast<std::size_t>(options_.chains_per_item) *
               static_cast<std::size_t>(options_.draws_per_round) *
               (layout_.dimension + sampling::n_statistics);
    }
    study::ItemAnswer run(int item) const override;
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override;
    void begin_round(int, const study::Round& round) override {
        states_ = unpack_states(round.needed);
    }
    study::Activity activity() const override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        const ChainDraws draws = draws_of(answers);
        return conclude_chains(name_, *posterior_, options_, draws);
    }
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        const ChainDraws draws = draws_of(answers);
        return shortfall_of(convergence_table(*posterior_, draws), options_, draws);
    }

  private:
    ChainDraws draws_of(const std::vector<study::ItemAnswer>& answers) const {
        return gather_draws(layout_, options_.first_chain, answers);
    }
    std::vector<sampling::ChainTask> tasks_of(int item) const;
    ConvergenceTable converging(const ChainDraws& draws) const;

    std::string name_;
    std::shared_ptr<const Posterior> posterior_;
    ChainOptions options_;
    ChainLayout layout_;
    std::vector<std::vector<double>> states_;  ///< [chains] that this round starts from
    mutable study::Running<ChainsAtWork> at_work_;
    mutable std::string so_far_;  ///< rank 0: what the rounds before have reached
};

/// The chains of an item that are still alive.
std::vector<sampling::ChainTask> ChainStage::tasks_of(int item) const {
    std::vector<sampling::ChainTask> tasks;
    const int round = layout_.round_of(item);
    for (int k = 0; k < layout_.n_chains_of(item); ++k) {
        const int chain = layout_.first_chain_of(item) + k;
        sampling::ChainTask task{options_.seed,
                                 static_cast<std::uint32_t>(options_.first_chain + chain),
                                 static_cast<std::uint32_t>(round),
                                 {}};
        if (round > 0) task.state = states_.at(static_cast<std::size_t>(chain));
        if (round == 0 || !task.state.empty()) tasks.push_back(std::move(task));
    }
    return tasks;
}

study::ItemAnswer ChainStage::run(int item) const {
    const auto density = posterior_->make_density();
    const auto tasks = tasks_of(item);
    const int round = layout_.round_of(item);
    const study::Running<ChainsAtWork>::Item at_work(
        at_work_, tasks.size(), round,
        round == 0 ? options_.sampler.n_warm_up
                   : options_.draws_per_round * options_.sampler.thin);
    const auto parts = sampling::run_chains(*density, options_.sampler, tasks,
                                            options_.draws_per_round, &at_work->tally);
    study::ItemAnswer answer;
    std::vector<sampling::ChainPart> all(
        static_cast<std::size_t>(layout_.n_chains_of(item)));
    const auto first =
        static_cast<std::uint32_t>(options_.first_chain + layout_.first_chain_of(item));
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (parts[k].failure.empty())
            all[tasks[k].chain - first] = parts[k];
        else
            answer.failures.push_back(
                {static_cast<long long>(tasks[k].chain),
                 fmt::format("chain {}: {}", tasks[k].chain, parts[k].failure)});
    }
    answer.values = pack_parts(all);
    return answer;
}

study::Activity ChainStage::activity() const {
    TallySum sum;
    at_work_.each([&](const ChainsAtWork& item) { sum.add(item); });
    if (sum.n_chains == 0) return {0, {}, so_far_};
    const int thin = sum.round == 0 ? 1 : options_.sampler.thin;
    std::string text = fmt::format("{} {:.0f} of {}", sum.round == 0 ? "warm-up" : "draw",
                                   std::floor(sum.transitions / (sum.n_chains * thin)),
                                   sum.of_each / thin);
    if (sum.transitions > 0) {
        text += fmt::format(", acceptance {:.2f}", sum.acceptance / sum.transitions);
        if (options_.sampler.method == sampling::Method::nuts)
            text += fmt::format(", {:.1f} steps", sum.steps / sum.transitions);
    }
    if (sum.transitions == 0 && sum.round == 0 &&
        sampling::climbs_first(options_.sampler))
        text += ", climbing to the mode";
    return {sum.share(), text, so_far_, sum.n_items};
}

/// Of all draws so far, which is also told.
ConvergenceTable ChainStage::converging(const ChainDraws& draws) const {
    ConvergenceTable table = convergence_table(*posterior_, draws);
    so_far_ = fmt::format("after {} draws R-hat {:.3f}, ESS {:.0f}", draws.n_draws,
                          table.worst_rhat(), table.least_ess());
    return table;
}

std::optional<study::Round> ChainStage::next_round(
    const std::vector<study::ItemAnswer>& answers) const {
    const ChainDraws draws = draws_of(answers);
    if (draws.n_chains == 0) return std::nullopt;
    const auto n_draws = static_cast<int>(draws.n_draws);
    if (n_draws > 0 &&
        (n_draws >= options_.most_draws || converging(draws).meets(options_)))
        return std::nullopt;
    auto states = last_states(layout_, answers);
    if (n_draws == 0)
        sampling::share_metric(*posterior_->make_density(), options_.sampler, states);
    return study::Round{layout_.n_groups(), pack_states(states)};
}

}  // namespace

std::unique_ptr<study::Stage> make_chain_stage(std::string name,
                                               std::shared_ptr<const Posterior> posterior,
                                               const ChainOptions& options) {
    return std::make_unique<ChainStage>(std::move(name), std::move(posterior), options);
}

}  // namespace bemcal::posterior
