/// How many compute threads a rank gets: its cores by the affinity mask, shared with the
/// ranks of its host that may use them; and which hosts are crowded.
/// Follows from sched_getaffinity; OMP_NUM_THREADS or the user overrides. Cgroup quotas,
/// hyper-threads and memory nodes are not looked at.
#include "run/threads.hpp"

#include "run/wire.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>
#include <sched.h>

namespace bemcal::run {
namespace {

/// Number of threads and cores, then the host's name.
Bytes to_bytes(const Placement& place, int n_threads) {
    std::vector<int> numbers{n_threads, static_cast<int>(place.cores.size())};
    numbers.insert(numbers.end(), place.cores.begin(), place.cores.end());
    numbers.insert(numbers.end(), place.host.begin(), place.host.end());
    return run::to_bytes(numbers);
}

int from_bytes(const Bytes& bytes, Placement& place) {
    const std::vector<int> numbers = to_numbers(bytes);
    const auto host = numbers.begin() + 2 + numbers[1];
    place.cores.assign(numbers.begin() + 2, host);
    place.host.assign(host, numbers.end());
    return numbers[0];
}

int from_environment() {
    const char* text = std::getenv("OMP_NUM_THREADS");
    return text ? std::atoi(text) : 0;
}

/// Ranks of a host that may use these cores and no others.
struct Bound {
    std::vector<int> cores;
    int n_ranks = 0, n_threads = 0;
    bool is_crowded() const { return n_threads > static_cast<int>(cores.size()); }
};

Bound bound_to(const std::vector<int>& cores, const std::string& host,
               const std::vector<Placement>& ranks, const std::vector<int>& n_threads) {
    Bound bound{cores};
    for (std::size_t r = 0; r < ranks.size(); ++r) {
        if (ranks[r].host != host || !std::ranges::includes(cores, ranks[r].cores))
            continue;
        bound.n_ranks += 1;
        bound.n_threads += n_threads[r];
    }
    return bound;
}

std::map<std::string, std::set<int>> cores_of_hosts(const std::vector<Placement>& ranks) {
    std::map<std::string, std::set<int>> hosts;
    for (const Placement& rank : ranks)
        hosts[rank.host].insert(rank.cores.begin(), rank.cores.end());
    return hosts;
}

/// All of the host's cores where they are too few, else those of the first rank that has
/// to share its own; where neither is, all of them.
Bound most_telling(const std::string& host, const std::set<int>& all,
                   const std::vector<Placement>& ranks,
                   const std::vector<int>& n_threads) {
    Bound whole = bound_to({all.begin(), all.end()}, host, ranks, n_threads);
    if (whole.is_crowded()) return whole;
    for (const Placement& rank : ranks) {
        if (rank.host != host) continue;
        const Bound part = bound_to(rank.cores, host, ranks, n_threads);
        if (part.is_crowded()) return part;
    }
    return whole;
}

}  // namespace

Placement placement() {
    Placement place{host_name(), {}};
    cpu_set_t mask;
    CPU_ZERO(&mask);
    if (::sched_getaffinity(0, sizeof mask, &mask) != 0) CPU_SET(0, &mask);
    for (int core = 0; core < CPU_SETSIZE; ++core)
        if (CPU_ISSET(core, &mask)) place.cores.push_back(core);
    return place;
}

int default_threads(const std::vector<Placement>& ranks, int rank) {
    const Placement& mine = ranks[static_cast<std::size_t>(rank)];
    std::size_t n_sharing = 0;
    for (const Placement& other : ranks) {
        std::vector<int> common;
        std::ranges::set_intersection(mine.cores, other.cores,
                                      std::back_inserter(common));
        n_sharing += other.host == mine.host && !common.empty();
    }
    return static_cast<int>(std::max<std::size_t>(1, mine.cores.size() / n_sharing));
}

std::vector<std::string> crowded_hosts(const std::vector<Placement>& ranks,
                                       const std::vector<int>& n_threads) {
    std::vector<std::string> sentences;
    for (const auto& [name, cores] : cores_of_hosts(ranks)) {
        const Bound bound = most_telling(name, cores, ranks, n_threads);
        if (!bound.is_crowded()) continue;
        sentences.push_back(fmt::format(
            "{}: {} rank{} with {} compute thread{} may use only {} core{} ({}), so that "
            "threads share cores; use fewer (--threads), or give each rank more cores: "
            "mpirun --map-by slot:PE=THREADS or --bind-to none",
            name, bound.n_ranks, bound.n_ranks == 1 ? "" : "s", bound.n_threads,
            bound.n_threads == 1 ? "" : "s", bound.cores.size(),
            bound.cores.size() == 1 ? "" : "s", fmt::join(bound.cores, ", ")));
    }
    return sentences;
}

ThreadPlan plan_threads(Comm& comm, int asked) {
    const int wanted = asked > 0 ? asked : from_environment();
    const auto received = comm.all_gather(to_bytes(placement(), wanted));
    std::vector<Placement> ranks(received.size());
    std::vector<int> n_threads(received.size());
    for (std::size_t r = 0; r < ranks.size(); ++r)
        n_threads[r] = from_bytes(received[r], ranks[r]);
    for (std::size_t r = 0; r < ranks.size(); ++r)
        if (n_threads[r] <= 0) n_threads[r] = default_threads(ranks, static_cast<int>(r));
    ThreadPlan plan;
    plan.n_threads = n_threads[static_cast<std::size_t>(comm.rank())];
    plan.n_threads_total = 0;
    for (const int n : n_threads) plan.n_threads_total += n;
    plan.n_hosts = static_cast<int>(cores_of_hosts(ranks).size());
    plan.warnings = crowded_hosts(ranks, n_threads);
    return plan;
}

}  // namespace bemcal::run
