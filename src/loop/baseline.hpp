/// The baseline of the loop: the plain building calibrated, then with the structure that
/// predicts best what was left out.
#pragma once

#include "loop/model.hpp"

namespace bemcal::loop {

/// A model with its fit to the training period.
struct Standing {
    LoopModel model;
    BuiltModel built;
    study::Fit fit;
    std::vector<ChannelNoise> noise;  ///< of its own residuals
    std::vector<double> residuals;    ///< [targets]
    std::vector<double> left_out;     ///< [targets] residuals of blocks it had not seen
    double score = 0;                 ///< deviance of left_out, by the baseline's noise

    /// Of one of model.effects, in its unit.
    double coefficient(std::size_t effect) const {
        const std::size_t k = built.first_effect() + effect;
        return built.unknowns[k].value(fit.at.x[k]);
    }
};

/// The unknowns of a model where a standing one has them, those that it lacks 0, in the
/// parameters' units. [unknowns of the model]
std::vector<double> values_in(const BuiltModel& built, const Standing& standing);
/// The model's building with its parameters at these values.
physics::Building building_at(const BuiltModel& built, const std::vector<double>& values);

/// Fits the model that is built, by its noise, from a start; residuals where it went
/// well.
void refit(const LoopData& data, Standing& standing, std::vector<double> start,
           const study::FitOptions& options);
/// The same from where it stands.
void refit(const LoopData& data, Standing& standing, const study::FitOptions& options);

/// Of a fit that ends where it is to stay; and without a step: it tells what stands, and
/// its slopes.
inline constexpr study::FitOptions to_settle{8, 3e-4}, only_derivatives{0, 0};

/// What the parameters' priors add to -2 log likelihood.
double prior_pull(std::span<const study::FitUnknown> unknowns, std::span<const double> x);

/// Fills left_out and score, by the standing's own noise.
void score_unseen(const LoopData& data, Standing& standing);

/// Takes a fit on to its end, then its noise and its score.
void settle(const LoopData& data, Standing& standing);

/// Fall of the deviance, by the noise of the first, and of what the prior adds.
double evidence(const LoopData& data, const Standing& without, const Standing& with);

/// Fits until the noise that weighs the channels is that of the residuals.
Standing calibrate(const LoopData& data, const Place& place, const LoopModel& model,
                   std::vector<double> start);

/// Residuals of every other block under a fit to the others, and the other way round.
std::vector<double> left_out_of(const LoopData& data, const BuiltModel& built,
                                const study::Linearised& from,
                                const std::vector<ChannelNoise>& noise,
                                std::span<const int> blocks);

struct TriedStructure {
    std::string name;
    double score;  ///< over the standard's; each against the last one chosen by one noise
};

struct Baseline {
    Standing plain, chosen;
    Place place;  ///< of the chosen structure
    std::vector<TriedStructure> tried;
    double gained = 0;  ///< change of the score from the standard's to the chosen one's
};
/// The building as described, from where the options say.
Standing calibrate_plain(const LoopData& data);

/// One refinement joins after the other, the best first, as long as the score falls.
Baseline make_baseline(const LoopData& data);

/// Refinements leave that a model with effects no longer needs, those that joined last
/// first: they had stood for what the effects explain. A refinement is needed where
/// unseen blocks are foretold worse without it. Settles what is left, if any leaves.
/// \param place  of the standing model, with its loads; then of what is left of it
/// \return those that left, as indices into effects::refinements
std::vector<std::size_t> leave_unneeded_refinements(const LoopData& data, Place& place,
                                                    Standing& standing);

}  // namespace bemcal::loop
