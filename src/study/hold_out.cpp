/// Draws which readings are kept from the likelihood: whole weeks, the same for all
/// meters, then single readings of the other weeks.
/// Follows from one random number for each week, and for each reading's time and meter.
/// Shares are met on average only. Weeks begin on Thursday; readings beside a held-out
/// one still train.
#include "study/hold_out.hpp"

#include "base/random.hpp"
#include "physics/calendar.hpp"

namespace bemcal::study {
namespace {

constexpr std::uint32_t weeks_stream = 0x7765656b, hours_stream = 0x686f7572;

/// Weeks since 1970 began, from Thursday to Wednesday.
std::uint64_t week_of(physics::Seconds begin) {
    return static_cast<std::uint64_t>(begin.time_since_epoch().count() /
                                      (7 * physics::day_s));
}

bool chosen(std::uint64_t seed, std::uint32_t stream, std::uint64_t item, double share) {
    return share > 0 && Stream(seed, stream, item).uniform() < share;
}

}  // namespace

std::vector<Role> draw_roles(std::span<const physics::Seconds> begins, std::size_t meter,
                             const HoldOut& hold_out) {
    std::vector<Role> roles;
    roles.reserve(begins.size());
    for (const physics::Seconds begin : begins) {
        const auto hour =
            static_cast<std::uint64_t>(begin.time_since_epoch().count() / 60);
        if (chosen(hold_out.seed, weeks_stream, week_of(begin), hold_out.weeks))
            roles.push_back(Role::held_out_week);
        else if (chosen(hold_out.seed, hours_stream, hour * 64 + meter, hold_out.hours))
            roles.push_back(Role::held_out_hour);
        else
            roles.push_back(Role::training);
    }
    return roles;
}

}  // namespace bemcal::study
