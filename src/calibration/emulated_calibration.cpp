/// Rounds of runs, then a calibration on the emulator of all of them:
///
///     design        the nominal point, then Sobol points of the parameters' ranges
///     calibration   points about the optimum of an emulator of the runs, three times
///     (the calibration's own rounds, on the emulator of all runs)
///     best point    a run where the calibration ended
///
/// Sources: emulator/series_emulator and series_fit; rounds as of the loop around a
/// program. The run at the end says what the emulator's best point is worth; nothing is
/// done about it. A run that fails is told and left out.
#include "calibration/emulated_calibration.hpp"

#include "base/nan.hpp"
#include "calibration/emulated_period.hpp"
#include "emulator/series_fit.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/datasets.hpp"
#include "study/packed_matrix.hpp"
#include "study/points.hpp"
#include "study/runs_budget.hpp"
#include "study/simulated_hours.hpp"
#include "study/simulator_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::calibration {
namespace {

using EmulatorPointer = std::shared_ptr<const emulator::SeriesEmulator>;

/// A model's errors last: where the next runs pay, a week's readings count as one.
constexpr double independent_hours = 168;
/// A first emulator is not trusted at the ends of the ranges, where it has few runs.
constexpr emulator::ScaledPrior of_parameter{0.5, 1};

/// Runs that did not fail.
struct GoodRuns {
    Matrix points;  ///< [runs x parameters] on the scale 0 to 1
    Matrix series;  ///< [runs x readings of all periods]
};

/// What a round after the emulator has been made is of.
enum class Part { calibration, best_run };

std::vector<std::size_t> all_of(const std::vector<study::Meter>& meters) {
    std::vector<std::size_t> places(meters.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    return places;
}

class EmulatedCalibration : public study::Stage {
  public:
    EmulatedCalibration(std::string name, const study::Case& building,
                        std::shared_ptr<const study::HourlySimulator> simulator,
                        const EmulatedOptions& options, CalibrationOf calibration)
        : name_(std::move(name)),
          building_(case_of_simulator(building, *simulator)),
          simulator_(std::move(simulator)),
          options_(options),
          calibration_(std::move(calibration)),
          budget_(options.n_runs),
          layout_(building_, all_of(building_.meters)) {
        for (const study::Meter& meter : building_.meters)
            columns_.push_back(study::column_of(*simulator_, meter.name));
        const std::size_t n = building_.parameters.size(),
                          least = emulator::least_runs(n);
        if (static_cast<std::size_t>(budget_.design()) < least)
            throw std::invalid_argument(fmt::format(
                "runs = {} has a design of {} runs for {} parameters; expected runs = {} "
                "or more",
                options.n_runs, budget_.design(), n, 2 * least));
        // Before there are runs: how many items it has, and whether what it names is
        // there.
        n_inner_items_ = calibration_on({})->n_items();
    }

    std::string name() const override { return name_; }
    int n_items() const override { return budget_.design(); }
    long long n_simulations() const override { return budget_.all() + 1; }
    const char* counts() const override { return "runs"; }
    bool has_rounds() const override { return true; }
    const char* items_are() const override {
        return inner_ ? inner_->items_are() : "runs";
    }
    std::size_t answer_bytes() const override {
        return sizeof(double) * study::hours_of_periods(building_) * columns_.size();
    }
    bool failures_may_pass() const override { return true; }
    study::Activity activity() const override {
        return inner_ ? inner_->activity() : study::Activity{};
    }
    void see(const std::vector<study::Summary>& found) override { found_ = found; }

    study::ItemAnswer run(int item) const override {
        if (best_item_ > 0 && item == best_item_) return simulate(best_);
        if (item >= budget_.all()) return inner_->run(item - budget_.all());
        if (next_.rows == 0) return simulate(design_point(item));
        const auto point = next_.row(static_cast<std::size_t>(item - first_item_));
        return simulate({point.begin(), point.end()});
    }

    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        if (best_item_ > 0) return std::nullopt;
        if (inner_) return next_of_calibration(of_inner(answers));
        const GoodRuns good = good_runs(answers);
        if (good.points.rows < emulator::least_runs(good.points.cols))
            return std::nullopt;
        study::Round round;
        if (answers.size() < n_runs()) {
            round.n_items = budget_.of_round();
            study::pack(next_points(good), round.needed);
        } else {
            round.n_items = n_inner_items_;
            study::pack(good.points, round.needed);
            study::pack(good.series, round.needed);
        }
        return round;
    }

    void begin_round(int first_item, const study::Round& round) override {
        if (inner_) return begin_round_of_calibration(first_item, round);
        std::span<const double> packed = round.needed;
        first_item_ = first_item;
        next_ = study::take_matrix(packed);
        if (packed.empty()) return;
        emulator_ = emulator_of({next_, study::take_matrix(packed)});
        inner_ = calibration_on(emulator_);
        inner_->see(found_);
    }

    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        study::Conclusion conclusion;
        if (inner_) conclusion = inner_->conclude(of_inner(answers));
        study::DatasetBuilder more(name_);
        if (!inner_) more.kind(options_.kind);
        add_runs(answers, more);
        if (inner_) add_errors(more);
        std::ranges::move(more.take(), std::back_inserter(conclusion.datasets));
        return conclusion;
    }
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        if (inner_) return inner_->shortfall(of_inner(answers));
        return "too few runs of the simulator succeeded for a calibration";
    }

  private:
    std::size_t n_runs() const { return static_cast<std::size_t>(budget_.all()); }

    std::vector<double> design_point(int item) const {
        if (item == 0) return study::nominal_on_scale(building_.parameters);
        return stats::scrambled_sobol_points(
                   static_cast<std::size_t>(item), 1,
                   static_cast<int>(building_.parameters.size()), options_.seed)
            .values;
    }
    /// \param point  on the scale 0 to 1
    study::ItemAnswer simulate(std::vector<double> point) const {
        const std::vector<double> values = study::values_at(point, building_.parameters);
        return study::simulate(*simulator_,
                               {std::move(point),
                                {},
                                study::AskedPeriods(building_.periods.size(), 1),
                                {},
                                {},
                                {}},
                               values, {}, columns_, building_.periods);
    }
    study::SimulatorRun run_in(const study::ItemAnswer& answer) const {
        return study::run_in(answer, building_.parameters.size());
    }

    GoodRuns good_runs(const std::vector<study::ItemAnswer>& answers) const {
        GoodRuns good{{0, building_.parameters.size()}, {0, layout_.size()}};
        for (std::size_t k = 0; k < std::min(answers.size(), n_runs()); ++k) {
            const study::SimulatorRun run = run_in(answers[k]);
            if (!run.failure.empty()) continue;
            good.points.add_row(run.point);
            good.series.add_row(layout_.series(building_, run.hours));
        }
        return good;
    }
    EmulatorPointer emulator_of(const GoodRuns& good) const {
        return std::make_shared<const emulator::SeriesEmulator>(
            good.points, good.series, layout_.weights(building_), study::share_emulated);
    }
    std::unique_ptr<study::Stage> calibration_on(EmulatorPointer emulator) const {
        return calibration_(
            building_, [&](const study::Case& building, const study::Period& period) {
                return emulated_period_model(building, period, layout_, emulator);
            });
    }

    bool is_calibrated_on(const study::Period& period) const {
        return std::ranges::find(options_.periods, period.name) != options_.periods.end();
    }
    /// Of the periods that are calibrated on; others are missing. [layout]
    std::vector<double> measured() const {
        std::vector<double> series;
        for (const study::Period& period : building_.periods)
            for (const kernel::Readings& readings : study::readings_of(building_, period))
                for (const double value : readings.values)
                    series.push_back(is_calibrated_on(period) ? value : nan);
        return series;
    }
    /// 1 / standard deviation of a reading's error, as if errors lasted. [layout]
    std::vector<double> weights_of_fit() const {
        std::vector<double> weights = layout_.weights(building_);
        const double n =
            static_cast<double>(study::hours_of_periods(building_)) / independent_hours;
        for (double& weight : weights) weight *= std::sqrt(std::max(n, 1.0));
        return weights;
    }
    Matrix next_points(const GoodRuns& good) const {
        const std::vector<emulator::ScaledPrior> priors(good.points.cols, of_parameter);
        const auto fit = emulator::fit_series(*emulator_of(good), measured(),
                                              weights_of_fit(), priors);
        return emulator::next_points(fit, static_cast<std::size_t>(budget_.of_round()));
    }

    /// The calibration's own, then the run at its best point.
    std::optional<study::Round> next_of_calibration(
        const std::vector<study::ItemAnswer>& answers) const {
        Part part = Part::calibration;
        auto round = inner_->next_round(answers);
        if (!round) {
            part = Part::best_run;
            round = study::Round{1, on_scale(inner_->best_point(answers))};
            if (round->needed.empty()) return std::nullopt;
        }
        round->needed.insert(round->needed.begin(), static_cast<double>(part));
        return round;
    }
    void begin_round_of_calibration(int first_item, study::Round round) {
        const bool is_best_run =
            round.needed.at(0) == static_cast<double>(Part::best_run);
        round.needed.erase(round.needed.begin());
        if (!is_best_run) return inner_->begin_round(first_item - budget_.all(), round);
        best_item_ = first_item;
        best_ = std::move(round.needed);
    }
    std::vector<double> on_scale(std::vector<double> point) const {
        for (std::size_t k = 0; k < point.size(); ++k)
            point[k] = study::on_scale(point[k], building_.parameters[k]);
        return point;
    }
    std::vector<study::ItemAnswer> of_inner(
        const std::vector<study::ItemAnswer>& answers) const {
        return {answers.begin() + budget_.all(),
                best_item_ > 0 ? answers.begin() + best_item_ : answers.end()};
    }

    void add_runs(const std::vector<study::ItemAnswer>& answers,
                  study::DatasetBuilder& datasets) const;
    void add_best_run(const study::SimulatorRun& run,
                      study::DatasetBuilder& datasets) const;
    void add_errors(study::DatasetBuilder& datasets) const;

    std::string name_;
    study::Case building_;
    std::shared_ptr<const study::HourlySimulator> simulator_;
    EmulatedOptions options_;
    CalibrationOf calibration_;
    study::RunsBudget budget_;
    study::SeriesLayout layout_;
    std::vector<std::size_t> columns_;   ///< [meters] of the simulator's
    std::vector<study::Summary> found_;  ///< rank 0's, of studies above
    int n_inner_items_ = 0;              ///< of the calibration's first round
    Matrix next_;                        ///< of this round; empty = the design
    int first_item_ = 0;
    // Once the runs are there.
    EmulatorPointer emulator_;
    std::unique_ptr<study::Stage> inner_;
    // Once the calibration has ended.
    int best_item_ = 0;         ///< the run there; 0 = not yet
    std::vector<double> best_;  ///< on the scale 0 to 1
};

