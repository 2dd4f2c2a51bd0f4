/// Whether a fit ends with a bias beyond what ASHRAE Guideline 14 lets it have, in words,
/// and how totals are written.
#pragma once

#include "study/case.hpp"
#include "study/summary.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// Largest NMBE of Guideline 14: 5 % by the month or longer, 10 % by shorter intervals.
double bias_limit(physics::Interval interval);

/// A meter that shows less than this share of the largest one, as measured and as
/// modelled, has no bias that matters.
constexpr double next_to_nothing = 0.02;

/// "167 MWh", from kWh.
std::string words_of_energy(double kwh);

/// A sentence for each meter of energy whose bias in the period is beyond its limit, and
/// which shows more than next to nothing; empty where there is none. Fits of other
/// periods are left out.
std::string bias_beyond(const Case& building, std::size_t period,
                        std::span<const FoundFit> fits);

/// Sentences one after the other; empty ones are left out.
std::string joined_sentences(const std::vector<std::string>& sentences);

}  // namespace bemcal::study
