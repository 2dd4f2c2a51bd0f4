/// Runs retrofits as a stage: the description, then draws or best points of a study
/// above, each simulated before and after every scenario; quantiles of the differences.
/// Follows from paper 3: before and after, with uncertainty.
/// Leaves out the calibrated model's residual, costs, and other use afterwards. Changes
/// are made in `scenario`.
#include "retrofit/retrofit.hpp"

#include "base/nan.hpp"
#include "stats/quantile.hpp"
#include "study/datasets.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"
#include "study/some_draws.hpp"
#include "study/step_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace bemcal::retrofit {
namespace {

using physics::Quantity;

constexpr std::size_t points_per_item = 64;
constexpr double quantiles[] = {0.05, 0.5, 0.95};
/// A thermostat holds its set-point but for rounding: nearer than this is not outside.
constexpr double tolerance = 0.05;  // [K]

constexpr std::size_t n_energies = physics::energies.size();
constexpr std::size_t n_outputs = n_energies + 2;  ///< and hours too cold, too warm

/// A variant of the building over the period.
struct Variant {
    Variant(physics::Building of, const std::vector<physics::Parameter>& numbers,
            const physics::Drive& drive)
        : building(std::move(of)), batch(building, numbers, drive) {}
    physics::Building building;
    kernel::Batch batch;
};

/// [columns] of the rows that have no NaN.
std::vector<double> quantiles_of(const Matrix& values, double p) {
    std::vector<double> result(values.cols, nan), column;
    for (std::size_t k = 0; k < values.cols; ++k) {
        column.clear();
        for (std::size_t r = 0; r < values.rows; ++r)
            if (!std::isnan(values(r, k))) column.push_back(values(r, k));
        std::ranges::sort(column);
        if (!column.empty()) result[k] = stats::quantile_of_sorted(column, p);
    }
    return result;
}

void append(std::vector<double>& to, const std::vector<double>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

/// The quantiles of all columns, one after the other.
void append_quantiles(std::vector<double>& to, const Matrix& values) {
    for (const double p : quantiles) append(to, quantiles_of(values, p));
}

class Retrofit : public study::Stage {
  public:
    Retrofit(std::string name, const study::Case& building, const study::Period& period,
             const RetrofitOptions& options)
        : name_(std::move(name)),
          building_(building),
          options_(options),
          numbers_(building, options.scenarios),
          drive_(study::drive_of(building, period)) {
        add_variant(building.building);
        for (const Scenario& scenario : options_.scenarios)
            add_variant(with_plant(building.building, scenario));
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
        const Matrix all = found_points(found, options_.of, building_);
        found_ = Matrix(0, all.cols);
        for (const std::size_t row : study::chosen_rows(all.rows, options_.n_points)) {
            const auto point = all.row(row);
            found_.values.insert(found_.values.end(), point.begin(), point.end());
            ++found_.rows;
        }
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
        if (answers.size() > 1) return {};
        return fmt::format("{} found no points to apply the scenarios to", options_.of);
    }

  private:
    void add_variant(physics::Building building) {
        variants_.push_back(
            std::make_unique<Variant>(std::move(building), numbers_.numbers(), drive_));
    }
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
               drive_.profile_at(options_.occupied_profile, step) >= 0.5;
    }
    Matrix rows_of(const std::vector<study::ItemAnswer>& answers) const;
    void add_names(study::DatasetBuilder& datasets) const;

    std::string name_;
    study::Case building_;
    RetrofitOptions options_;
    ScenarioNumbers numbers_;
    physics::Drive drive_;
    std::vector<std::unique_ptr<Variant>> variants_;  ///< before, then the scenarios
    Matrix found_;                                    ///< rank 0's
    Matrix points_;  ///< the description, then those of the round
};

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
    const double hours = drive_.axis.step_s / 3600.0;
    const auto count = [&](std::size_t row, const study::LaneSeries& temperature) {
        double cold = 0, warm = 0;
        for (std::size_t step = 0; step < temperature.size(); ++step) {
            if (!is_occupied(drive_.n_warm_up + static_cast<int>(step))) continue;
            if (temperature[step] < options_.too_cold - tolerance) cold += hours;
            if (temperature[step] > options_.too_warm + tolerance) warm += hours;
        }
        rows(row, first_column) = cold;
        rows(row, first_column + 1) = warm;
    };
    study::for_each_series(variant.batch, numbers, Quantity::air_temperature,
                           drive_.n_steps() - drive_.n_warm_up, count);
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
        if (failure.empty())
            std::ranges::copy(answers[r].annual, rows.row(r).subspan(column).begin());
        else if (failures[r].empty())
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
        if (!failures[r].empty()) std::ranges::fill(rows.row(r), nan);
    answer.values = std::move(rows.values);
    return answer;
}

