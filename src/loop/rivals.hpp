/// Which candidates of a step unseen blocks cannot tell from the one that was chosen.
#pragma once

#include "loop/search.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::loop {

struct EffectClass {
    std::vector<std::string> names;       ///< the chosen one's first, no more than 3
    std::vector<effects::Effect> rivals;  ///< worth trying in its place later
    bool is_told = true;  ///< nothing else comes as near, the grammar's terms included
};

/// Whether losses [blocks] are not larger than the chosen one's by more than chance
/// shows, or by so little that it says nothing.
bool is_as_good(std::span<const double> losses, std::span<const double> chosen);

/// A candidate is in the class where its losses in unseen blocks, compared pair by pair
/// with those of the chosen one, are not larger by more than chance shows in one of
/// twenty (after the model confidence set of Hansen, Lunde and Nason 2011, with pairs in
/// place of its range statistic).
EffectClass class_of(const LoopData& data, const Standing& before, const Step& step);

}  // namespace bemcal::loop
