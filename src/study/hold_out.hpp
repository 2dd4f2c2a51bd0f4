/// Readings kept from the likelihood, drawn at random: whole weeks, and single hours of
/// the others. Neighbours of a single hour are in the training set, so its error says
/// less of what the model can foresee than that of a whole week.
#pragma once

#include "physics/calendar.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace bemcal::study {

enum class Role { training, held_out_hour, held_out_week };

struct HoldOut {
    double weeks = 0, hours = 0;  ///< shares
    std::uint64_t seed = 0;
};

/// The role of each reading; a week is the same for all meters.
std::vector<Role> draw_roles(std::span<const physics::Seconds> begins, std::size_t meter,
                             const HoldOut& hold_out);

}  // namespace bemcal::study
