/// Runs another program before and after every scenario, an item for each run: its model
/// as described, then the points that a study above has found.
/// Follows from paper 3, with the program's own runs in place of a model's.
/// The description has no effects, so a change of one is none there. An emulator is left
/// out: what a measure saves may lie outside the ranges that it was learned in.
#include "retrofit/simulator_retrofit.hpp"

#include "base/nan.hpp"
#include "retrofit/savings.hpp"
#include "study/failures.hpp"
#include "study/packed_conclusion.hpp"
#include "study/points.hpp"
#include "study/simulated_hours.hpp"
#include "study/simulator_run.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace bemcal::retrofit {
namespace {

/// Which hours of a period count. [hours]
std::vector<char> occupied_hours(const study::Case& building, const study::Period& period,
                                 int profile) {
    const auto n = static_cast<std::size_t>(study::hours_of(period));
    if (profile < 0) return std::vector<char>(n, 1);
    const physics::Drive drive = study::drive_of(building, period);
    std::vector<char> are(n);
    for (std::size_t hour = 0; hour < n; ++hour) {
        const auto step = static_cast<int>(hour) * 3600 / drive.axis.step_s;
        are[hour] = drive.profile_at(profile, drive.n_warm_up + step) >= occupied_from;
    }
    return are;
}

class SimulatorRetrofit : public study::Stage {
  public:
    SimulatorRetrofit(std::string name, const study::Case& building,
                      std::shared_ptr<const study::HourlySimulator> simulator,
                      const study::Period& period,
                      const SimulatorRetrofitOptions& options)
        : name_(std::move(name)),
          building_(building),
          simulator_(std::move(simulator)),
          period_(period),
          options_(options),
          asked_(building.periods.size(), simulator_->takes_periods() ? 0 : 1),
          occupied_(occupied_hours(building, period, options.occupied_profile)) {
        const auto place =
            std::ranges::find(building_.periods, period_.name, &study::Period::name) -
            building_.periods.begin();
        asked_[static_cast<std::size_t>(place)] = 1;
        for (const std::string& name_of_meter : simulator_->meters())
            add_meter(name_of_meter);
        if (!temperatures_.empty())
            for (const char* hours : comfort_outputs) outputs_.push_back({hours, "h"});
        take({});
    }

    std::string name() const override { return name_; }
    int n_items() const override { return static_cast<int>(n_variants()); }
    long long n_simulations() const override {
        return static_cast<long long>(n_variants()) * (1 + options_.n_points);
    }
    const char* counts() const override { return "runs"; }
    bool has_rounds() const override { return true; }
    const char* items_are() const override { return "runs"; }
    std::size_t answer_bytes() const override { return sizeof(double) * n_outputs(); }
    bool failures_may_pass() const override { return true; }