void EmulatedCalibration::add_runs(const std::vector<study::ItemAnswer>& answers,
                                   study::DatasetBuilder& datasets) const {
    study::MadeRuns made;
    const auto add = [&](const study::SimulatorRun& run, const char* of) {
        made.of.emplace_back(of);
        made.failures.push_back(run.failure);
        const auto values = study::values_at(run.point, building_.parameters);
        made.values.insert(made.values.end(), values.begin(), values.end());
    };
    const auto design = static_cast<std::size_t>(budget_.design());
    for (std::size_t k = 0; k < std::min(answers.size(), n_runs()); ++k)
        add(run_in(answers[k]), k < design ? "design" : "calibration");
    if (const auto best = static_cast<std::size_t>(best_item_);
        best > 0 && best < answers.size()) {
        const study::SimulatorRun run = run_in(answers[best]);
        add(run, "best point");
        if (run.failure.empty()) add_best_run(run, datasets);
    }
    study::add_made_runs(building_.parameters, std::move(made), datasets);
}

/// How far the program is from the readings there, beside the emulator.
void EmulatedCalibration::add_best_run(const study::SimulatorRun& run,
                                       study::DatasetBuilder& datasets) const {
    std::vector<std::string> names;
    std::vector<double> values, foretold;
    const std::vector<double> point = study::values_at(best_, building_.parameters);
    for (const study::Period& period : building_.periods) {
        const auto model = emulated_period_model(building_, period, layout_, emulator_);
        const study::CloseLook look = model->look(building_, period, point, {});
        const auto& readings = model->readings();
        for (std::size_t m = 0; m < readings.size(); ++m) {
            if (!study::has_reading(readings[m].values)) continue;
            const study::MeterSeries own = study::compared(
                study::readings_of_hours(building_, period,
                                         {readings[m].quantity, readings[m].interval},
                                         run.hours[m]),
                study::axis_of(building_, period), readings[m]);
            names.push_back(
                fmt::format("{} in {}, {}", building_.meters[m].name, period.name,
                            is_calibrated_on(period) ? "calibrated on" : "not seen"));
            values.push_back(100 * stats::relative_error(own.fit.own));
            foretold.push_back(100 * stats::relative_error(look.meters[m].fit.own));
        }
    }
    std::vector<std::string> units(names.size(), "% CV(RMSE)");
    datasets.texts("best_run_output", "best_run_output", std::move(names));
    datasets.texts("best_run_unit", "best_run_output", std::move(units));
    datasets.vector("best_run_value", "best_run_output", std::move(values));
    datasets.vector("best_run_foretold", "best_run_output", std::move(foretold));
}