/// [points x width]; NaN where a point or its item failed. Row 0 is the description.
Matrix Retrofit::rows_of(const std::vector<study::ItemAnswer>& answers) const {
    Matrix rows(1 + (answers.size() > 1 ? found_.rows : 0), width(), nan);
    for (std::size_t k = 0; k < answers.size(); ++k)
        std::ranges::copy(answers[k].values,
                          rows.row(first_point(static_cast<int>(k))).data());
    return rows;
}

void Retrofit::add_names(study::DatasetBuilder& datasets) const {
    std::vector<std::string> scenarios, names, units;
    for (const Scenario& scenario : options_.scenarios)
        scenarios.push_back(scenario.name);
    for (const Quantity quantity : physics::energies) {
        names.emplace_back(physics::name_of(quantity));
        units.emplace_back(physics::unit_of(quantity));
    }
    for (const char* hours : {"too_cold", "too_warm"}) {
        names.emplace_back(hours);
        units.emplace_back("h");
    }
    datasets.texts("scenario", "scenario", std::move(scenarios));
    datasets.texts("output", "output", std::move(names));
    datasets.texts("output_unit", "output", std::move(units));
    datasets.text("points_of", options_.of);
    datasets.vector("quantile", "quantile", {std::begin(quantiles), std::end(quantiles)});
    datasets.vector("comfort_limit", "limit", {options_.too_cold, options_.too_warm});
    const physics::TimeAxis simulated = drive_.period();
    datasets.times("simulated_period", {simulated.start, simulated.end()}, "end");
    datasets.parameters(building_.parameters);
}

/// The columns of one variant, of all rows but the first.
Matrix columns_of(const Matrix& rows, std::size_t variant) {
    Matrix part(rows.rows - 1, n_outputs);
    for (std::size_t r = 0; r < part.rows; ++r)
        for (std::size_t k = 0; k < n_outputs; ++k)
            part(r, k) = rows(r + 1, variant * n_outputs + k);
    return part;
}

/// Before less after; or that over before, 0 where there was nothing to save.
Matrix saving_of(const Matrix& before, const Matrix& after, bool is_share) {
    Matrix saving(before.rows, before.cols);
    for (std::size_t k = 0; k < saving.values.size(); ++k) {
        const double saved = before.values[k] - after.values[k];
        saving.values[k] = !is_share || saved == 0 ? saved : saved / before.values[k];
    }
    return saving;
}

study::Conclusion Retrofit::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    study::DatasetBuilder datasets(name_);
    datasets.kind("retrofit");
    add_names(datasets);
    const Matrix rows = rows_of(answers);
    const std::size_t n_scenarios = options_.scenarios.size();
    const std::size_t n = rows.rows - 1, n_q = std::size(quantiles);
    const Matrix before = columns_of(rows, 0);
    std::vector<double> after, after_q, saving_q, share_q, before_q;
    for (std::size_t s = 1; s <= n_scenarios; ++s) {
        const Matrix of_scenario = columns_of(rows, s);
        append(after, of_scenario.values);
        append_quantiles(after_q, of_scenario);
        append_quantiles(saving_q, saving_of(before, of_scenario, false));
        append_quantiles(share_q, saving_of(before, of_scenario, true));
    }
    append_quantiles(before_q, before);
    const auto described = rows.row(0);
    datasets.array("described", {"variant", "output"}, {variants_.size(), n_outputs},
                   {described.begin(), described.end()});
    datasets.array("before_quantile", {"quantile", "output"}, {n_q, n_outputs},
                   std::move(before_q));
    const std::vector<std::string> dims{"scenario", "quantile", "output"};
    const std::vector<std::size_t> shape{n_scenarios, n_q, n_outputs};
    datasets.array("after_quantile", dims, shape, std::move(after_q));
    datasets.array("saving_quantile", dims, shape, std::move(saving_q));
    datasets.array("saving_share_quantile", dims, shape, std::move(share_q));
    if (n > 0) {
        datasets.array("points", {"point", "parameter"}, {n, found_.cols}, found_.values);
        datasets.array("before", {"point", "output"}, {n, n_outputs}, before.values);
        datasets.array("after", {"scenario", "point", "output"},
                       {n_scenarios, n, n_outputs}, std::move(after));
    }
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
    const study::Summary* summary = study::find_summary(found, of, building.name);
    if (summary == nullptr) return {};
    const auto& [names, rows] = summary->points;
    Matrix points = study::nominal_points(building.parameters, rows.rows);
    for (std::size_t k = 0; k < points.cols; ++k) {
        const auto name = std::ranges::find(names, building.parameters[k].name);
        if (name == names.end()) continue;
        const auto column = static_cast<std::size_t>(name - names.begin());
        for (std::size_t r = 0; r < rows.rows; ++r) points(r, k) = rows(r, column);
    }
    return points;
}

std::unique_ptr<study::Stage> make_retrofit(std::string name, const study::Case& building,
                                            const study::Period& period,
                                            const RetrofitOptions& options) {
    return std::make_unique<Retrofit>(std::move(name), building, period, options);
}

}  // namespace bemcal::retrofit