    void see(const std::vector<study::Summary>& found) override {
        const study::Summary* of =
            study::find_summary(found, options_.of, building_.name);
        if (of == nullptr) return;
        found_.points.rows =
            some_of(points_in(of, simulator_->parameters()), options_.n_points);
        found_.given = of->given;
    }
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        const std::size_t n = found_.points.rows.rows;
        if (answers.size() > n_variants() || n == 0) return std::nullopt;
        return study::Round{static_cast<int>(n * n_variants()),
                            study::pack({{}, {found_}})};
    }
    void begin_round(int, const study::Round& round) override {
        take(study::unpack_conclusion(round.needed).summaries.at(0));
    }
    study::ItemAnswer run(int item) const override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        if (answers.size() > n_variants()) return lost_scenarios(savings_of(answers));
        return fmt::format("{} found no points to apply the scenarios to", options_.of);
    }

  private:
    /// Before, and after each scenario.
    std::size_t n_variants() const { return 1 + options_.scenarios.size(); }
    std::size_t n_outputs() const { return outputs_.size(); }
    std::size_t point_of(int item) const {
        return static_cast<std::size_t>(item) / n_variants();
    }
    std::size_t variant_of(int item) const {
        return static_cast<std::size_t>(item) % n_variants();
    }
    /// Energies have an output each; temperatures have those of comfort together.
    void add_meter(const std::string& name_of_meter) {
        const auto meter =
            std::ranges::find(building_.meters, name_of_meter, &study::Meter::name);
        const std::size_t column = study::column_of(*simulator_, name_of_meter);
        if (physics::is_temperature(meter->quantity)) {
            temperatures_.push_back(column);
        } else {
            energies_.push_back(column);
            outputs_.push_back({name_of_meter, physics::unit_of(meter->quantity)});
        }
    }
    void take(const study::Summary& found);

    SimulatorInput before_at(std::size_t point) const {
        const auto values = points_.row(point);
        return {{values.begin(), values.end()},
                point == 0 ? std::vector<study::GivenEffect>{} : given_};
    }
    SimulatorInput input_of(int item) const {
        SimulatorInput before = before_at(point_of(item));
        const std::size_t variant = variant_of(item);
        return variant == 0 ? before
                            : after(std::move(before), options_.scenarios[variant - 1]);
    }
    std::string complaint_of(int item) const;
    std::string reason(int item, const std::string& failure) const {
        const std::size_t variant = variant_of(item);
        return variant == 0 ? failure
                            : options_.scenarios[variant - 1].name + ": " + failure;
    }
    std::vector<double> outputs_of(const study::SimulatedHours& hours) const;
    ComfortHours comfort_of(const study::SimulatedHours& hours) const;
    Savings savings_of(const std::vector<study::ItemAnswer>& answers) const;
    study::MadeRuns made_runs(const std::vector<study::ItemAnswer>& answers) const;

    std::string name_;
    study::Case building_;
    std::shared_ptr<const study::HourlySimulator> simulator_;
    study::Period period_;
    SimulatorRetrofitOptions options_;
    study::AskedPeriods asked_;
    std::vector<char> occupied_;                        ///< [hours of the period]
    std::vector<std::size_t> energies_, temperatures_;  ///< of the program's meters
    std::vector<study::Output> outputs_;
    study::Summary found_;  ///< rank 0's
    Matrix points_;         ///< the description, then those of the round
    std::vector<study::GivenEffect> given_;
};

/// What all ranks know: the description, then what was found.
void SimulatorRetrofit::take(const study::Summary& found) {
    points_ = study::nominal_row(simulator_->parameters());
    for (std::size_t r = 0; r < found.points.rows.rows; ++r)
        points_.add_row(found.points.rows.row(r));
    given_ = found.given;
}

/// What is known to be wrong without a run. The description has no effects, and lacks
/// none.
std::string SimulatorRetrofit::complaint_of(int item) const {
    const std::size_t point = point_of(item), variant = variant_of(item);
    if (variant == 0) return {};
    const SimulatorScenario& scenario = options_.scenarios[variant - 1];
    std::string beyond = beyond_limits(before_at(point), scenario,
                                       simulator_->parameters(), options_.limits);
    return point == 0 || !beyond.empty() ? beyond : missing_effect(scenario, given_);
}

/// Of the mean over all temperatures that the program gives.
ComfortHours SimulatorRetrofit::comfort_of(const study::SimulatedHours& hours) const {
    std::vector<double> mean(occupied_.size(), 0.0);
    for (const std::size_t column : temperatures_) {
        const auto one = study::hours_in(building_, period_, hours.meters[column]);
        for (std::size_t h = 0; h < mean.size(); ++h)
            mean[h] += one[h] / static_cast<double>(temperatures_.size());
    }
    ComfortHours outside;
    for (std::size_t h = 0; h < mean.size(); ++h)
        if (occupied_[h] != 0) count(options_, mean[h], 1, outside);
    return outside;
}

