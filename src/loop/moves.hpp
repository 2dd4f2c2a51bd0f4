/// Moves of a model that stands: shapes refined, effects put in place of others, effects
/// that leave.
#pragma once

#include "loop/baseline.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

/// Whether an effect begins or ends on a date. A day beside it is a day of large errors,
/// which something else would seem to explain.
bool is_dated(const effects::Effect& effect);

/// Whether it is a set-point in some hours of the day. Its hours move before it is
/// judged: controllers know any. What others bring in some hours the model's mornings
/// have, too.
bool is_set_point_window(const effects::Effect& effect);

/// Whether a step stands in the first or the last two weeks of training: the first owe
/// much to a state that nobody knows, and the last are too few to say what goes on.
bool is_at_an_end(const LoopData& data, const effects::Effect& effect);

/// The model with the effect's thresholds and dates at their best values, by its noise.
Standing with_best_shape(const LoopData& data, const Place& place, Standing standing,
                         std::size_t effect);

/// Calibrated anew from the prior's means with its effects in place, where that explains
/// more: without an effect parameters went to where they stood for it, and a fit from
/// there may end beside it. Says whether it did.
bool start_again(const LoopData& data, const Place& place, Standing& standing);

/// The same with the noise that it leaves.
Standing refine_shape(const LoopData& data, const Place& place, Standing standing,
                      std::size_t effect);

/// What an effect's coefficient owes to its shape: the root of its mean square difference
/// over the shapes beside its own, each as likely as its fit says where errors are
/// `misfit` times what noise leaves; in its unit.
double deviation_over_shapes(const LoopData& data, const Place& place,
                             const Standing& standing, std::size_t effect, double misfit);

/// An effect that takes the place of another, and the fit from there.
struct InPlace {
    std::size_t index;
    effects::Effect effect;
    std::vector<double> start;
    study::FitOptions options;
};
/// The model with it, by the noise of the standing one; fit.failed where that cannot be.
Standing with_in_place(const LoopData& data, const Place& place, const Standing& standing,
                       const InPlace& change);
/// Where such a fit starts: at half of the rival's typical size, all else as it stands.
std::vector<double> start_of_rival(const Standing& standing, std::size_t effect,
                                   const effects::Effect& rival);

/// The model with the best of the rivals in place of an effect, where that explains
/// clearly more; else as it was. Says which: -1 = none.
int swap(const LoopData& data, const Place& place, Standing& standing, std::size_t effect,
         const std::vector<effects::Effect>& rivals);

/// What split adds to the name of an effect of use.
inline constexpr const char* suffix_of_use = ": use";

/// Where all schedules follow another day's, the plant's and those of use may do so to
/// different degrees: the effect becomes the plant's, and one of use joins as the last,
/// where that brings more than `least` of evidence and the degrees differ. Says whether
/// it did.
bool split(const LoopData& data, const Place& place, Standing& standing,
           std::size_t effect, double least);

/// An effect that has left: its place among those that were there at that moment.
struct Gone {
    std::size_t index;
    std::string name;
};

/// Lets an effect leave; nothing where the model cannot do without it.
std::optional<Gone> take_out(const LoopData& data, const Place& place, Standing& standing,
                             std::size_t effect);

/// Effects leave that the model can do without for less than so much evidence, the least
/// first; where one half leaves of an effect that was split, the other stands for both
/// again. Returns them in that order.
std::vector<Gone> prune(const LoopData& data, const Place& place, Standing& standing,
                        double least);

/// Effects leave whose coefficients or dates have left what is plausible, as shapes moved
/// or others joined. Returns them in the order in which they left.
std::vector<Gone> prune_implausible(const LoopData& data, const Place& place,
                                    Standing& standing);

/// No meter pays for what effects mend at another: one whose readings the model explains
/// worse than the one before them did counts more in the fit, until the errors are within
/// 0.2 % of what they were; as near to that as eight fits come without an effect that
/// becomes another. Says whether that changed anything.
bool spare_meters(const LoopData& data, const Standing& before, Standing& standing);

}  // namespace bemcal::loop
