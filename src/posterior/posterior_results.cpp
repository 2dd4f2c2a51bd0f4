/// Writes what a posterior predicts: for every building, period and meter the series
/// before and after, with quantiles, and their validation.
/// Source: ArviZ's groups for the training period.
/// Errors that last and levels that wander are drawn for other periods where the job
/// asks. Of the n_predictive draws 64 are stored at most.
#include "posterior/posterior_results.hpp"

#include "physics/calendar.hpp"
#include "posterior/lasting_errors.hpp"
#include "posterior/own_bias.hpp"
#include "posterior/predictive.hpp"
#include "posterior/validation_results.hpp"
#include "study/bias.hpp"
#include "study/points.hpp"
#include "study/some_draws.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

constexpr std::uint32_t predictive_stream = 0x70726564;
/// Draws of readings that are stored whole; the others go into intervals.
constexpr std::size_t n_stored_draws = 64;

/// \param take  (position, own): the position of the building's unknowns in their space
template <class Take>
BuildingModel::Points draws_of_building(const PosteriorParts& parts,
                                        const ChainDraws& draws,
                                        const std::vector<std::size_t>& rows,
                                        const Take& take) {
    BuildingModel::Points points = parts.make_points(rows.size());
    std::vector<double> own(parts.space->n_free());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        take(draws.positions.row(rows[k]), own);
        parts.write_point(own, k, points);
    }
    return points;
}

std::vector<double> seconds_of(const std::vector<physics::Seconds>& begins) {
    std::vector<double> seconds;
    seconds.reserve(begins.size());
    for (const auto begin : begins)
        seconds.push_back(static_cast<double>(begin.time_since_epoch().count()));
    return seconds;
}

void add_series(const MeterPrediction& meter, const std::string& folder,
                study::DatasetBuilder& datasets) {
    const auto add = [&](const char* leaf, std::vector<double> values) {
        const std::size_t n = values.size();
        datasets.array(folder + leaf, {"time"}, {n}, std::move(values), meter.unit);
    };
    datasets.times(folder + "time", meter.begins);
    add("measured", meter.measured);
    add("nominal", meter.nominal);
    add("predicted_mean", meter.mean);
    if (meter.draws.rows == 0) return;
    add("predicted_q05", study::column_quantiles(meter.draws, 0.05));
    add("predicted_q95", study::column_quantiles(meter.draws, 0.95));
}

/// ArviZ's groups, of the training period.
void add_inference_data(const MeterPrediction& meter, study::DatasetBuilder& datasets) {
    const std::string time = "time_" + meter.name;
    const std::size_t n = meter.measured.size();
    const std::size_t n_draws = std::min(n_stored_draws, meter.draws.rows);
    for (const char* group : {"observed_data/", "posterior_predictive/"})
        datasets.vector(group + time, time, seconds_of(meter.begins));
    datasets.array("observed_data/" + meter.name, {time}, {n}, meter.measured,
                   meter.unit);
    std::vector<double> stored;
    stored.reserve(n_draws * n);
    for (const std::size_t row :
         study::chosen_rows(meter.draws.rows, static_cast<int>(n_draws))) {
        const auto draw = meter.draws.row(row);
        stored.insert(stored.end(), draw.begin(), draw.end());
    }
    datasets.array("posterior_predictive/" + meter.name, {"chain", "draw", time},
                   {1, n_draws, n}, std::move(stored), meter.unit);
}

/// From the middle of one to the middle of the other.
double years_between(const study::Period& a, const study::Period& b) {
    constexpr double seconds_of_two_years = 2 * 365.25 * physics::day_s;
    const auto distance = (a.from - b.from) + (a.to - b.to);
    return std::abs(static_cast<double>(distance.count())) / seconds_of_two_years;
}

study::HoldOut hold_out_of(const PosteriorOptions& options) {
    return {options.hold_out_weeks, options.hold_out_hours, options.chains.seed};
}

/// The same meters as in training, with the same scale, held against another period.
MeterChoice choice_like(const BuildingModel& trained) {
    MeterChoice choice;
    auto& residuals = choice.residuals;
    residuals.autocorrelated = residuals.discrepancy = residuals.proportional = false;
    for (const MeterModel& meter : trained.meters()) {
        const auto& of_meter = meter.residuals.options();
        choice.names.push_back(meter.name);
        residuals.autocorrelated |= of_meter.autocorrelated;
        residuals.discrepancy |= of_meter.discrepancy;
        residuals.proportional |= of_meter.proportional;
        choice.scales.push_back(meter.scale);
    }
    return choice;
}

