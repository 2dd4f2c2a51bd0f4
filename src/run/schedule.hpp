/// Who computes what: guided blocks, with the next one handed out before the last is
/// done.
///
/// A block is 1/4 of a fair share of what remains (Polychronopoulos and Kuck 1987),
/// between 1 and 512 items; a rank is given one as long as it holds less than a block
/// beyond what its threads are busy with. Plain book-keeping: no messages, no clock.
#pragma once

#include <cstddef>
#include <vector>

namespace bemcal::run {

class Schedule {
  public:
    Schedule(std::vector<int> items, int n_ranks);

    void join(int rank, int n_threads);  ///< from now on the rank is given work
    void finished(int rank);             ///< one of the rank's items is done
    bool is_complete() const;            ///< all ranks have joined, all items are done

    struct Block {
        int rank = 0;
        std::vector<int> items;
    };
    std::vector<Block> blocks_due();  ///< to be sent now

  private:
    struct Rank {
        int n_threads = 0;
        int n_outstanding = 0;
    };
    std::size_t n_remaining() const { return items_.size() - next_; }
    int block_size() const;
    Rank* neediest();

    std::vector<int> items_;
    std::size_t next_ = 0, n_finished_ = 0;
    std::vector<Rank> ranks_;
};

}  // namespace bemcal::run
