/// Groups of things that are alike, without a look at every pair and without a list of
/// them.
///
/// Things are added one after the other and held against those before, of each group
/// against its first few alone: a thing that is like one of them is of the group. A group
/// of at most `most_listed` is known pair by pair, a larger one as a whole.
#pragma once

#include <cstddef>
#include <vector>

namespace bemcal {

class AlikeGroups {
  public:
    static constexpr std::size_t most_listed = 10;

    explicit AlikeGroups(std::size_t n);

    /// Known to be alike before they are added.
    void join(std::size_t a, std::size_t b);
    /// \param is_alike  (earlier, this) -> bool; not asked of a large group that it is in
    template <class IsAlike>
    void add(std::size_t k, IsAlike&& is_alike) {
        for (const std::size_t earlier : shown_)
            if (!(is_large(k) && first_of(earlier) == first_of(k)) &&
                is_alike(earlier, k))
                join(earlier, k);
        if (n_shown_[first_of(k)] >= most_listed) return;
        ++n_shown_[first_of(k)];
        shown_.push_back(k);
    }

    /// The least member of its group.
    std::size_t first_of(std::size_t k) const;
    bool is_large(std::size_t k) const { return sizes_[first_of(k)] > most_listed; }
    /// The members of each large group, rising.
    std::vector<std::vector<std::size_t>> large_groups() const;

  private:
    mutable std::vector<std::size_t> parents_;  ///< roots are the least of their group
    std::vector<std::size_t> sizes_, n_shown_;  ///< of roots
    std::vector<std::size_t> shown_;            ///< those that stand for their groups
};

}  // namespace bemcal
