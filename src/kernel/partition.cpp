/// Sorts steps into classes in which profiles are constant. Keys are numbered by a hash
/// table of its own kind: there are up to half a million, and runs of equal ones are the
/// rule.
/// Plain bookkeeping without a source. Only equal bits are one class (0 and -0 too):
/// nearly equal values are not merged.
#include "kernel/partition.hpp"

#include <bit>
#include <cstdint>

namespace bemcal::kernel {

namespace {

/// Numbers of keys, in the order in which they come.
class Numbering {
  public:
    int operator()(std::uint64_t key) {
        if (2 * static_cast<std::size_t>(size_) >= slots_.size()) grow();
        Slot& slot = slot_of(key);
        if (slot.number < 0) slot = {key, size_++};
        return slot.number;
    }

  private:
    struct Slot {
        std::uint64_t key = 0;
        int number = -1;
    };

    Slot& slot_of(std::uint64_t key) {
        constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
        std::size_t at = (key ^ (key >> 32)) * golden >> (64 - bits_);
        while (slots_[at].number >= 0 && slots_[at].key != key)
            at = (at + 1) & (slots_.size() - 1);
        return slots_[at];
    }

    void grow() {
        const std::vector<Slot> old = std::move(slots_);
        bits_ += 2;
        slots_.assign(std::size_t{1} << bits_, {});
        for (const Slot& slot : old)
            if (slot.number >= 0) slot_of(slot.key) = slot;
    }

    int size_ = 0, bits_ = 4;
    std::vector<Slot> slots_ = std::vector<Slot>(16);
};

/// Numbers of pairs of classes, straight from a table.
class PairTable {
  public:
    explicit PairTable(std::size_t n_pairs) : number_of_(n_pairs, -1) {}
    int operator()(std::uint64_t pair) {
        int& number = number_of_[pair];
        if (number < 0) number = size_++;
        return number;
    }

  private:
    std::vector<int> number_of_;
    int size_ = 0;
};

template <class Key, class Number>
Partition classes_by(std::size_t n_steps, Key key, Number number_of) {
    Partition classes;
    classes.class_of.resize(n_steps);
    std::uint64_t last = 0;
    int number = -1;
    for (std::size_t step = 0; step < n_steps; ++step) {
        const std::uint64_t here = key(step);
        if (step == 0 || here != last) {
            number = number_of(here);
            if (number == classes.size()) classes.first.push_back(static_cast<int>(step));
            last = here;
        }
        classes.class_of[step] = number;
    }
    return classes;
}

/// 0 and -0 are one value.
std::uint64_t bits_of(double value) {
    return std::bit_cast<std::uint64_t>(value + 0.0);
}

}  // namespace

Partition one_class(int n_steps) {
    return {std::vector<int>(static_cast<std::size_t>(n_steps), 0), {0}};
}

Partition classes_of(std::span<const double> values) {
    return classes_by(
        values.size(), [&](std::size_t step) { return bits_of(values[step]); },
        Numbering());
}

Partition both(const Partition& a, const Partition& b) {
    constexpr std::size_t most_pairs = 1 << 16;
    if (b.size() == 1) return a;
    if (a.size() == 1) return b;
    const auto n_b = static_cast<std::uint64_t>(b.size());
    const std::size_t n_pairs = static_cast<std::size_t>(a.size()) * n_b;
    const auto pair = [&](std::size_t step) {
        return static_cast<std::uint64_t>(a.class_of[step]) * n_b +
               static_cast<std::uint64_t>(b.class_of[step]);
    };
    if (n_pairs <= most_pairs)
        return classes_by(a.class_of.size(), pair, PairTable(n_pairs));
    return classes_by(a.class_of.size(), pair, Numbering());
}

const Partition& ProfileClasses::of(int profile) {
    const auto row = static_cast<std::size_t>(profile);
    std::optional<Partition>& known = known_[row];
    if (known) return *known;
    return known.emplace(classes_of(drive_.profiles.row(row)));
}

Partition ProfileClasses::refine(Partition classes, const std::vector<int>& profiles) {
    for (int profile : profiles) classes = both(classes, of(profile));
    return classes;
}

}  // namespace bemcal::kernel
