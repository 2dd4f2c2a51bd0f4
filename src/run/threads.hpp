/// How many compute threads a rank gets, from the cores it may use and the ranks it
/// shares them with.
///
/// Plain `mpirun -np 2` binds each rank to ONE core; `--map-by slot:PE=T` gives it T, and
/// `--bind-to none` all of the host's, which are then shared out.
#pragma once

#include "run/comm.hpp"

#include <string>
#include <vector>

namespace bemcal::run {

/// Where a rank may run.
struct Placement {
    std::string host;
    std::vector<int> cores;  ///< of its affinity mask, ascending
};
Placement placement();

/// A fair share of the rank's cores among the ranks of its host that may use them; at
/// least 1.
int default_threads(const std::vector<Placement>& ranks, int rank);

/// A sentence for each host on which threads would share a core; empty = none.
std::vector<std::string> crowded_hosts(const std::vector<Placement>& ranks,
                                       const std::vector<int>& n_threads);

struct ThreadPlan {
    int n_threads = 1;        ///< of this rank
    int n_threads_total = 1;  ///< of all ranks
    int n_hosts = 1;
    std::vector<std::string> warnings;
};

/// All ranks call it together. \param asked  the user's number; 0 = OMP_NUM_THREADS where
/// it is set, else the default
ThreadPlan plan_threads(Comm& comm, int asked);

}  // namespace bemcal::run
