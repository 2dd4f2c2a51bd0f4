/// The ranks of a run: the only header over MPI (comm.cpp is the only file with mpi.h).
///
/// Without mpirun or srun there is one rank, MPI is not started and nothing is sent.
/// Everything that waits sleeps between polls, so that idle ranks leave the cores to
/// others. MPI_THREAD_FUNNELED: only the main thread calls any of this. Leaves out:
/// one-sided communication, which Debian's Open MPI does not have between nodes, and
/// recovery from a dead rank (resume from the logs).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::run {

using Bytes = std::vector<std::byte>;

/// Started once, by main. Its end is the end of MPI, which waits for all ranks.
class Comm {
  public:
    Comm(int* argc, char*** argv);
    ~Comm();
    Comm(const Comm&) = delete;
    Comm& operator=(const Comm&) = delete;

    int rank() const { return rank_; }
    int size() const { return size_; }

    struct Message {
        int source = 0, tag = 0;
        Bytes data;
    };
    void send(int to, int tag,
              Bytes data);          ///< buffered; returns at once; to itself as well
    std::optional<Message> poll();  ///< a message that has arrived
    bool is_sending();              ///< something sent has not been taken yet
    void finish_sends();            ///< waits until all are delivered
    void barrier();
    std::vector<Bytes> all_gather(const Bytes& data);  ///< by rank
    [[noreturn]] void abort(int exit_code);            ///< ends every rank at once

    /// Threads run on that nobody waits for: the process has to end by leave().
    void note_left_threads() { has_left_threads_ = true; }
    bool has_left_threads() const { return has_left_threads_; }
    /// Ends MPI as the destructor does, with all ranks, and then the process at once.
    [[noreturn]] void leave(int exit_code);

  private:
    struct Pending;
    void end();
    std::unique_ptr<Pending> pending_;
    int rank_ = 0, size_ = 1;
    bool has_left_threads_ = false;
};

std::string host_name();
std::string mpi_version();

}  // namespace bemcal::run