std::vector<double> SimulatorRetrofit::outputs_of(
    const study::SimulatedHours& hours) const {
    std::vector<double> outputs;
    outputs.reserve(n_outputs());
    for (const std::size_t column : energies_) {
        const auto one = study::hours_in(building_, period_, hours.meters[column]);
        outputs.push_back(std::accumulate(one.begin(), one.end(), 0.0));
    }
    if (temperatures_.empty()) return outputs;
    const ComfortHours outside = comfort_of(hours);
    outputs.push_back(outside.too_cold);
    outputs.push_back(outside.too_warm);
    return outputs;
}

study::ItemAnswer SimulatorRetrofit::run(int item) const {
    study::ItemAnswer answer;
    std::string failure = complaint_of(item);
    if (failure.empty()) {
        SimulatorInput input = input_of(item);
        const study::SimulatedHours hours =
            study::hours_of_run(*simulator_, input.values, std::move(input.effects),
                                building_.periods, asked_);
        failure = hours.failure;
        if (failure.empty()) answer.values = outputs_of(hours);
    }
    if (!failure.empty())
        answer.failures.push_back(
            {static_cast<long long>(point_of(item)), reason(item, failure)});
    return answer;
}

Savings SimulatorRetrofit::savings_of(
    const std::vector<study::ItemAnswer>& answers) const {
    Savings savings;
    for (const SimulatorScenario& scenario : options_.scenarios)
        savings.scenarios.push_back(scenario.name);
    savings.outputs = outputs_;
    savings.rows = Matrix(answers.size() / n_variants(), n_variants() * n_outputs(), nan);
    for (std::size_t k = 0; k < answers.size(); ++k)
        std::ranges::copy(
            answers[k].values,
            savings.rows.values.begin() + static_cast<std::ptrdiff_t>(k * n_outputs()));
    savings.parameters = simulator_->parameters();
    if (answers.size() > n_variants()) savings.points = found_.points.rows;
    savings.period = study::axis_of(building_, period_);
    add_accounts(
        building_.meters, [](const study::Meter& meter) { return meter.name; }, savings);
    return savings;
}

study::MadeRuns SimulatorRetrofit::made_runs(
    const std::vector<study::ItemAnswer>& answers) const {
    study::MadeRuns made;
    for (std::size_t k = 0; k < answers.size(); ++k) {
        const auto item = static_cast<int>(k);
        made.of.emplace_back(point_of(item) == 0     ? "as described"
                             : variant_of(item) == 0 ? "before"
                                                     : "after");
        std::vector<study::Failure> failures;
        study::append_failures(answers[k], {point_of(item), 1}, failures);
        made.failures.push_back(failures.empty() ? "" : failures[0].reason);
        const std::vector<double> values = input_of(item).values;
        made.values.insert(made.values.end(), values.begin(), values.end());
    }
    return made;
}

study::Conclusion SimulatorRetrofit::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    study::DatasetBuilder datasets(name_);
    datasets.kind("retrofit");
    add_savings(options_, savings_of(answers), datasets);
    study::add_made_runs(simulator_->parameters(), made_runs(answers), datasets);
    std::vector<std::string> given;
    given.reserve(given_.size());
    for (const study::GivenEffect& effect : given_) given.push_back(effect.name);
    datasets.texts("simulator_given", "simulator_given", std::move(given));
    std::vector<study::Failure> failures;
    for (std::size_t k = 0; k < answers.size(); ++k)
        study::append_failures(answers[k], {point_of(static_cast<int>(k)), 1}, failures);
    datasets.failures(failures);
    return {datasets.take()};
}

}  // namespace

std::unique_ptr<study::Stage> make_simulator_retrofit(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator, const study::Period& period,
    const SimulatorRetrofitOptions& options) {
    return std::make_unique<SimulatorRetrofit>(std::move(name), building,
                                               std::move(simulator), period, options);
}

}  // namespace bemcal::retrofit
