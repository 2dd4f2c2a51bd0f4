/// How well items are handed out: workers that sleep, 64 of them on any machine, so that
/// what is measured is the master and its messages, not the cores.
///
/// Started alone it starts itself under mpirun with 8, 16, 32 and 64 ranks. A worker owes
/// the time of its items and sleeps it off in naps of some milliseconds: a sleep of 100
/// us by itself would cost as much again. Efficiency is the items' time over workers x
/// wall.
///
/// A model of the same (the real Schedule, a clock for each worker, one for the master
/// with its cost for each message and each item, as measured here) is held against the
/// measured efficiencies and carried to 1,024 and 16,384 ranks.
/// Prints `name value unit reference ratio`.
#include "run/comm.hpp"
#include "run/distribute.hpp"
#include "run/schedule.hpp"
#include "store/item_log.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <queue>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

namespace {

using namespace bemcal;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

struct Case {
    const char* name;
    int n_items;
    double item_s;
    int long_every;  ///< one item in so many is 200 times longer; 0 = none
    double asked;    ///< efficiency on 64 workers
    double seconds_of(int item) const {
        const bool is_long = long_every > 0 && item % long_every == long_every / 2;
        return is_long ? 200 * item_s : item_s;
    }
    double total_s() const {
        double sum = 0;
        for (int item = 0; item < n_items; ++item) sum += seconds_of(item);
        return sum;
    }
};

constexpr Case cases[] = {{"even", 1'000'000, 1e-4, 0, 0.93},
                          {"uneven", 1'000'000, 1e-4, 1000, 0.90}};

class Sleeping : public study::Stage {
  public:
    explicit Sleeping(const Case& shape) : case_(shape) {}
    std::string name() const override { return "sleeping"; }
    int n_items() const override { return case_.n_items; }
    long long n_simulations() const override { return case_.n_items; }
    std::size_t answer_bytes() const override { return 8; }
    study::ItemAnswer run(int item) const override {
        static thread_local Clock::time_point awake_until{};
        const auto now = Clock::now();
        // A worker that had nothing to do owes nothing; one that overslept is ahead.
        if (awake_until < now - std::chrono::milliseconds(5)) awake_until = now;
        awake_until +=
            std::chrono::duration_cast<Clock::duration>(Seconds(case_.seconds_of(item)));
        if (awake_until > now + std::chrono::milliseconds(2))
            std::this_thread::sleep_until(awake_until);
        return {{1.0 * item}, {}, {}};
    }
    study::Conclusion conclude(const std::vector<study::ItemAnswer>&) const override {
        return {};
    }

