/// Runs Sobol sensitivity of scalar outputs as a stage: an item is a fixed block of base
/// points, all of their d + 2 rows; indices are computed when all blocks are in.
/// Source: Saltelli et al. 2010, by `sobol_indices`; paper 1, eq. 5-8, and its threshold.
/// First and total order only. Every hour of a year is in `hourly_sensitivity`.
#include "sensitivity/sensitivity.hpp"

#include "base/nan.hpp"
#include "stats/saltelli.hpp"
#include "study/datasets.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"

#include <algorithm>

namespace bemcal::sensitivity {
namespace {

constexpr std::size_t fast_block_size = 64;  ///< base points of an item

class Sensitivity : public study::Stage {
  public:
    Sensitivity(std::string name, std::shared_ptr<const study::Simulator> simulator,
                const SensitivityOptions& options)
        : name_(std::move(name)),
          simulator_(std::move(simulator)),
          options_(options),
          block_size_(simulator_->is_slow() ? 1 : fast_block_size) {}

    std::string name() const override { return name_; }
    int n_items() const override {
        return static_cast<int>((options_.n_base + block_size_ - 1) / block_size_);
    }
    long long n_simulations() const override {
        return static_cast<long long>(options_.n_base * rows_per_base_point());
    }
    std::size_t answer_bytes() const override {
        return block_size_ * rows_per_base_point() * n_outputs() * sizeof(double);
    }
    study::ItemAnswer run(int item) const override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override;
    bool failures_may_pass() const override { return simulator_->failures_may_pass(); }

  private:
    std::size_t dimension() const { return simulator_->parameters().size(); }
    std::size_t rows_per_base_point() const { return dimension() + 2; }
    std::size_t n_outputs() const { return simulator_->outputs().size(); }
    std::size_t first_of(std::size_t item) const { return item * block_size_; }
    std::size_t size_of(std::size_t item) const {
        return std::min(block_size_, options_.n_base - first_of(item));
    }
    Matrix outputs_of(const std::vector<study::ItemAnswer>& answers) const;
    std::vector<study::Failure> failures_of(
        const std::vector<study::ItemAnswer>& answers) const;
    void add_sample(study::DatasetBuilder& datasets) const;
    void add_indices(const Matrix& outputs, study::DatasetBuilder& datasets) const;

