/// Simulates the stages of a search with their functions in place, and takes the one that
/// foretells unseen blocks best; then once more about the model with these, which are
/// estimated again while others may join.
/// Source: Vehtari and others 2017 for what was left out as the judge. The search is
/// `Remainder`'s. Functions are not named: they say where and when, not why.
#include "loop/find_functions.hpp"

#include "base/error.hpp"
#include "loop/day_of_change.hpp"
#include "loop/decisions.hpp"
#include "loop/remainder.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using Series = std::vector<double>;

std::string column_of(const effects::Effect& hook) {
    return "functions at " + hook.name;
}

/// The effect that brings functions at a hook, with a coefficient of 1.
effects::Effect effect_of(const effects::Effect& hook) {
    effects::Effect effect = hook;
    effect.name = effect.column = column_of(hook);
    effect.driver = effects::Driver::column;
    effect.typical = effect.most = 1;
    effect.is_smooth = true;
    effect.least = -1;
    return effect;
}

/// Whether all air is used up at a step: a function that takes more than there is was not
/// seen by a tangent, and says nothing of where it ends.
bool uses_up_air(const BuiltModel& built, const Series& x) {
    std::vector<double> values;
    values.reserve(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
        values.push_back(built.unknowns[k].within(x[k]));
    const physics::Building building = building_at(built, values);
    const physics::Drive& drive = built.placed->drive;
    const auto is_used_up = [&](const physics::Input& air_change) {
        for (int step = 0; air_change.is_changed() && step < drive.n_steps(); ++step)
            if (drive.at(air_change, step) < 0) return true;
        return false;
    };
    return std::ranges::any_of(building.zones, [&](const physics::Zone& zone) {
        return is_used_up(zone.venting.air_change) ||
               std::ranges::any_of(zone.flows, is_used_up, &physics::AirFlow::air_change);
    });
}

/// Simulates the model at x, without derivatives. Whether it can be, in training.
bool simulate_at(const LoopData& data, const Series& x, Standing& standing) {
    study::Linearised at{x};
    study::predict_at(*standing.built.fit_model, standing.built.unknowns, at);
    if (std::isnan(at.predicted[0]) || uses_up_air(standing.built, x)) return false;
    standing.fit.at = std::move(at);
    standing.residuals =
        study::residuals_of(data.targets.measured, standing.fit.at.predicted);
    return true;
}

/// A model that is simulated, and where.
struct Joined {
    Standing standing;
    Place place;
};

/// The model with functions, its parameters moved from x; by less, or not at all, where
/// the whole way leads to what cannot be simulated. Nothing where no step does.
std::optional<Joined> joined(const LoopData& data,
                             const effects::FunctionDrivers& drivers, const Place& place,
                             const Standing& without, const Series& x,
                             const Series& moves,
                             const std::vector<FoundFunction>& found) {
    Joined with{without, with_functions(place, found, drivers)};
    try {
        with.standing.built = build(with.place, without.model.effects);
    } catch (const CannotSimulate&) {
        return std::nullopt;
    }
    const auto& unknowns = with.standing.built.unknowns;
    for (const double step : {1.0, 0.5, 0.25, 0.0}) {
        Series at(x.size());
        for (std::size_t k = 0; k < at.size(); ++k)
            at[k] = std::clamp(x[k] + step * moves[k], unknowns[k].lowest(),
                               unknowns[k].highest());
        if (simulate_at(data, at, with.standing)) return with;
    }
    return std::nullopt;
}

/// A stage of the path as a model that is simulated, with residuals of blocks that it had
/// not seen.
struct Simulated {
    std::vector<FoundFunction> functions;
    Standing standing;  ///< its left_out and score are of the halves
    Place place;        ///< with the functions
};

/// Simulates stages of a search.
class StageSimulator {
  public:
    /// \param place  without functions
    StageSimulator(const LoopData& data, const effects::FunctionDrivers& drivers,
                   const Place& place, const Standing& without, const Standing& from,
                   const Remainder& remainder)
        : data_(data),
          drivers_(drivers),
          place_(place),
          without_(without),
          remainder_(remainder),
          x_(from.fit.at.x) {}

    /// nothing where it cannot be simulated.
    std::optional<Simulated> simulated(const functions::Stage& stage) const {
        std::vector<FoundFunction> found = remainder_.found_by(stage.all);
        if (found.empty()) return std::nullopt;
        Series left_out(data_.targets.size(), 0.0);
        for (std::size_t half = 0; half < 2; ++half) {
            const auto one =
                model_of(stage.halves[half], remainder_.found_by(stage.halves[half]));
            if (!one) return std::nullopt;
            for (std::size_t k = 0; k < left_out.size(); ++k)
                if (static_cast<std::size_t>(data_.blocks[k]) % 2 == half)
                    left_out[k] = one->standing.residuals[k];
        }
        auto all = model_of(stage.all, found);
        if (!all) return std::nullopt;
        Standing& standing = all->standing;
        standing.left_out = std::move(left_out);
        standing.score = score_of_halves(data_, standing);
        return Simulated{std::move(found), std::move(standing), std::move(all->place)};
    }

    std::optional<Joined> model_of(const functions::JointFit& fit,
                                   const std::vector<FoundFunction>& found) const {
        return joined(data_, drivers_, place_, without_, x_, remainder_.moves_of(fit),
                      found);
    }

    const LoopData& data_;
    const effects::FunctionDrivers& drivers_;
    const Place& place_;
    const Standing& without_;
    const Remainder& remainder_;
    const Series& x_;  ///< where the parameters move from
};

}  // namespace