  private:
    Case case_;
};

double cpu_seconds() {
    rusage use{};
    ::getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

/// One long item, and what the ranks without one spend while they wait for it.
void measure_idle(run::Comm& comm) {
    const Case one{"idle", 1, 10.0, 0, 0};
    const double before = cpu_seconds();
    const auto done = run::distribute(comm, Sleeping(one), {0, one.n_items, {}, {}}, {});
    const double share = (cpu_seconds() - before) / done.seconds;
    run::Bytes mine(sizeof share);
    std::memcpy(mine.data(), &share, sizeof share);
    double most = 0;
    for (const auto& bytes : comm.all_gather(mine)) {
        double other = 0;
        std::memcpy(&other, bytes.data(), sizeof other);
        most = std::max(most, other);
    }
    if (comm.rank() == 0)
        fmt::print("idle_rank_cpu_share {:.4f} core 0.05 {:.2f}\n", most, 0.05 / most);
}

/// What a message and an item cost the master [s]: unpacking, book-keeping, memory.
struct Costs {
    double message = 0, item = 0, latency = 0;
};

Costs measure_costs() {
    constexpr int n = 200'000;
    study::ItemAnswer answer{{1.0}, {}, {}};
    const auto packed = store::pack(answer);
    std::vector<study::ItemAnswer> answers(n);
    std::vector<int> items(n);
    run::Schedule schedule(items, 1);
    schedule.join(0, 1);
    const auto begin = Clock::now();
    while (!schedule.is_complete())
        for (const auto& block : schedule.blocks_due())
            for (std::size_t k = 0; k < block.items.size(); ++k) {
                answers[k] = store::unpack(packed.data(), packed.size());
                schedule.finished(0);
            }
    Costs costs;
    costs.item = Seconds(Clock::now() - begin).count() / n;
    costs.message = 5e-6;    // MPI over shared memory or a network: send, probe, receive
    costs.latency = 1.5e-3;  // a poll of the worker's main thread, and the wake-up
    return costs;
}

/// The wall time of a case by the model: events of workers that finish what they hold.
double modelled_s(const Case& shape, int n_workers, const Costs& costs) {
    std::vector<int> items(static_cast<std::size_t>(shape.n_items));
    for (int k = 0; k < shape.n_items; ++k) items[static_cast<std::size_t>(k)] = k;
    run::Schedule schedule(std::move(items), n_workers);
    for (int rank = 0; rank < n_workers; ++rank) schedule.join(rank, 1);
    struct Event {
        double at;
        run::Schedule::Block block;
        bool operator<(const Event& other) const { return at > other.at; }
    };
    std::priority_queue<Event> events;
    std::vector<double> free_at(static_cast<std::size_t>(n_workers), 0);
    double master = 0, end = 0;
    const auto send_due = [&] {
        for (auto& block : schedule.blocks_due()) {
            master += costs.message;
            double& worker = free_at[static_cast<std::size_t>(block.rank)];
            worker = std::max(worker, master + costs.latency);
            for (const int item : block.items) worker += shape.seconds_of(item);
            events.push({worker, std::move(block)});
        }
    };
    send_due();
    while (!events.empty()) {
        const Event event = events.top();
        events.pop();
        master = std::max(master, event.at + costs.latency) + costs.message +
                 costs.item * static_cast<double>(event.block.items.size());
        for (std::size_t k = 0; k < event.block.items.size(); ++k)
            schedule.finished(event.block.rank);
        end = std::max(end, master);
        send_due();
    }
    return end;
}

double efficiency(const Case& shape, int n_workers, double wall_s) {
    return shape.total_s() / (n_workers * wall_s);
}

void measure_case(run::Comm& comm, const Case& shape, const Costs& costs) {
    comm.barrier();
    const auto done =
        run::distribute(comm, Sleeping(shape), {0, shape.n_items, {}, {}}, {});
    if (comm.rank() != 0) return;
    const double measured = efficiency(shape, comm.size(), done.seconds);
    const double model =
        efficiency(shape, comm.size(), modelled_s(shape, comm.size(), costs));
    fmt::print("{}_{}_efficiency {:.4f} 1 {} {:.3f}\n", shape.name, comm.size(), measured,
               shape.asked, measured / shape.asked);
    fmt::print("{}_{}_model {:.4f} 1 {:.4f} {:.3f}\n", shape.name, comm.size(), model,
               measured, model / measured);
    std::fflush(stdout);
}

/// On paper: a hundred times the items, and which of the model's costs is the first
/// limit.
void carry_on(const Costs& costs) {
    for (const int n_workers : {1024, 16384}) {
        const Case shape{"even", 10'000'000, 1e-4, 0, 0};
        const double all = modelled_s(shape, n_workers, costs);
        Costs no_item = costs, no_message = costs, no_latency = costs;
        no_item.item = no_message.message = no_latency.latency = 0;
        fmt::print("paper_{}_efficiency {:.4f} 1 - -\n", n_workers,
                   efficiency(shape, n_workers, all));
        for (const auto& [name, without] :
             {std::pair{"items", no_item}, std::pair{"messages", no_message},
              std::pair{"latency", no_latency}})
            fmt::print(
                "paper_{}_without_{} {:.4f} 1 - -\n", n_workers, name,
                efficiency(shape, n_workers, modelled_s(shape, n_workers, without)));
    }
    fmt::print("paper_most_items_per_second {:.3g} 1/s - -\n", 1 / costs.item);
}

int start_under_mpirun(const char* program) {
    int failed = 0;
    for (const int n_ranks : {8, 16, 32, 64})
        failed |=
            std::system(fmt::format("mpirun -np {} --oversubscribe --bind-to none {}",
                                    n_ranks, program)
                            .c_str());
    return failed != 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (!std::getenv("OMPI_COMM_WORLD_RANK")) return start_under_mpirun(argv[0]);
    run::Comm comm(&argc, &argv);
    Costs costs;
    if (comm.rank() == 0) costs = measure_costs();
    if (comm.size() == 8) measure_idle(comm);
    for (const Case& shape : cases) measure_case(comm, shape, costs);
    if (comm.rank() == 0 && comm.size() == 64) carry_on(costs);
}