/// How well the emulator foretells runs that it has not seen, in the periods that are
/// calibrated on.
void EmulatedCalibration::add_errors(study::DatasetBuilder& datasets) const {
    std::vector<std::string> names;
    std::vector<emulator::ChannelRange> ranges;
    for (const study::Period& period : building_.periods) {
        if (!is_calibrated_on(period)) continue;
        for (std::size_t m = 0; m < building_.meters.size(); ++m) {
            names.push_back(building_.meters[m].name + " in " + period.name);
            ranges.push_back(layout_.ranges(building_, period)[m]);
        }
    }
    datasets.texts("simulator_channel", "simulator_channel", std::move(names));
    datasets.vector("simulator_emulator_error", "simulator_channel",
                    emulator_->leave_one_out(ranges));
}

}  // namespace

study::Case case_of_simulator(const study::Case& building,
                              const study::HourlySimulator& simulator) {
    study::Case made = building;
    made.parameters = simulator.parameters();
    made.priors.clear();
    std::erase_if(made.meters, [&](const study::Meter& meter) {
        return std::ranges::find(simulator.meters(), meter.name) ==
               simulator.meters().end();
    });
    return made;
}

std::unique_ptr<study::Stage> make_emulated_calibration(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator,
    const EmulatedOptions& options, CalibrationOf calibration) {
    return std::make_unique<EmulatedCalibration>(
        std::move(name), building, std::move(simulator), options, std::move(calibration));
}

}  // namespace bemcal::calibration
