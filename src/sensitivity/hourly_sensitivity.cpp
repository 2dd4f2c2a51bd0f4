/// Runs Sobol sensitivity for every step of a period as a stage: 32 items, each a fixed
/// block of base points that answers with sums (`hourly_block`), put together at the end.
/// Source: Saltelli et al. 2010, table 2 (b) and (f).
/// One quantity at a time, first and total order only. Scalar outputs are in
/// `sensitivity`.
#include "sensitivity/hourly_block.hpp"
#include "sensitivity/hourly_indices.hpp"
#include "sensitivity/sensitivity.hpp"
#include "stats/saltelli.hpp"
#include "study/datasets.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <stdexcept>

namespace bemcal::sensitivity {
namespace {

class HourlySensitivity : public study::Stage {
  public:
    HourlySensitivity(std::string name, const study::Case& building,
                      const study::Period& period, physics::Quantity quantity,
                      const SensitivityOptions& options)
        : name_(std::move(name)),
          building_(building.building),
          drive_(study::drive_of(building, period)),
          axis_(study::axis_of(building, period)),
          batch_(building_, building.parameters, drive_),
          quantity_(quantity),
          options_(options) {
        if (options.n_base < 2 * n_blocks)
            throw std::invalid_argument(
                "an hourly sensitivity needs at least 64 base points");
    }

    std::string name() const override { return name_; }
    int n_items() const override { return n_blocks; }
    long long n_simulations() const override {
        return static_cast<long long>(options_.n_base * (dimension() + 2));
    }
    std::size_t answer_bytes() const override {
        return (1 + n_values()) * sizeof(double);
    }
    study::ItemAnswer run(int item) const override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;

  private:
    std::size_t dimension() const { return batch_.parameters().size(); }
    std::size_t n_steps() const { return static_cast<std::size_t>(axis_.n_steps); }
    /// Of an answer, after the number of base points used: the shift, then the sums.
    std::size_t n_values() const {
        return (1 + HourlySums::n_terms(dimension())) * n_steps();
    }
    std::size_t first_of(int block) const {
        return options_.n_base * static_cast<std::size_t>(block) / n_blocks;
    }

    std::string name_;
    physics::Building building_;
    physics::Drive drive_;
    physics::TimeAxis axis_;
    kernel::Batch batch_;
    physics::Quantity quantity_;
    SensitivityOptions options_;
};

study::ItemAnswer HourlySensitivity::run(int item) const {
    study::ItemAnswer answer;
    Block block(batch_, quantity_, n_steps());
    answer.error = block.error();
    const std::size_t end = first_of(item + 1), n_visit = Block::most_points();
    for (std::size_t j = first_of(item); answer.error.empty() && j < end; j += n_visit) {
        const Matrix design =
            study::in_ranges(stats::saltelli_points(j, std::min(n_visit, end - j),
                                                    static_cast<int>(dimension()),
                                                    options_.scramble, options_.seed),
                             batch_.parameters());
        block.add(design, j * (dimension() + 2), answer.failures);
    }
    if (!answer.error.empty()) return answer;
    answer.values.push_back(static_cast<double>(block.n_used()));
    answer.values.insert(answer.values.end(), block.shift().begin(), block.shift().end());
    const std::vector<double> sums = block.sums();
    answer.values.insert(answer.values.end(), sums.begin(), sums.end());
    return answer;
}

struct Columns {
    std::vector<double> first, total;
    /// Halves of values of all inputs.
    void append(const std::vector<double>& values) {
        const auto middle =
            values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        first.insert(first.end(), values.begin(), middle);
        total.insert(total.end(), middle, values.end());
    }
};

void add_indices(study::DatasetBuilder& datasets, const std::string& prefix,
                 const std::vector<std::string>& dims,
                 const std::vector<std::size_t>& shape, Columns values,
                 Columns half_widths) {
    datasets.array(prefix + "_first_order", dims, shape, std::move(values.first));
    datasets.array(prefix + "_first_order_half_width", dims, shape,
                   std::move(half_widths.first));
    datasets.array(prefix + "_total_order", dims, shape, std::move(values.total));
    datasets.array(prefix + "_total_order_half_width", dims, shape,
                   std::move(half_widths.total));
}

/// What is said of every step.
struct Steps {
    Columns values, half_widths;
    std::vector<double> mean, variance;
    StepEstimates series;

    void add(const StepEstimates& estimates, double shift) {
        const Indices indices = indices_of(estimates, shift);
        values.append(indices.values);
        half_widths.append(indices.half_widths);
        mean.push_back(shift + estimates.all.mean);
        variance.push_back(estimates.all.variance);
        add_to(series, estimates);
    }
};

void add_steps(study::DatasetBuilder& datasets, const physics::TimeAxis& axis,
               std::size_t dimension, Steps steps) {
    std::vector<physics::Seconds> begins;
    begins.reserve(static_cast<std::size_t>(axis.n_steps));
    for (int step = 0; step < axis.n_steps; ++step) begins.push_back(axis.begin_of(step));
    datasets.times("time", begins);
    add_indices(datasets, "hourly", {"time", "parameter"}, {begins.size(), dimension},
                std::move(steps.values), std::move(steps.half_widths));
    const Indices of_series = indices_of(steps.series, 0);
    Columns values, half_widths;
    values.append(of_series.values);
    half_widths.append(of_series.half_widths);
    add_indices(datasets, "series", {"parameter"}, {dimension}, std::move(values),
                std::move(half_widths));
    datasets.vector("hourly_mean", "time", std::move(steps.mean));
    datasets.vector("hourly_variance", "time", std::move(steps.variance));
}

void add_blocks(study::DatasetBuilder& datasets,
                const std::vector<study::ItemAnswer>& answers) {
    std::vector<double> n_used;
    std::vector<study::Failure> failures;
    for (const study::ItemAnswer& answer : answers) {
        n_used.push_back(answer.error.empty() ? answer.values[0] : 0);
        failures.insert(failures.end(), answer.failures.begin(), answer.failures.end());
    }
    datasets.vector("block_n_used", "block", std::move(n_used));
    datasets.failures(failures);
}

study::Conclusion HourlySensitivity::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    const Blocks blocks(answers, n_steps(), dimension());
    Steps steps;
    for (std::size_t step = 0; step < n_steps(); ++step)
        steps.add(blocks.at(step), blocks.shift(step));
    study::DatasetBuilder datasets(name_);
    datasets.kind("hourly_sensitivity");
    datasets.parameters(batch_.parameters());
    datasets.text("quantity", physics::name_of(quantity_));
    add_steps(datasets, axis_, dimension(), std::move(steps));
    add_blocks(datasets, answers);
    return {datasets.take()};
}

}  // namespace

std::unique_ptr<study::Stage> make_hourly_sensitivity(std::string name,
                                                      const study::Case& building,
                                                      const study::Period& period,
                                                      physics::Quantity quantity,
                                                      const SensitivityOptions& options) {
    return std::make_unique<HourlySensitivity>(std::move(name), building, period,
                                               quantity, options);
}

}  // namespace bemcal::sensitivity
