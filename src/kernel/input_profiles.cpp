/// Collects the profiles that inputs follow, each once, in the order in which they are
/// met. A profile may be a driver only where it enters linearly wherever it is met.
/// Follows from how Input's value is made (building). What becomes a regime, row or
/// driver is decided in zone_plan and meter_plan.
#include "kernel/input_profiles.hpp"

#include "kernel/linear_input.hpp"

namespace bemcal::kernel {

namespace {

void add_profile(std::vector<int>& profiles, int profile) {
    if (profile >= 0 && !contains(profiles, profile)) profiles.push_back(profile);
}

}  // namespace

void add_profiles(std::vector<int>& profiles, const physics::Input& input) {
    add_profile(profiles, input.profile);
    for (const physics::Change& change : input.changes) {
        add_profile(profiles, change.profile);
    }
}

void LinearProfiles::add(const physics::Input& input) {
    const bool linear = is_linear(input);
    add_profile(linear ? alone : tabled, input.profile);
    for (const physics::Change& change : input.changes) {
        add_profile(change.kind == physics::ChangeKind::shift ? alone : tabled,
                    change.profile);
    }
}

std::vector<int> LinearProfiles::drivers() const {
    std::vector<int> profiles = alone;
    std::erase_if(profiles, [&](int profile) { return contains(tabled, profile); });
    return profiles;
}

bool is_active(const physics::Input& input) {
    return input.value != 0 || input.low != 0 || input.is_changed();
}

}  // namespace bemcal::kernel
