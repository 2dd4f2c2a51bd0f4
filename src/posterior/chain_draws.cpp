/// Writes chains as an item's numbers and reads them again; gathers all rounds and judges
/// convergence. A chain is the length of its state, the state, its number of draws, the
/// draws and their statistics; a failed one has an empty state.
/// Source: Vehtari et al. 2021, by `convergence_of`.
/// Failed chains are left out; their reasons stand among the item's failures.
#include "posterior/chain_draws.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::posterior {
namespace {

constexpr auto n_statistics = sampling::n_statistics;

/// Reads numbers one after the other.
class Reader {
  public:
    explicit Reader(const std::vector<double>& values) : values_(values) {}
    double number() { return take(1)[0]; }
    std::size_t count() { return static_cast<std::size_t>(number()); }
    std::span<const double> take(std::size_t n) {
        require(at_ + n <= values_.size(), "an answer of chains is cut");
        at_ += n;
        return {values_.data() + at_ - n, n};
    }

  private:
    const std::vector<double>& values_;
    std::size_t at_ = 0;
};

/// A chain's part of an item, as it lies in the answer.
struct PartView {
    std::span<const double> state, draws, statistics;
    std::size_t n_draws = 0;
};

PartView read_part(Reader& reader, std::size_t dimension) {
    PartView part;
    part.state = reader.take(reader.count());
    part.n_draws = reader.count();
    part.draws = reader.take(part.n_draws * dimension);
    part.statistics = reader.take(part.n_draws * n_statistics);
    return part;
}

void append(std::vector<double>& values, std::span<const double> more) {
    values.insert(values.end(), more.begin(), more.end());
}

/// All rounds of one chain.
struct WholeChain {
    bool has_failed = false;
    std::vector<double> draws, statistics;
};

std::vector<WholeChain> whole_chains(const ChainLayout& layout,
                                     const std::vector<study::ItemAnswer>& answers) {
    std::vector<WholeChain> chains(static_cast<std::size_t>(layout.n_chains));
    for (std::size_t item = 0; item < answers.size(); ++item) {
        Reader reader(answers[item].values);
        const int first = layout.first_chain_of(static_cast<int>(item));
        for (int k = 0; k < layout.n_chains_of(static_cast<int>(item)); ++k) {
            WholeChain& chain = chains[static_cast<std::size_t>(first + k)];
            if (!answers[item].error.empty()) {
                chain.has_failed = true;
                continue;
            }
            const PartView part = read_part(reader, layout.dimension);
            chain.has_failed = chain.has_failed || part.state.empty();
            append(chain.draws, part.draws);
            append(chain.statistics, part.statistics);
        }
    }
    return chains;
}

std::vector<std::string> failures_in(const std::vector<study::ItemAnswer>& answers) {
    std::vector<std::string> reasons;
    for (const study::ItemAnswer& answer : answers) {
        if (!answer.error.empty()) reasons.push_back(answer.error);
        for (const study::Failure& failure : answer.failures)
            reasons.push_back(failure.reason);
    }
    return reasons;
}

double worst(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::nan("") : std::max(a, b);
}

double least(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::nan("") : std::min(a, b);
}

/// An unknown that is the same in all draws is known: it has converged. Sums of the same
/// number leave a rest of rounding.
bool varies(const stats::Convergence& row) {
    constexpr double rounding = 1e-12;
    return row.sd > rounding * std::abs(row.mean) || std::isnan(row.sd);
}

}  // namespace

int ChainLayout::n_chains_of(int item) const {
    return std::min(chains_per_item, n_chains - first_chain_of(item));
}

std::vector<double> pack_parts(const std::vector<sampling::ChainPart>& parts) {
    std::vector<double> values;
    for (const sampling::ChainPart& part : parts) {
        values.push_back(static_cast<double>(part.state.size()));
        append(values, part.state);
        values.push_back(static_cast<double>(part.draws.rows));
        append(values, part.draws.values);
        append(values, part.statistics.values);
    }
    return values;
}