bool spares_meters(const LoopData& data, const Standing& without, const Standing& with) {
    const Series before = mean_squares(data.targets, without.left_out),
                 after = mean_squares(data.targets, with.left_out);
    const Series seen = mean_squares(data.targets, with.residuals);
    Series rises;
    for (std::size_t c = 0; c < before.size(); ++c)
        rises.push_back((std::sqrt(std::max(after[c], seen[c]) / before[c]) - 1) *
                        without.noise[c].share);
    const double in_exchange = -decisions::share_in_exchange * std::ranges::min(rises);
    return std::ranges::max(rises) <=
           std::max(decisions::most_rise_by_functions, in_exchange);
}

namespace {

/// The stage that foretells unseen blocks best, of a search about the best so far, if any
/// is better than that and spares all meters. Derivatives of the best so far are found.
std::optional<Simulated> better_stage(const LoopData& data,
                                      const effects::FunctionDrivers& drivers,
                                      const Place& place, const Standing& without,
                                      std::optional<double> day, Simulated& so_far) {
    Standing& from = so_far.standing;
    if (!so_far.functions.empty()) refit(data, from, only_derivatives);
    const Remainder remainder(data, so_far.place, from, drivers, so_far.functions,
                              without.noise, day);
    const functions::Path path = remainder.search();
    const StageSimulator simulator(data, drivers, place, without, from, remainder);
    std::optional<Simulated> best;
    double least = so_far.standing.score;
    // What was there is estimated again, and may do without more.
    const std::size_t first = so_far.functions.empty() ? 1 : 0;
    for (std::size_t k = first; k < path.stages.size(); ++k) {
        auto one = simulator.simulated(path.stages[k]);
        if (!one || one->standing.score >= least ||
            !spares_meters(data, without, one->standing))
            continue;
        least = one->standing.score;
        best = std::move(one);
    }
    return best;
}

/// Parameters were moved by linear steps, which foretell a simulation only so far. They
/// are calibrated with the functions as they are, and stay there if unseen blocks are
/// foretold better and no meter worse.
void calibrate_with_functions(const LoopData& data, const Standing& without,
                              Standing& standing) {
    refit(data, standing, only_derivatives);
    Standing tried = standing;
    refit(data, tried, to_settle);
    if (tried.fit.failed) return;
    score_unseen(data, tried);
    if (tried.score < standing.score && spares_meters(data, without, tried))
        standing = std::move(tried);
}

}  // namespace

std::vector<FoundFunction> find_functions(const LoopData& data, Place& place,
                                          Standing& standing) {
    const effects::FunctionDrivers drivers =
        effects::function_drivers(surroundings_of(place));
    score_unseen(data, standing);
    const Standing& without = standing;
    const auto day = day_of_change(data, without, drivers, place);
    Simulated best{{}, without, place};
    for (int round = 0; round < decisions::function_rounds; ++round) {
        auto better = better_stage(data, drivers, place, without, day, best);
        if (!better) break;
        best = std::move(*better);
    }
    if (best.functions.empty()) return {};
    calibrate_with_functions(data, without, best.standing);
    standing = std::move(best.standing);
    place = std::move(best.place);
    return std::move(best.functions);
}

double score_of_halves(const LoopData& data, const Standing& whole) {
    return std::max(deviance(data.targets, whole.noise, whole.left_out),
                    deviance(data.targets, whole.noise, whole.residuals));
}

Place with_functions(Place place, const std::vector<FoundFunction>& found,
                     const effects::FunctionDrivers& drivers) {
    place.surroundings = std::make_shared<effects::Surroundings>(*place.surroundings);
    place.functions.clear();
    for (const FunctionsAtHook& one : by_hook(found)) {
        place.functions.push_back(effect_of(one.at));
        place.surroundings->columns[column_of(one.at)] =
            effects::column_of(one.at.hook, one.functions, drivers);
    }
    return place;
}

void add_functions(Place& place, const std::vector<FoundFunction>& found) {
    if (found.empty()) return;
    const auto drivers = effects::function_drivers(surroundings_of(place));
    place = with_functions(std::move(place), found, drivers);
}

}  // namespace bemcal::loop
