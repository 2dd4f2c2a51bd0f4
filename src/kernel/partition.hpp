/// Steps sorted into classes in which something is constant: what a plan is made of
/// (plan.hpp).
#pragma once

#include "physics/drive.hpp"

#include <optional>
#include <span>
#include <vector>

namespace bemcal::kernel {

/// Steps sorted into classes, numbered in the order of their first appearance.
struct Partition {
    std::vector<int> class_of;  ///< [n_steps]
    std::vector<int> first;     ///< [n_classes] step in which the class appears first
    int size() const { return static_cast<int>(first.size()); }
};
Partition one_class(int n_steps);
/// By equal values, one for each step.
Partition classes_of(std::span<const double> values);
/// The classes in which both are constant.
Partition both(const Partition& a, const Partition& b);

/// Partitions by rows of Drive::profiles, each of which is sorted once.
class ProfileClasses {
  public:
    explicit ProfileClasses(const physics::Drive& drive)
        : drive_(drive), known_(drive.profiles.rows) {}
    const Partition& of(int profile);
    /// The classes in which all of these profiles are constant, too.
    Partition refine(Partition classes, const std::vector<int>& profiles);

  private:
    const physics::Drive& drive_;
    std::vector<std::optional<Partition>> known_;
};

}  // namespace bemcal::kernel