std::vector<std::vector<double>> last_states(
    const ChainLayout& layout, const std::vector<study::ItemAnswer>& answers) {
    std::vector<std::vector<double>> states(static_cast<std::size_t>(layout.n_chains));
    const auto n_groups = static_cast<std::size_t>(layout.n_groups());
    for (std::size_t item = answers.size() - n_groups; item < answers.size(); ++item) {
        if (!answers[item].error.empty()) continue;
        Reader reader(answers[item].values);
        const int first = layout.first_chain_of(static_cast<int>(item));
        for (int k = 0; k < layout.n_chains_of(static_cast<int>(item)); ++k) {
            const auto state = read_part(reader, layout.dimension).state;
            states[static_cast<std::size_t>(first + k)].assign(state.begin(),
                                                               state.end());
        }
    }
    return states;
}

std::vector<double> pack_states(const std::vector<std::vector<double>>& states) {
    std::vector<double> packed;
    for (const auto& state : states) {
        packed.push_back(static_cast<double>(state.size()));
        append(packed, state);
    }
    return packed;
}

std::vector<std::vector<double>> unpack_states(const std::vector<double>& packed) {
    std::vector<std::vector<double>> states;
    for (std::size_t at = 0; at < packed.size();) {
        const auto n = static_cast<std::size_t>(packed[at++]);
        require(at + n <= packed.size(), "the states of chains are cut");
        states.emplace_back(packed.begin() + static_cast<std::ptrdiff_t>(at),
                            packed.begin() + static_cast<std::ptrdiff_t>(at + n));
        at += n;
    }
    return states;
}

ChainDraws gather_draws(const ChainLayout& layout, int first_chain,
                        const std::vector<study::ItemAnswer>& answers) {
    ChainDraws all;
    all.failures = failures_in(answers);
    const std::vector<WholeChain> chains = whole_chains(layout, answers);
    for (std::size_t c = 0; c < chains.size(); ++c) {
        if (chains[c].has_failed) continue;
        append(all.positions.values, chains[c].draws);
        append(all.statistics.values, chains[c].statistics);
        all.chains.push_back(first_chain + static_cast<int>(c));
    }
    all.n_chains = all.chains.size();
    all.positions.cols = layout.dimension;
    all.statistics.cols = n_statistics;
    all.statistics.rows = all.statistics.values.size() / n_statistics;
    all.positions.rows = all.statistics.rows;
    all.n_draws = all.n_chains == 0 ? 0 : all.statistics.rows / all.n_chains;
    return all;
}

double ConvergenceTable::worst_rhat() const {
    double value = 0;
    for (const auto& row : rows)
        if (varies(row)) value = worst(value, row.rhat_rank);
    return value;
}

double ConvergenceTable::least_ess() const {
    double value = std::numeric_limits<double>::infinity();
    for (const auto& row : rows)
        if (varies(row)) value = least(value, std::min(row.ess_bulk, row.ess_tail));
    return value;
}

bool ConvergenceTable::meets(const ChainOptions& options) const {
    return worst_rhat() <= options.target_rhat && least_ess() >= options.target_ess;
}

std::vector<Matrix> draws_of_unknowns(const Posterior& posterior,
                                      const ChainDraws& draws) {
    const std::size_t n = posterior.unknowns().size();
    std::vector<Matrix> unknowns(n, Matrix(draws.n_chains, draws.n_draws));
    std::vector<double> values(n);
    for (std::size_t k = 0; k < draws.positions.rows; ++k) {
        posterior.read(draws.positions.row(k), values);
        for (std::size_t u = 0; u < n; ++u) unknowns[u].values[k] = values[u];
    }
    return unknowns;
}

Matrix log_densities(const ChainDraws& draws) {
    using sampling::Statistic;
    Matrix logs(draws.n_chains, draws.n_draws);
    for (std::size_t k = 0; k < logs.values.size(); ++k)
        logs.values[k] =
            draws.statistics(k, static_cast<std::size_t>(Statistic::log_prior)) +
            draws.statistics(k, static_cast<std::size_t>(Statistic::log_likelihood));
    return logs;
}

ConvergenceTable convergence_table(const Posterior& posterior, const ChainDraws& draws) {
    ConvergenceTable table;
    for (const Unknown& unknown : posterior.unknowns())
        table.names.push_back(unknown.name);
    table.names.emplace_back("log_density");
    for (const Matrix& unknown : draws_of_unknowns(posterior, draws))
        table.rows.push_back(stats::convergence_of(unknown));
    table.rows.push_back(stats::convergence_of(log_densities(draws)));
    return table;
}

}  // namespace bemcal::posterior
