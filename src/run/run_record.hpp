/// What a run was and what it spent: the attributes of /run, outside the result's hash.
#pragma once

#include "run/comm.hpp"
#include "run/threads.hpp"

#include <map>
#include <string>

namespace bemcal::run {

/// Seconds of a rank. Doubles only, so that ranks can send it as it is.
struct Spent {
    double simulate = 0, conclude = 0, log = 0;
    double busy = 0;  ///< of its compute threads, in items
    double n_threads = 0;
};

std::string utc_now();  ///< "2026-01-31T12:00:00Z"

/// All ranks call it together. Adds hosts, ranks, threads, the date and the seconds.
void describe_run(Comm& comm, const ThreadPlan& threads, const Spent& spent,
                  std::map<std::string, std::string>& run);

}  // namespace bemcal::run
