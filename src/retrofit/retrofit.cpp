/// Runs retrofits as a stage: the description, then draws or best points of a study
/// above, each simulated before and after every scenario; quantiles of the differences.
/// Follows from paper 3: before and after, with uncertainty.
/// Leaves out the calibrated model's residual, costs, and other use afterwards. Changes
/// are made in `scenario`, quantiles in `savings`.
#include "retrofit/retrofit.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "retrofit/savings.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"
#include "study/step_series.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace bemcal::retrofit {
namespace {

using physics::Quantity;

constexpr std::size_t points_per_item = 64;

constexpr std::size_t n_energies = physics::energies.size();
constexpr std::size_t n_outputs = n_energies + 2;  ///< and hours too cold, too warm

/// A variant of the building over the period.
struct Variant {
    Variant(physics::Building of, const std::vector<physics::Parameter>& numbers,
            std::shared_ptr<const physics::Drive> over)
        : building(std::move(of)),
          drive(std::move(over)),
          batch(building, numbers, *drive) {}
    physics::Building building;
    std::shared_ptr<const physics::Drive> drive;
    kernel::Batch batch;
};

class Retrofit : public study::Stage {
  public:
    Retrofit(std::string name, const study::Case& building, const study::Period& period,
             const RetrofitOptions& options)
        : name_(std::move(name)),
          building_(building),
          options_(options),
          numbers_(building, options.scenarios),
          drive_(std::make_shared<physics::Drive>(study::drive_of(building, period))) {
        add_variant(building.building, drive_);
        for (const Scenario& scenario : options_.scenarios)
            add_variant(with_plant(building.building, scenario),
                        drive_after(scenario, period));
        points_ = study::nominal_row(building.parameters);
    }

    std::string name() const override { return name_; }
    int n_items() const override { return 1; }
    long long n_simulations() const override {
        return static_cast<long long>(variants_.size()) * (1 + options_.n_points);
    }
    bool has_rounds() const override { return true; }
    std::size_t answer_bytes() const override {
        return sizeof(double) * points_per_item * width();
    }
    void see(const std::vector<study::Summary>& found) override {
        found_ = some_of(found_points(found, options_.of, building_), options_.n_points);
    }
    study::ItemAnswer run(int item) const override;
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        if (answers.size() > 1 || found_.rows == 0) return std::nullopt;
        return study::Round{
            static_cast<int>((found_.rows + points_per_item - 1) / points_per_item),
            found_.values};
    }
    void begin_round(int, const study::Round& round) override {
        const std::size_t n = round.needed.size() / building_.parameters.size();
        Matrix points(n + 1, building_.parameters.size());
        std::ranges::copy(points_.row(0), points.row(0).begin());
        std::ranges::copy(round.needed, points.row(1).data());
        points_ = std::move(points);
    }
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        if (answers.size() > 1) return lost_scenarios(savings_of(answers));
        return fmt::format("{} found no points to apply the scenarios to", options_.of);
    }

  private:
    void add_variant(physics::Building building,
                     std::shared_ptr<const physics::Drive> drive) {
        variants_.push_back(std::make_unique<Variant>(
            std::move(building), numbers_.numbers(), std::move(drive)));
    }
    std::shared_ptr<const physics::Drive> drive_after(const Scenario& scenario,
                                                      const study::Period& period) const;
    /// Numbers of a point's answer.
    std::size_t width() const { return n_outputs * variants_.size(); }
    /// Point 0 is the description.
    std::size_t first_point(int item) const {
        return item == 0 ? 0 : 1 + static_cast<std::size_t>(item - 1) * points_per_item;
    }
    std::size_t end_point(int item) const {
        return item == 0 ? 1
                         : std::min(first_point(item) + points_per_item, points_.rows);
    }
    Matrix numbers_of(std::size_t variant, const Matrix& before) const;
    void evaluate(std::size_t variant, const Matrix& numbers, Matrix& rows,
                  std::vector<std::string>& failures) const;
    void count_hours(const Variant& variant, const Matrix& numbers,
                     std::size_t first_column, Matrix& rows) const;
    bool is_occupied(int step) const {
        return options_.occupied_profile < 0 ||
               drive_->profile_at(options_.occupied_profile, step) >= occupied_from;
    }
    Matrix rows_of(const std::vector<study::ItemAnswer>& answers) const;
    Savings savings_of(const std::vector<study::ItemAnswer>& answers) const;

    std::string name_;
    study::Case building_;
    RetrofitOptions options_;
    ScenarioNumbers numbers_;
    std::shared_ptr<const physics::Drive> drive_;     ///< before
    std::vector<std::unique_ptr<Variant>> variants_;  ///< before, then the scenarios
    Matrix found_;                                    ///< rank 0's
    Matrix points_;  ///< the description, then those of the round
};

/// Loads that effects follow are those of the nominal building after a scenario, where
/// that can be simulated; nothing else of a drive changes.
std::shared_ptr<const physics::Drive> Retrofit::drive_after(
    const Scenario& scenario, const study::Period& period) const {
    if (!building_.declared_effects || !building_.declared_effects->follow_loads())
        return drive_;
    const auto before = numbers_.before(study::nominal_row(building_.parameters).row(0));
    physics::Building after = building_.building;
    physics::apply(building_.building, numbers_.numbers(),
                   numbers_.after(before, scenario), after);
    try {
        return std::make_shared<physics::Drive>(
            study::drive_of(building_, after, period));
    } catch (const CannotSimulate&) {
        return drive_;
    }
}

