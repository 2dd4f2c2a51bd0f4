/// The search for the next effect: every candidate is tried on the tangent of the model
/// that stands, the best are refitted in full, and the first that passes all gates joins.
#pragma once

#include "loop/baseline.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// A candidate seen from the model that stands.
struct Screened {
    effects::Effect effect;
    double gain = 0;                ///< fall of the objective, all else refitted [-]
    double coefficient = 0;         ///< where that is
    double information = 0;         ///< of the coefficient, all else free
    std::vector<double> by_block;   ///< its score, block by block: for the null; may be
                                    ///< empty
    std::vector<double> signature;  ///< [targets] effect at its typical size, what the
                                    ///< other unknowns can follow taken off; may be empty
    std::vector<double> bias;  ///< [unknowns] what leaving it out does to them, at its
                               ///< typical size [prior sd]
    double visibility = 0;     ///< share of it that the other unknowns cannot follow; of
                               ///< the typical, where it is small: a large one bends
};

/// What is wanted: gains; scores by block, too; signatures and bias, too; or these of the
/// typical size, whatever the readings say of it and wherever the fit has met a limit.
enum class Keep { gains, scores, signatures, of_typical };

/// In the order of the candidates; those that cannot be simulated are left out.
std::vector<Screened> screen(const LoopData& data, const Place& place,
                             const Standing& standing,
                             const std::vector<effects::Effect>& candidates, Keep keep);

/// The largest gain that a screening of nothing but noise would show, exceeded with
/// probability alpha: blocks' scores with random signs (multiplier bootstrap of the
/// largest statistic, Chernozhukov, Chetverikov and Kato 2013); at least what as many
/// normal scores would.
double null_gain(const std::vector<Screened>& screened, double alpha, std::uint64_t seed);

/// A candidate after its refit.
struct Refitted {
    effects::Effect effect;
    Standing standing;
    double gain = 0;   ///< of evidence: fall of the deviance less what freedom costs
    double score = 0;  ///< fall of the deviance of left-out blocks
    std::vector<double> error{};     ///< [channels] relative change of the left-out error
    std::vector<double> left_out{};  ///< [targets] residuals of unseen blocks, by the
                                     ///< noise of the model before
    std::string objection{};         ///< the gate that it did not pass; empty = none
    double coefficient = 0;
};

/// One step of the search.
struct Step {
    std::vector<Refitted> ranking;  ///< best first
    double threshold = 0;
    int chosen = -1;  ///< of ranking; -1 = nothing passes
};
/// \param barred  names of effects that are not tried: they have left again at once
Step search(const LoopData& data, const Place& place, const Standing& standing,
            const std::vector<std::string>& barred = {});

/// What a step decides of its candidates, apart from any model. The best by gain, a few
/// of each name only: these are refitted.
std::vector<const Screened*> shortlist(const std::vector<Screened>& screened);
/// What freedom costs: the logarithm of how far the data narrow the coefficient; of runs
/// of days, the choice of each.
double occam(const Screened& screened);
/// Whether other dates or hours may make a candidate the best.
bool may_lead_by_dates(const Refitted& candidate, double best_gain);
/// The first with a name that passes, or that follows a series of the job; -1: none. What
/// passes without a name gets an objection.
int choice_of(std::vector<Refitted>& ranking);

}  // namespace bemcal::loop
