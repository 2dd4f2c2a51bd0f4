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

struct Host {
    std::set<int> cores;
    int n_ranks = 0, n_threads = 0;
    bool is_cramped = false;  ///< a rank has more threads than cores
};

std::map<std::string, Host> hosts_of(const std::vector<Placement>& ranks,
                                     const std::vector<int>& n_threads) {
    std::map<std::string, Host> hosts;
    for (std::size_t r = 0; r < ranks.size(); ++r) {
        Host& host = hosts[ranks[r].host];
        host.cores.insert(ranks[r].cores.begin(), ranks[r].cores.end());
        host.n_threads += n_threads[r];
        host.n_ranks += 1;
        host.is_cramped |= n_threads[r] > static_cast<int>(ranks[r].cores.size());
    }
    return hosts;
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
    for (const auto& [name, host] : hosts_of(ranks, n_threads)) {
        if (!host.is_cramped && host.n_threads <= static_cast<int>(host.cores.size()))
            continue;
        sentences.push_back(fmt::format(
            "{}: {} rank{} with {} compute threads may use only {} core{}, so that "
            "threads share "
            "cores; use fewer (--threads), or give each rank more cores: mpirun --map-by "
            "slot:PE=THREADS or --bind-to none",
            name, host.n_ranks, host.n_ranks == 1 ? "" : "s", host.n_threads,
            host.cores.size(), host.cores.size() == 1 ? "" : "s"));
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
    plan.n_hosts = static_cast<int>(hosts_of(ranks, n_threads).size());
    plan.warnings = crowded_hosts(ranks, n_threads);
    return plan;
}

}  // namespace bemcal::run