/// Each period and meter of a case, without errors.
std::vector<study::FoundFit> no_fits(const study::Case& building) {
    std::vector<study::FoundFit> fits;
    for (std::size_t p = 0; p < building.periods.size(); ++p)
        for (std::size_t m = 0; m < building.meters.size(); ++m) fits.push_back({p, m});
    return fits;
}

/// Of the readings that train; where none do, of all.
void set_errors(const std::vector<study::PartValidation>& parts, study::FoundFit& fit) {
    for (const char* name : {"training", "all"}) {
        const auto part = std::ranges::find(parts, name, &study::PartValidation::part);
        if (part == parts.end()) continue;
        const auto& own = part->validation.own;
        fit.before = own.before.cv_rmse;
        fit.cv_rmse = own.after.cv_rmse;
        fit.nmbe = own.after.nmbe;
        return;
    }
}

/// Of that name, which is there.
template <class Named>
std::size_t place_of(const std::vector<Named>& all, const std::string& name) {
    const auto found =
        std::ranges::find_if(all, [&](const Named& one) { return one.name == name; });
    return static_cast<std::size_t>(found - all.begin());
}

class Predictions {
  public:
    Predictions(const CalibratedBuildings& of, const ChainDraws& draws,
                study::DatasetBuilder& datasets)
        : of_(of),
          draws_(draws),
          datasets_(datasets),
          rows_(study::chosen_rows(draws.positions.rows, of.options.n_predictive)) {
        if (is_alone()) fits_ = no_fits(of.parts.buildings[0]->building());
    }

    PredictedFits add_all() {
        for (std::size_t b = 0; b < of_.parts.buildings.size(); ++b) add_seen(b);
        for (const study::Case& building : of_.unseen) add_unseen(building);
        return {std::move(fits_), study::joined_sentences(biases_)};
    }

  private:
    bool is_alone() const { return of_.options.pooling == Pooling::none; }
    std::string folder_of(const study::Case& building) const {
        return is_alone() ? std::string() : building.name + "/";
    }

    void add_seen(std::size_t b) {
        const BuildingModel& model = *of_.parts.buildings[b];
        const study::Case& building = model.building();
        const BuildingModel::Points of_building = draws_of_building(
            of_.parts, draws_, rows_, [&](auto position, std::span<double> own) {
                of_.parts.arrangement->take(position, b, own);
            });
        const study::Period& training = training_period(building, of_.options);
        const std::vector<double> shares = shares_that_last(model, of_building);
        for (const study::Period& period : building.periods) {
            if (&period == &training || period.name == training.name)
                add_period(model, of_building, period);
            else
                add_other_period(model, of_building, shares, period);
        }
    }

    /// Empty where no errors beyond the likelihood's are asked for.
    std::vector<double> shares_that_last(const BuildingModel& trained,
                                         const BuildingModel::Points& of_building) const {
        const double weeks = of_.options.lasting_weeks;
        if (weeks <= 0 || trained.building().periods.size() < 2 ||
            choice_like(trained).residuals.discrepancy)
            return {};
        return lasting_shares(trained, of_building, weeks);
    }

    void add_other_period(const BuildingModel& trained,
                          const BuildingModel::Points& of_building,
                          const std::vector<double>& shares,
                          const study::Period& period) {
        MeterChoice choice = choice_like(trained);
        choice.residuals.discrepancy |= !shares.empty();
        const BuildingModel model = trained.over(period, choice);
        if (shares.empty()) return add_period(model, of_building, period);
        add_period(model,
                   with_lasting_errors(trained, of_building, model, shares,
                                       of_.options.lasting_weeks),
                   period);
    }

    void add_unseen(const study::Case& building) {
        Stream random(of_.options.chains.seed, predictive_stream, ++n_streams_);
        const BuildingModel::Points of_building = draws_of_building(
            of_.parts, draws_, rows_, [&](auto position, std::span<double> own) {
                of_.parts.arrangement->take_unseen(position, random, own);
            });
        for (const study::Period& period : building.periods) {
            MeterChoice choice = choice_like(*of_.parts.buildings[0]);
            choice.scales.clear();
            choice.scales = nominal_scales(BuildingModel(building, period, choice));
            add_period(BuildingModel(building, period, choice), of_building, period);
        }
    }

    void add_period(const BuildingModel& model, const BuildingModel::Points& of_building,
                    const study::Period& period) {
        Stream random(of_.options.chains.seed, predictive_stream, ++n_streams_);
        const std::string folder = folder_of(model.building()) + period.name + "/";
        std::vector<study::FoundFit> trained;
        for (const MeterPrediction& meter :
             predict_meters(model, of_building, level_change_in(model, period), random)) {
            add_series(meter, folder + meter.name + "/", datasets_);
            const auto parts = add_validation(meter, roles_of(model, meter, period),
                                              folder + meter.name + "/", datasets_);
            if (is_alone()) set_errors(parts, fit_of(model.building(), period, meter));
            if (trains(model, period))
                trained.push_back(trained_fit(model.building(), period, meter, parts));
            if (is_alone() && period.name == model.building().periods[0].name)
                add_inference_data(meter, datasets_);
        }
        note_bias(model.building(), period, trained);
    }

