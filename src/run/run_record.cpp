/// What a run was and what it spent, over all ranks: hosts, threads, seconds, idle share.
/// Plain sums; idle share = 1 - seconds in items / seconds of all threads. Wall time
/// only: no processor time, memory or energy. It stays outside the result's hash.
#include "run/run_record.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace bemcal::run {
namespace {

/// Over all ranks.
struct Together {
    double busy = 0, available = 0, log = 0;
};

Together add_up(Comm& comm, const Spent& spent) {
    Bytes mine(sizeof spent);
    std::memcpy(mine.data(), &spent, sizeof spent);
    Together all;
    for (const Bytes& bytes : comm.all_gather(mine)) {
        Spent other;
        std::memcpy(&other, bytes.data(), sizeof other);
        all.busy += other.busy;
        all.available += other.simulate * other.n_threads;
        all.log = std::max(all.log, other.log);
    }
    return all;
}

}  // namespace

std::string utc_now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(
                           std::chrono::system_clock::now())));
}

void describe_run(Comm& comm, const ThreadPlan& threads, const Spent& spent,
                  std::map<std::string, std::string>& run) {
    const Together all = add_up(comm, spent);
    run["finished"] = utc_now();
    run["host"] = host_name();
    run["mpi"] = mpi_version();
    run["n_hosts"] = std::to_string(threads.n_hosts);
    run["n_ranks"] = std::to_string(comm.size());
    run["n_threads"] = std::to_string(threads.n_threads_total);
    run["seconds_simulate"] = fmt::format("{:.3f}", spent.simulate);
    run["seconds_conclude"] = fmt::format("{:.3f}", spent.conclude);
    run["seconds_log"] = fmt::format("{:.3f}", all.log);
    run["idle_share"] =
        fmt::format("{:.4f}", all.available > 0 ? 1 - all.busy / all.available : 0);
}

}  // namespace bemcal::run
