/// The ranks of a run over MPI, which this file alone includes: buffered sends, polls
/// that sleep, barrier, gather, and the end of all.
/// Source: the MPI standard; without a launcher it is not started. Left out: one-sided
/// communication, messages above 2 GiB, recovery from a dead rank.
#include "run/comm.hpp"

#include "base/error.hpp"

#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <list>
#include <numeric>
#include <thread>
#include <utility>

#include <mpi.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

/// A launcher of ranks leaves one of these behind.
bool is_launched() {
    for (const char* name :
         {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "MPI_LOCALRANKID"})
        if (std::getenv(name)) return true;
    return false;
}

bool is_done(MPI_Request& request) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    return done != 0;
}

void sleep_until_done(MPI_Request request) {
    while (!is_done(request)) std::this_thread::sleep_for(std::chrono::microseconds(500));
}

int checked_size(std::size_t bytes) {
    require(bytes <= INT_MAX, "a message of more than 2 GiB");
    return static_cast<int>(bytes);
}

}  // namespace

struct Comm::Pending {
    struct Send {
        Bytes data;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    bool is_started = false;
    std::list<Send> sends;
    std::deque<Message> to_self;
};

Comm::Comm(int* argc, char*** argv) : pending_(std::make_unique<Pending>()) {
    if (!is_launched()) return;
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
    pending_->is_started = true;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Comm::~Comm() {
    end();
}

void Comm::end() {
    if (!std::exchange(pending_->is_started, false)) return;
    finish_sends();
    barrier();
    MPI_Finalize();
}

void Comm::leave(int exit_code) {
    end();
    std::fflush(nullptr);
    std::_Exit(exit_code);
}

void Comm::send(int to, int tag, Bytes data) {
    if (to == rank_) {
        pending_->to_self.push_back({rank_, tag, std::move(data)});
        return;
    }
    auto& sent = pending_->sends.emplace_back();
    sent.data = std::move(data);
    MPI_Isend(sent.data.data(), checked_size(sent.data.size()), MPI_BYTE, to, tag,
              MPI_COMM_WORLD, &sent.request);
}

bool Comm::is_sending() {
    pending_->sends.remove_if([](auto& sent) { return is_done(sent.request); });
    return !pending_->sends.empty();
}

void Comm::finish_sends() {
    while (is_sending()) std::this_thread::sleep_for(std::chrono::microseconds(100));
}

std::optional<Comm::Message> Comm::poll() {
    if (!pending_->to_self.empty()) {
        Message message = std::move(pending_->to_self.front());
        pending_->to_self.pop_front();
        return message;
    }
    if (size_ == 1) return {};
    int found = 0;
    MPI_Message handle = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status);
    if (!found) return {};
    int bytes = 0;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    Message message{status.MPI_SOURCE, status.MPI_TAG,
                    Bytes(static_cast<std::size_t>(bytes))};
    MPI_Mrecv(message.data.data(), bytes, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    return message;
}

void Comm::barrier() {
    if (size_ == 1) return;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    sleep_until_done(request);
}

std::vector<Bytes> Comm::all_gather(const Bytes& data) {
    if (size_ == 1) return {data};
    const int n_ranks = size_;
    std::vector<int> sizes(static_cast<std::size_t>(n_ranks)), starts(sizes.size());
    const int mine = checked_size(data.size());
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
    sleep_until_done(request);
    std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
    Bytes all(static_cast<std::size_t>(starts.back() + sizes.back()));
    MPI_Iallgatherv(data.data(), mine, MPI_BYTE, all.data(), sizes.data(), starts.data(),
                    MPI_BYTE, MPI_COMM_WORLD, &request);
    sleep_until_done(request);
    std::vector<Bytes> parts;
    parts.reserve(sizes.size());
    for (std::size_t r = 0; r < sizes.size(); ++r)
        parts.emplace_back(all.begin() + starts[r], all.begin() + starts[r] + sizes[r]);
    return parts;
}

void Comm::abort(int exit_code) {
    if (pending_->is_started) MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
}

std::string host_name() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

std::string mpi_version() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
    int length = 0;
    MPI_Get_library_version(text, &length);
    const std::string version(text, static_cast<std::size_t>(length));
    return version.substr(0, version.find(','));
}

}  // namespace bemcal::run
