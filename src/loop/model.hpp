/// A building in the loop: its training data, a model of it (structure and effects), and
/// how well that model stands.
#pragma once

#include "effects/placement.hpp"
#include "effects/placer.hpp"
#include "effects/refinements.hpp"
#include "loop/options.hpp"
#include "study/case.hpp"
#include "study/fit_model.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

/// How far a channel's readings stray from a model, and how long errors last.
struct ChannelNoise {
    double sigma = 1;  ///< root mean square of the residual [channel's unit]
    double kappa = 1;  ///< variance of sums over a week, per that of independent errors
    double share = 1;  ///< of a meter that matters; less where little energy flows
    double least = 0;  ///< sigma of a model as good as models are [channel's unit]

    /// Of a reading's squared error in -2 log likelihood.
    double weight() const { return share / (sigma * sigma * kappa); }
};

/// What does not change while the loop searches.
struct LoopData {
    LoopData(const study::Case& given, const LoopOptions& chosen);

    /// Its planes are those of every refinement. It also has a profile of numbered hours
    /// for each schedule whose hours may be searched.
    study::Case building;
    LoopOptions options;
    std::vector<std::size_t> meters;       ///< channels: indices into building.meters
    study::Targets targets;                ///< of the training period
    std::vector<physics::Seconds> begins;  ///< [targets.size()] of the readings
    std::shared_ptr<const physics::Drive> drive;  ///< of the training period
    std::vector<int> blocks;  ///< [targets.size()] of options.block_days

    const study::Period& training() const;
    /// With the planes of every refinement.
    std::shared_ptr<const physics::Drive> drive_over(const study::Period& period) const;
    std::vector<physics::Quantity> quantities() const;  ///< [channels]
    /// Whether a meter is read by the month.
    bool reads_months() const;
    bool reads_months_only() const;
    /// Of blocks of so many days; of calendar months where a meter is read by the month,
    /// so that no reading is in two.
    std::vector<int> blocks_of(double days) const;
};

/// Whether nobody wrote the hours of a schedule down.
bool has_unknown_hours(const study::Case& building, std::size_t profile);

/// The row of Drive::profiles in which the hours of a schedule are numbered; nothing of
/// one that has no single run of hours a day.
std::optional<std::size_t> numbered_row_of(const study::Case& building,
                                           std::size_t profile);

/// The meters' readings of a period, those missing that show the state that the building
/// had before where nothing is known of that: of two days, in periods of twenty or more.
std::vector<kernel::Readings> training_readings(const study::Case& building,
                                                const study::Period& period);

/// A model: which refinements, which effects.
struct LoopModel {
    std::vector<std::size_t> structure;  ///< beside what the description has
    std::vector<effects::Effect> effects;
};

/// A structure with what the description has already, which comes first.
std::vector<std::size_t> whole_structure(const LoopData& data,
                                         const std::vector<std::size_t>& structure);

/// A model that has been built: ready to be simulated over a period.
struct BuiltModel {
    physics::Building building;  ///< with structure, without effects
    std::shared_ptr<const physics::Drive> drive;
    std::shared_ptr<const effects::Placed> placed;
    std::vector<study::FitUnknown> unknowns;  ///< parameters, refinements, effects found
    std::vector<physics::Parameter> parameters;
    std::shared_ptr<const study::FitModel> fit_model;  ///< nullptr of place_only
    std::size_t n_effects = 0;

    std::size_t first_effect() const { return unknowns.size() - n_effects; }
};

/// Series that the training period's effects follow, for a structure.
struct Place {
    physics::Building building;                          ///< with the structure's numbers
    std::shared_ptr<const physics::Building> described;  ///< what the surroundings show
    std::shared_ptr<const physics::Drive> drive;
    std::shared_ptr<effects::Surroundings> surroundings;
    std::vector<physics::Parameter> parameters;
    std::vector<study::FitUnknown> unknowns;
    std::vector<effects::Refinement::Always> always;  ///< of the structure
    /// What functions bring, one effect for each of their hooks: it is there as it is,
    /// no unknown goes with it.
    std::vector<effects::Effect> functions;
    std::vector<kernel::Channel> channels;
};

/// A drive in which declared effects follow these loads, and what the structure shows
/// them: the sun through other glass. The drive itself where the structure brings inputs
/// that they would enter, too. The description must declare some.
std::shared_ptr<const physics::Drive> drive_with_loads(
    const LoopData& data, const std::vector<std::size_t>& structure,
    const effects::ModelSeries& loads, std::shared_ptr<const physics::Drive> drive);

/// The building with the structure over a period, ready for effects. Throws
/// CannotSimulate where a refinement has nothing to refine.
Place make_place(const LoopData& data, const std::vector<std::size_t>& structure,
                 std::shared_ptr<const physics::Drive> drive);

/// What effects see that enter the building of a place.
effects::Surroundings surroundings_of(const Place& place);

/// Throws CannotSimulate where an effect cannot enter.
BuiltModel build(const Place& place, const std::vector<effects::Effect>& effects);
/// The same without what simulates its points.
BuiltModel place_only(const Place& place, const std::vector<effects::Effect>& effects);

/// Models that have a few effects more than another, of which one at a time acts: what
/// they share is placed once.
class OneMore {
  public:
    /// \param place  must outlive this, and stay as it is
    OneMore(const Place& place, const std::vector<effects::Effect>& effects);
    OneMore(const OneMore&) = delete;  // parts refer to each other
    OneMore& operator=(const OneMore&) = delete;

    /// The model with the effects, until the next ones. Throws as `build` does.
    const study::FitModel& with(const std::vector<const effects::Effect*>& effects);
    /// Of the effects that `with` had.
    std::span<const physics::Parameter> coefficients() const {
        return std::span(parameters_).last(n_effects_);
    }

  private:
    const Place& place_;
    physics::Drive shared_;  ///< with other hours than declared, without profiles
    effects::Surroundings surroundings_;
    effects::Placer placer_;  ///< of what they share
    physics::Building building_;
    physics::Drive drive_;
    std::vector<physics::Parameter> parameters_;
    std::size_t n_effects_ = 0;
    std::unique_ptr<const study::FitModel> fit_model_;
};

/// [targets.size()] weights by channel; 0 where nothing is measured.
std::vector<double> weights_of(const study::Targets& targets,
                               const std::vector<ChannelNoise>& noise);
std::vector<ChannelNoise> noise_of(const LoopData& data,
                                   std::span<const double> residuals);

/// ChannelNoise::share of an energy meter. \param mean, largest  what it, and the largest
/// one, show in an hour [kWh]
double share_of_meter(double mean, double largest);

/// Mean squares of a channel's residuals that are measured. [channels]
std::vector<double> mean_squares(const study::Targets& targets,
                                 std::span<const double> residuals);

/// -2 log likelihood with each channel's variance at its best value, errors counted as
/// often as they are independent: sum over channels of share n / kappa log(mean square +
/// least^2).
double deviance(const study::Targets& targets, const std::vector<ChannelNoise>& noise,
                std::span<const double> residuals);
/// The same of mean squares that are known. [channels]
double deviance_of_squares(const study::Targets& targets,
                           const std::vector<ChannelNoise>& noise,
                           std::span<const double> squares);

}  // namespace bemcal::loop
