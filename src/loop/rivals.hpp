/// Which names could stand for what a step found, and how probable each is.
#pragma once

#include "loop/found.hpp"
#include "loop/search.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace bemcal::loop {

struct EffectClass {
    std::vector<Named> names;             ///< the chosen one's first, then the likelier
    std::vector<effects::Effect> rivals;  ///< worth trying in its place later

    double probability() const { return names.front().probability; }
};

/// What a candidate would explain.
struct Claim {
    std::string name;           ///< "": where and when, not why
    std::vector<double> falls;  ///< [blocks] of -2 log likelihood
    double rest = 0;  ///< what evidence has beside: priors, less what freedom costs
};

/// The probabilities of all names that claims have, and of "": that it is none of these.
/// Within a drawing of the blocks with replacement they are as exp(evidence / 2). Names
/// are equally probable before, and so is that nothing is missing; claims of one name
/// share what it has. The mean over drawings is the bagged posterior (Huggins and Miller
/// 2023, Bayesian Analysis 18), which stays doubtful between models that are all wrong.
std::vector<Named> bagged(const std::vector<Claim>& claims, std::uint64_t seed);

/// \param before  the model without any of them
EffectClass class_of(const LoopData& data, const Standing& before, const Step& step);

}  // namespace bemcal::loop
