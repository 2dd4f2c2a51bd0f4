/// Places of templates that take effects by the hour, for a program that reads no
/// effect_files.
#pragma once

#include "study/hourly_simulator.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::external {

struct EffectPlace {
    std::string name;           ///< in a template: `@gains_by_hour@`
    std::string hook;           ///< of the effects that it takes
    std::string facade, meter;  ///< where they are at one of them; "" = at all
};

/// What goes into the places.
struct PlacedEffects {
    std::vector<std::string> texts;     ///< [places] a number for each hour, a line each
    std::vector<std::string> left_out;  ///< effects without a place, and why
};

/// Effects at one place add up; it has 0 where there are none.
PlacedEffects placed(std::span<const EffectPlace> places,
                     std::span<const study::GivenEffect> effects, std::size_t n_hours);

}  // namespace bemcal::external