    std::string name_;
    std::shared_ptr<const study::Simulator> simulator_;
    SensitivityOptions options_;
    std::size_t block_size_;
};

study::ItemAnswer Sensitivity::run(int item) const {
    const auto index = static_cast<std::size_t>(item);
    const Matrix points =
        study::in_ranges(stats::saltelli_points(first_of(index), size_of(index),
                                                static_cast<int>(dimension()),
                                                options_.scramble, options_.seed),
                         simulator_->parameters());
    study::ItemAnswer answer;
    Matrix outputs;
    std::vector<std::string> failures;
    simulator_->evaluate(points, outputs, failures);
    const std::size_t first_row = first_of(index) * rows_per_base_point();
    answer.failures = study::failures_of_points(failures, first_row);
    answer.values = std::move(outputs.values);
    return answer;
}

/// All outputs in the design's order; NaN where an item failed. \return [rows x outputs]
Matrix Sensitivity::outputs_of(const std::vector<study::ItemAnswer>& answers) const {
    Matrix outputs(options_.n_base * rows_per_base_point(), n_outputs(), nan);
    for (std::size_t item = 0; item < answers.size(); ++item) {
        const std::size_t row = first_of(item) * rows_per_base_point();
        std::ranges::copy(answers[item].values, outputs.row(row).data());
    }
    return outputs;
}

std::vector<study::Failure> Sensitivity::failures_of(
    const std::vector<study::ItemAnswer>& answers) const {
    std::vector<study::Failure> failures;
    for (std::size_t item = 0; item < answers.size(); ++item)
        study::append_failures(answers[item],
                               {first_of(item) * rows_per_base_point(),
                                size_of(item) * rows_per_base_point()},
                               failures);
    return failures;
}

void Sensitivity::add_sample(study::DatasetBuilder& datasets) const {
    const std::size_t d = dimension(), n = options_.n_base;
    const Matrix points =
        study::in_ranges(stats::saltelli_points(0, n, static_cast<int>(d),
                                                options_.scramble, options_.seed),
                         simulator_->parameters());
    std::vector<double> a, b;
    for (std::size_t j = 0; j < n; ++j) {
        const auto row_a = points.row(j * (d + 2)),
                   row_b = points.row(j * (d + 2) + d + 1);
        a.insert(a.end(), row_a.begin(), row_a.end());
        b.insert(b.end(), row_b.begin(), row_b.end());
    }
    datasets.array("sample_a", {"base_point", "parameter"}, {n, d}, std::move(a));
    datasets.array("sample_b", {"base_point", "parameter"}, {n, d}, std::move(b));
}

void append(std::vector<double>& to, const std::vector<double>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

/// Paper 1's rule: an input whose index is above the threshold is sensitive.
std::vector<double> flag(const std::vector<double>& total_order, double threshold) {
    std::vector<double> flags;
    flags.reserve(total_order.size());
    for (const double index : total_order) flags.push_back(index > threshold ? 1 : 0);
    return flags;
}

void Sensitivity::add_indices(const Matrix& outputs,
                              study::DatasetBuilder& datasets) const {
    std::vector<double> first, first_half, total, total_half, mean, variance, n_used;
    for (std::size_t k = 0; k < n_outputs(); ++k) {
        std::vector<double> output(outputs.rows);
        for (std::size_t r = 0; r < outputs.rows; ++r) output[r] = outputs(r, k);
        const auto indices = stats::sobol_indices(output, static_cast<int>(dimension()),
                                                  options_.n_bootstrap, options_.seed);
        append(first, indices.first_order);
        append(first_half, indices.first_half_width);
        append(total, indices.total_order);
        append(total_half, indices.total_half_width);
        mean.push_back(indices.mean);
        variance.push_back(indices.variance);
        n_used.push_back(indices.n_used);
    }
    const std::vector<std::string> dims{"output", "parameter"};
    const std::vector<std::size_t> shape{n_outputs(), dimension()};
    datasets.array("sensitive", dims, shape, flag(total, options_.threshold));
    datasets.array("first_order", dims, shape, std::move(first));
    datasets.array("first_order_half_width", dims, shape, std::move(first_half));
    datasets.array("total_order", dims, shape, std::move(total));
    datasets.array("total_order_half_width", dims, shape, std::move(total_half));
    datasets.vector("output_mean", "output", std::move(mean));
    datasets.vector("output_variance", "output", std::move(variance));
    datasets.vector("n_used", "output", std::move(n_used));
    datasets.scalar("threshold", options_.threshold);
}

study::Conclusion Sensitivity::conclude(
    const std::vector<study::ItemAnswer>& answers) const {
    study::DatasetBuilder datasets(name_);
    datasets.kind(options_.kind);
    datasets.parameters(simulator_->parameters());
    std::vector<std::string> names, units;
    for (const study::Output& output : simulator_->outputs()) {
        names.push_back(output.name);
        units.push_back(output.unit);
    }
    datasets.texts("output", "output", std::move(names));
    datasets.texts("output_unit", "output", std::move(units));
    add_sample(datasets);
    Matrix outputs = outputs_of(answers);
    add_indices(outputs, datasets);
    datasets.array("design_output", {"base_point", "design_row", "output"},
                   {options_.n_base, rows_per_base_point(), n_outputs()},
                   std::move(outputs.values));
    datasets.failures(failures_of(answers));
    return {datasets.take()};
}

}  // namespace

std::unique_ptr<study::Stage> make_sensitivity(
    std::string name, std::shared_ptr<const study::Simulator> simulator,
    const SensitivityOptions& options) {
    return std::make_unique<Sensitivity>(std::move(name), std::move(simulator), options);
}

}  // namespace bemcal::sensitivity
