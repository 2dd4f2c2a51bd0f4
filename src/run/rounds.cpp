/// The rounds of one stage: rank 0 asks it what comes next from all answers so far, and
/// what the round needs goes to every rank before its items do.
/// Our own protocol, without a source. Items are numbered through all rounds. All answers
/// so far stay in rank 0's memory.
#include "run/rounds.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "run/timer.hpp"
#include "run/together.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>

namespace bemcal::run {
namespace {

/// The number of items, then what they need.
Bytes to_bytes(const study::Round& round) {
    const std::size_t n_values = round.needed.size() * sizeof(double);
    Bytes bytes(sizeof round.n_items + n_values);
    std::memcpy(bytes.data(), &round.n_items, sizeof round.n_items);
    if (n_values > 0)
        std::memcpy(bytes.data() + sizeof round.n_items, round.needed.data(), n_values);
    return bytes;
}

study::Round to_round(const Bytes& bytes) {
    study::Round round;
    std::memcpy(&round.n_items, bytes.data(), sizeof round.n_items);
    const std::size_t n_values = bytes.size() - sizeof round.n_items;
    round.needed.resize(n_values / sizeof(double));
    if (n_values > 0)
        std::memcpy(round.needed.data(), bytes.data() + sizeof round.n_items, n_values);
    return round;
}

/// Of what this round needs and all before it: an answer may follow from those, too.
std::uint64_t checksum_of(std::uint64_t before, const study::Round& round) {
    const std::uint64_t both[] = {
        before, checksum64(round.needed.data(), round.needed.size() * sizeof(double))};
    return checksum64(both, sizeof both);
}

/// Rank 0's answer from the stage, on every rank; none: it is done.
std::optional<study::Round> next_round(Comm& comm, const study::Stage& stage,
                                       const std::vector<study::ItemAnswer>& answers) {
    Bytes bytes;
    together(comm, [&] {
        if (comm.rank() != 0) return;
        const std::optional<study::Round> round = stage.next_round(answers);
        if (!round) return;
        require(round->n_items > 0, "a stage asked for a round without items");
        bytes = to_bytes(*round);
    });
    const Bytes shared = comm.all_gather(bytes)[0];
    if (shared.empty()) return std::nullopt;
    return to_round(shared);
}

/// One round's items, added to all.
void run_round(Comm& comm, const study::Stage& stage, int first, int count,
               const RoundOptions& options, Distributed& all) {
    Items items{first, count, {}, {}};
    if (comm.rank() == 0 && options.known) items = options.known(first, count);
    Distributed done = distribute(comm, stage, std::move(items), options.distribute);
    std::ranges::move(done.answers, std::back_inserter(all.answers));
    all.stopped = done.stopped;
    all.busy_seconds += done.busy_seconds;
}

void run_all(Comm& comm, study::Stage& stage, const RoundOptions& options,
             Distributed& all) {
    const Timer timer(all.seconds);
    int first = 0, count = stage.n_items();
    RoundStart start;
    for (;; ++start.round) {
        if (options.on_round) options.on_round(start);
        run_round(comm, stage, first, count, options, all);
        if (all.stopped) return;
        const auto next = next_round(comm, stage, all.answers);
        if (!next) return;
        first += count;
        count = next->n_items;
        stage.begin_round(first, *next);
        start.checksum = checksum_of(start.checksum, *next);
    }
}

}  // namespace

Distributed run_rounds(Comm& comm, study::Stage& stage, const RoundOptions& options) {
    Distributed all;
    run_all(comm, stage, options, all);
    return all;
}

}  // namespace bemcal::run