Matrix Retrofit::numbers_of(std::size_t variant, const Matrix& before) const {
    if (variant == 0) return before;
    Matrix numbers = before;
    for (std::size_t r = 0; r < before.rows; ++r) {
        const auto row = before.row(r);
        std::ranges::copy(
            numbers_.after({row.begin(), row.end()}, options_.scenarios[variant - 1]),
            numbers.row(r).begin());
    }
    return numbers;
}

/// Adds the hours in which the zones are too cold and too warm.
void Retrofit::count_hours(const Variant& variant, const Matrix& numbers,
                           std::size_t first_column, Matrix& rows) const {
    const double hours = drive_->axis.step_s / 3600.0;
    const auto count_row = [&](std::size_t row, const study::LaneSeries& temperature) {
        ComfortHours outside;
        for (std::size_t step = 0; step < temperature.size(); ++step)
            if (is_occupied(drive_->n_warm_up + static_cast<int>(step)))
                count(options_, temperature[step], hours, outside);
        rows(row, first_column) = outside.too_cold;
        rows(row, first_column + 1) = outside.too_warm;
    };
    study::for_each_series(variant.batch, numbers, Quantity::air_temperature,
                           drive_->n_steps() - drive_->n_warm_up, count_row);
}

void Retrofit::evaluate(std::size_t variant, const Matrix& numbers, Matrix& rows,
                        std::vector<std::string>& failures) const {
    const Variant& of = *variants_[variant];
    const kernel::Request request{
        {physics::energies.begin(), physics::energies.end()}, {}, {}};
    const auto answers = of.batch.evaluate(numbers, request);
    const std::size_t column = variant * n_outputs;
    count_hours(of, numbers, column + n_energies, rows);
    for (std::size_t r = 0; r < answers.size(); ++r) {
        std::string failure = numbers_.complaint(numbers.row(r));
        if (failure.empty()) failure = answers[r].failure;
        const auto outputs = rows.row(r).subspan(column, n_outputs);
        if (failure.empty()) {
            std::ranges::copy(answers[r].annual, outputs.begin());
            continue;
        }
        std::ranges::fill(outputs, nan);
        if (failures[r].empty())
            failures[r] = variant == 0
                              ? failure
                              : options_.scenarios[variant - 1].name + ": " + failure;
    }
}

study::ItemAnswer Retrofit::run(int item) const {
    const std::size_t first = first_point(item), n = end_point(item) - first;
    Matrix before(n, numbers_.numbers().size());
    for (std::size_t r = 0; r < n; ++r)
        std::ranges::copy(numbers_.before(points_.row(first + r)), before.row(r).begin());
    Matrix rows(n, width(), nan);
    std::vector<std::string> failures(n);
    for (std::size_t v = 0; v < variants_.size(); ++v)
        evaluate(v, numbers_of(v, before), rows, failures);
    study::ItemAnswer answer;
    answer.failures = study::failures_of_points(failures, first);
    for (std::size_t r = 0; r < n; ++r)
        if (std::isnan(rows(r, 0))) std::ranges::fill(rows.row(r), nan);
    answer.values = std::move(rows.values);
    return answer;
}

/// [points x width]; NaN where a point, a scenario at it, or its item failed. Row 0 is
/// the description.
Matrix Retrofit::rows_of(const std::vector<study::ItemAnswer>& answers) const {
    Matrix rows(1 + (answers.size() > 1 ? found_.rows : 0), width(), nan);
    for (std::size_t k = 0; k < answers.size(); ++k)
        std::ranges::copy(answers[k].values,
                          rows.row(first_point(static_cast<int>(k))).data());
    return rows;
}

Savings Retrofit::savings_of(const std::vector<study::ItemAnswer>& answers) const {
    Savings savings;
    for (const Scenario& scenario : options_.scenarios)
        savings.scenarios.push_back(scenario.name);
    for (const Quantity quantity : physics::energies)
        savings.outputs.push_back(
            {physics::name_of(quantity), physics::unit_of(quantity)});
    for (const char* hours : comfort_outputs) savings.outputs.push_back({hours, "h"});
    savings.rows = rows_of(answers);
    savings.parameters = building_.parameters;
    if (answers.size() > 1) savings.points = found_;
    savings.period = drive_->period();
    add_accounts(
        building_.meters,
        [](const study::Meter& meter) {
            return std::string(physics::name_of(meter.quantity));
        },
        savings);
    return savings;
}

study::Conclusion Retrofit::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    study::DatasetBuilder datasets(name_);
    datasets.kind("retrofit");
    add_savings(options_, savings_of(answers), datasets);
    std::vector<study::Failure> failures;
    for (std::size_t k = 0; k < answers.size(); ++k)
        study::append_failures(answers[k], {first_point(static_cast<int>(k)), 1},
                               failures);
    datasets.failures(failures);
    return {datasets.take()};
}

}  // namespace

Matrix found_points(const std::vector<study::Summary>& found, const std::string& of,
                    const study::Case& building) {
    return points_in(study::find_summary(found, of, building.name), building.parameters);
}

std::unique_ptr<study::Stage> make_retrofit(std::string name, const study::Case& building,
                                            const study::Period& period,
                                            const RetrofitOptions& options) {
    return std::make_unique<Retrofit>(std::move(name), building, period, options);
}

}  // namespace bemcal::retrofit
