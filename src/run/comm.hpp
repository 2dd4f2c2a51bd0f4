/// The ranks of a run: the only header over MPI (comm.cpp is the only file with mpi.h).
/// Without mpirun there is one rank and nothing is sent.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::run {

/// Started once, by main. The last one to be destroyed ends MPI.
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
        std::vector<std::byte> data;
    };
    void send(int to, int tag, std::vector<std::byte> data);  ///< buffered; returns at once
    std::optional<Message> poll();                            ///< a message that has arrived
    void finish_sends();                                      ///< waits until all are delivered
    void barrier();                                           ///< sleeps between polls
    std::vector<std::byte> broadcast(std::vector<std::byte> data);  ///< from rank 0
    [[noreturn]] void abort(int exit_code);                   ///< ends every rank

  private:
    struct Pending;
    Pending* pending_ = nullptr;
    int rank_ = 0, size_ = 1;
};

std::string host_name();
std::string mpi_version();

}  // namespace bemcal::run