    /// A meter in training; without a bias where its own intervals tell of it.
    static study::FoundFit trained_fit(const study::Case& building,
                                       const study::Period& period,
                                       const MeterPrediction& meter,
                                       const std::vector<study::PartValidation>& parts) {
        study::FoundFit fit{place_of(building.periods, period.name),
                            place_of(building.meters, meter.name)};
        set_errors(parts, fit);
        if (draws_tell_bias(meter, fit.nmbe)) fit.nmbe = 0;
        return fit;
    }

    void note_bias(const study::Case& building, const study::Period& period,
                   const std::vector<study::FoundFit>& trained) {
        const std::string bias = study::bias_beyond(
            building, place_of(building.periods, period.name), trained);
        if (!bias.empty())
            biases_.push_back(is_alone() ? bias : building.name + ": " + bias);
    }

    study::FoundFit& fit_of(const study::Case& building, const study::Period& period,
                            const MeterPrediction& meter) {
        const auto fit = std::ranges::find_if(fits_, [&](const study::FoundFit& each) {
            return building.periods[each.period].name == period.name &&
                   building.meters[each.meter].name == meter.name;
        });
        return *fit;
    }

    bool is_seen(const BuildingModel& model) const {
        return std::ranges::find(of_.options.unseen, model.building().name) ==
               of_.options.unseen.end();
    }
    bool trains(const BuildingModel& model, const study::Period& period) const {
        return is_seen(model) &&
               period.name == training_period(model.building(), of_.options).name;
    }

    /// The parameters hold the level of the training period; from there it wanders.
    double level_change_in(const BuildingModel& model,
                           const study::Period& period) const {
        if (!is_seen(model) || trains(model, period)) return 0;
        return of_.options.level_change *
               std::sqrt(
                   years_between(training_period(model.building(), of_.options), period));
    }

    /// Empty where nothing of the period trains, or all of it does.
    std::vector<study::Role> roles_of(const BuildingModel& model,
                                      const MeterPrediction& meter,
                                      const study::Period& period) const {
        const study::HoldOut hold_out = hold_out_of(of_.options);
        if (!trains(model, period) || !(hold_out.weeks > 0 || hold_out.hours > 0))
            return {};
        std::size_t index = 0;
        for (const MeterModel& each : model.meters())
            if (each.name == meter.name) index = each.meter;
        return study::draw_roles(meter.begins, index, hold_out);
    }

    const CalibratedBuildings& of_;
    const ChainDraws& draws_;
    study::DatasetBuilder& datasets_;
    std::vector<std::size_t> rows_;
    std::vector<study::FoundFit> fits_;  ///< of a building that is alone
    std::vector<std::string> biases_;    ///< in training, beyond Guideline 14
    std::uint64_t n_streams_ = 0;
};

}  // namespace

const study::Period& training_period(const study::Case& building,
                                     const PosteriorOptions& options) {
    return study::period_of(building, options.period);
}

std::vector<double> nominal_scales(const BuildingModel& model) {
    std::vector<double> scales;
    const auto nominal = model.predict(study::nominal_row(model.building().parameters));
    for (std::size_t m = 0; m < nominal.size(); ++m) {
        const study::Meter& meter = model.building().meters[model.meters()[m].meter];
        scales.push_back(study::noise_scale(meter.quantity, nominal[m].values));
    }
    return scales;
}

MeterChoice training_choice(const study::Case& building, const study::Period& period,
                            const PosteriorOptions& options) {
    MeterChoice choice{options.meters, options.residuals, {}, {}};
    const study::HoldOut hold_out = hold_out_of(options);
    if (hold_out.weeks <= 0 && hold_out.hours <= 0) return choice;
    const auto axis = study::axis_of(building, period);
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        const auto begins = study::begins_of(axis, building.meters[m].interval);
        choice.trains.emplace_back();
        for (const study::Role role : study::draw_roles(begins, m, hold_out))
            choice.trains.back().push_back(role == study::Role::training);
    }
    return choice;
}

PredictedFits add_predictions(const CalibratedBuildings& buildings,
                              const ChainDraws& draws, study::DatasetBuilder& datasets) {
    return Predictions(buildings, draws, datasets).add_all();
}

}  // namespace bemcal::posterior
