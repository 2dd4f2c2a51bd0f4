/// Sobol indices for every step: 32 items, each a fixed block of base points with its own
/// sums.
///
/// Sixteen base points go through time together, chunk by chunk, and every chunk of
/// outputs is added to the sums while it is in the cache. Indices come from the sums of
/// all blocks together; their 95 % intervals from the 32 estimates with one block left
/// out (jackknife; Student's t with 31 degrees of freedom). Blocks of one Sobol sequence
/// complement each other, so the intervals are on the wide side.
#include "stats/saltelli.hpp"
#include "study/datasets.hpp"
#include "study/hourly_sums.hpp"
#include "study/points.hpp"
#include "study/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bemcal::study {
namespace {

constexpr int n_blocks = 32;
constexpr double t_975_31 = 2.0395134463964077;  ///< Student's t, 31 degrees of freedom
constexpr std::size_t chunk_steps = 512;         ///< a multiple of four
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Outputs of sixteen points over some steps, laid out as the kernel's groups write them.
class Outputs {
  public:
    Outputs(std::size_t lanes, std::size_t n_steps)
        : width_(lanes == 8 ? 8 : sixteen),
          n_steps_((n_steps + 3) / 4 * 4),
          values_(n_steps_ * sixteen) {}

    double* group(std::size_t k) { return values_.data() + k * width_ * n_steps_; }
    double& at(std::size_t step, std::size_t lane) {
        return values_[step * sixteen + lane];
    }
    Rows rows(std::size_t begin) {
        return {values_.data() + begin * width_, width_, width_ * n_steps_};
    }

  private:
    std::size_t width_, n_steps_;
    std::vector<double> values_;
};

/// Sixteen points on their way through time, in as many groups as the kernel's lanes
/// make.
class Company {
  public:
    explicit Company(const physics::Batch& batch)
        : batch_(batch), lanes_(static_cast<std::size_t>(batch.lanes())) {
        for (std::size_t k = 0; k < sixteen / lanes_; ++k)
            groups_.push_back(batch.make_group());
    }

    /// \return each point's failure, empty = none
    std::vector<std::string> prepare(const Matrix& points) {
        std::vector<std::string> failures;
        for (std::size_t k = 0; k < groups_.size(); ++k) {
            const auto part = batch_.prepare(points, k * lanes_, lanes_, *groups_[k]);
            failures.insert(failures.end(), part.begin(), part.end());
        }
        return failures;
    }

    void warm_up() {
        for (const auto& group : groups_) batch_.warm_up(*group);
    }

    /// Steps [begin, begin + n) to the front of `outputs`.
    void advance(std::size_t begin, std::size_t n, physics::Quantity quantity,
                 Outputs& outputs) {
        std::vector<double> narrow(lanes_ < 8 ? n * lanes_ : 0);
        for (std::size_t k = 0; k < groups_.size(); ++k) {
            batch_.advance(*groups_[k], static_cast<int>(begin),
                           static_cast<int>(begin + n), quantity,
                           narrow.empty() ? outputs.group(k) : narrow.data());
            for (std::size_t at = 0; at < narrow.size(); ++at)
                outputs.at(at / lanes_, k * lanes_ + at % lanes_) = narrow[at];
        }
    }

  private:
    const physics::Batch& batch_;
    std::size_t lanes_;
    std::vector<physics::Batch::GroupPointer> groups_;
};

/// One block of base points.
class Block {
  public:
    Block(const physics::Batch& batch, physics::Quantity quantity, std::size_t n_steps)
        : batch_(batch),
          quantity_(quantity),
          nominal_(nominal_point(batch.parameters())),
          shift_(n_steps + 3, 0.0),
          sums_(nominal_.size(), n_steps),
          a_(static_cast<std::size_t>(batch.lanes()), chunk_steps),
          b_(a_),
          mixed_(a_) {
        for (std::size_t row = 0; row < nominal_.size() + 2; ++row)
            companies_.emplace_back(batch);
        make_shift();
    }

    /// Adds up to sixteen base points. \param design  rows as saltelli_points, in the
    /// ranges
    void add(const Matrix& design, std::size_t first_row, std::vector<Failure>& failures);

    const std::string& error() const { return error_; }
    std::size_t n_used() const { return n_used_; }
    std::vector<double> sums() const { return sums_.values(); }
    const std::vector<double>& shift() const { return shift_; }

  private:
    std::size_t dimension() const { return nominal_.size(); }
    Matrix nominal_points() const {
        Matrix points(sixteen, dimension());
        for (std::size_t j = 0; j < sixteen; ++j)
            std::ranges::copy(nominal_, points.row(j).begin());
        return points;
    }
    void make_shift();
    std::vector<Matrix> companies_of(const Matrix& design) const;
    void run();

    const physics::Batch& batch_;
    physics::Quantity quantity_;
    std::vector<double> nominal_, shift_;
    HourlySums sums_;
    Outputs a_, b_, mixed_;           ///< of a chunk
    std::vector<Company> companies_;  ///< one for each row of the design
    std::string error_;
    std::size_t n_used_ = 0;
};

void Block::make_shift() {
    error_ = companies_[0].prepare(nominal_points())[0];
    if (!error_.empty()) return;
    companies_[0].warm_up();
    for (std::size_t begin = 0; begin < sums_.n_steps(); begin += chunk_steps) {
        const std::size_t n = std::min(chunk_steps, sums_.n_steps() - begin);
        companies_[0].advance(begin, n, quantity_, a_);
        const Rows rows = a_.rows(0);
        for (std::size_t step = 0; step < n; ++step)
            shift_[begin + step] = rows.first[step * rows.width];
    }
}

/// The points of each company; nominal where the design has no base point left.
std::vector<Matrix> Block::companies_of(const Matrix& design) const {
    const std::size_t n_rows = dimension() + 2;
    std::vector<Matrix> points(n_rows, nominal_points());
    for (std::size_t j = 0; j < design.rows / n_rows; ++j)
        for (std::size_t r = 0; r < n_rows; ++r)
            std::ranges::copy(design.row(j * n_rows + r), points[r].row(j).begin());
    return points;
}

/// A base point with a failed row becomes nominal in every row, which adds nothing.
void Block::add(const Matrix& design, std::size_t first_row,
                std::vector<Failure>& failures) {
    const std::size_t n_rows = companies_.size();
    std::vector<Matrix> points = companies_of(design);
    std::vector<bool> failed(sixteen, false);
    for (std::size_t r = 0; r < n_rows; ++r) {
        const auto reasons = companies_[r].prepare(points[r]);
        for (std::size_t j = 0; j < sixteen; ++j) {
            if (reasons[j].empty()) continue;
            failures.push_back(
                {static_cast<long long>(first_row + j * n_rows + r), reasons[j]});
            failed[j] = true;
        }
    }
    const auto n_failed = static_cast<std::size_t>(std::ranges::count(failed, true));
    n_used_ += design.rows / n_rows - n_failed;
    for (std::size_t r = 0; n_failed > 0 && r < n_rows; ++r) {
        for (std::size_t j = 0; j < sixteen; ++j)
            if (failed[j]) std::ranges::copy(nominal_, points[r].row(j).begin());
        companies_[r].prepare(points[r]);
    }
    run();
}

/// Every row of the design goes through the same chunk of steps before any goes on:
/// outputs stay in the second-level cache until they are added.
void Block::run() {
    for (Company& company : companies_) company.warm_up();
    for (std::size_t begin = 0; begin < sums_.n_steps(); begin += chunk_steps) {
        const std::size_t n = std::min(chunk_steps, sums_.n_steps() - begin);
        companies_.front().advance(begin, n, quantity_, a_);
        companies_.back().advance(begin, n, quantity_, b_);
        sums_.add_base(begin, n, a_.rows(0), b_.rows(0), shift_.data() + begin);
        for (std::size_t i = 0; i < dimension(); ++i) {
            companies_[1 + i].advance(begin, n, quantity_, mixed_);
            sums_.add_mixed(begin, n, i, a_.rows(0), b_.rows(0), mixed_.rows(0));
        }
    }
}

class HourlySensitivity : public Stage {
  public:
    HourlySensitivity(std::string name, const Case& building, const Period& period,
                      physics::Quantity quantity, const SensitivityOptions& options)
        : name_(std::move(name)),
          building_(building.building),
          drive_(drive_of(building, period)),
          axis_(axis_of(building, period)),
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
    ItemAnswer run(int item) const override;
    std::vector<Dataset> conclude(const std::vector<ItemAnswer>& answers) const override;

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
    physics::Batch batch_;
    physics::Quantity quantity_;
    SensitivityOptions options_;
};

ItemAnswer HourlySensitivity::run(int item) const {
    ItemAnswer answer;
    Block block(batch_, quantity_, n_steps());
    answer.error = block.error();
    const std::size_t end = first_of(item + 1);
    for (std::size_t j = first_of(item); answer.error.empty() && j < end; j += sixteen) {
        const Matrix design =
            in_ranges(stats::saltelli_points(j, std::min(sixteen, end - j),
                                             static_cast<int>(dimension()),
                                             options_.scramble, options_.seed),
                      batch_.parameters());
        block.add(design, j * (dimension() + 2), answer.failures);
    }
    if (!answer.error.empty()) return answer;
    answer.values.push_back(static_cast<double>(block.n_used()));
    answer.values.insert(answer.values.end(), block.shift().begin(),
                         block.shift().begin() + static_cast<std::ptrdiff_t>(n_steps()));
    const std::vector<double> sums = block.sums();
    answer.values.insert(answer.values.end(), sums.begin(), sums.end());
    return answer;
}

/// Estimates of one step: from all blocks, then with each block left out in turn.
struct StepEstimates {
    StepEstimate all;
    std::vector<StepEstimate> without;
};

/// Half width of the 95 % jackknife interval.
double jackknife_half_width(const std::vector<double>& without) {
    const double n = static_cast<double>(without.size());
    double sum = 0, square = 0;
    for (const double value : without) sum += value;
    for (const double value : without) square += std::pow(value - sum / n, 2);
    return t_975_31 * std::sqrt((n - 1) / n * square);
}

/// Estimates from the blocks that were computed.
class Blocks {
  public:
    Blocks(const std::vector<ItemAnswer>& answers, std::size_t n_steps,
           std::size_t dimension)
        : n_steps_(n_steps), n_terms_(HourlySums::n_terms(dimension)) {
        for (const ItemAnswer& answer : answers)
            if (answer.error.empty() && answer.values[0] > 0)
                blocks_.push_back(&answer.values);
        for (const auto* block : blocks_) n_ += (*block)[0];
    }

    double shift(std::size_t step) const {
        return blocks_.empty() ? nan : (*blocks_[0])[1 + step];
    }

    StepEstimates at(std::size_t step) const {
        std::vector<double> all(n_terms_, 0.0), rest(n_terms_);
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            for (std::size_t k = 0; k < n_terms_; ++k) all[k] += term(b, k, step);
        StepEstimates found{estimate(all, n_), {}};
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            for (std::size_t k = 0; k < n_terms_; ++k)
                rest[k] = all[k] - term(b, k, step);
            found.without.push_back(estimate(rest, n_ - (*blocks_[b])[0]));
        }
        return found;
    }

  private:
    double term(std::size_t block, std::size_t k, std::size_t step) const {
        return (*blocks_[block])[1 + n_steps_ + step * n_terms_ + k];
    }

    std::size_t n_steps_, n_terms_;
    std::vector<const std::vector<double>*> blocks_;
    double n_ = 0;
};

void add_to(StepEstimate& sum, const StepEstimate& step) {
    sum.parts.resize(step.parts.size(), 0.0);
    sum.variance += step.variance;
    for (std::size_t k = 0; k < step.parts.size(); ++k) sum.parts[k] += step.parts[k];
}

/// The series' estimates: parts and variances of the steps added up (Lamboni, Monod and
/// Makowski 2011, Reliab. Eng. Syst. Saf. 96: generalised indices).
void add_to(StepEstimates& sum, const StepEstimates& step) {
    sum.without.resize(step.without.size());
    add_to(sum.all, step.all);
    for (std::size_t b = 0; b < step.without.size(); ++b)
        add_to(sum.without[b], step.without[b]);
}

/// Indices and half widths, [first order of all inputs, total order of all inputs].
struct Indices {
    std::vector<double> values, half_widths;
};

Indices indices_of(const StepEstimates& estimates, double shift) {
    const std::size_t n = estimates.all.parts.size();
    Indices found{std::vector<double>(n, nan), std::vector<double>(n, nan)};
    const double mean = shift + estimates.all.mean;
    if (!(estimates.all.variance > 1e-24 * mean * mean)) return found;
    std::vector<double> without(estimates.without.size());
    for (std::size_t k = 0; k < n; ++k) {
        found.values[k] = estimates.all.parts[k] / estimates.all.variance;
        std::ranges::transform(
            estimates.without, without.begin(),
            [k](const StepEstimate& rest) { return rest.parts[k] / rest.variance; });
        found.half_widths[k] = jackknife_half_width(without);
    }
    return found;
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

void add_indices(DatasetBuilder& datasets, const std::string& prefix,
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

std::vector<Dataset> HourlySensitivity::conclude(
    const std::vector<ItemAnswer>& answers) const {
    const Blocks blocks(answers, n_steps(), dimension());
    Columns values, half_widths, series_values, series_half_widths;
    std::vector<double> mean, variance;
    std::vector<physics::Seconds> begins;
    StepEstimates series;
    for (std::size_t step = 0; step < n_steps(); ++step) {
        const StepEstimates estimates = blocks.at(step);
        const Indices indices = indices_of(estimates, blocks.shift(step));
        values.append(indices.values);
        half_widths.append(indices.half_widths);
        mean.push_back(blocks.shift(step) + estimates.all.mean);
        variance.push_back(estimates.all.variance);
        begins.push_back(axis_.begin_of(static_cast<int>(step)));
        add_to(series, estimates);
    }
    const Indices of_series = indices_of(series, 0);
    series_values.append(of_series.values);
    series_half_widths.append(of_series.half_widths);

    DatasetBuilder datasets(name_);
    datasets.parameters(batch_.parameters());
    datasets.text("quantity", physics::name_of(quantity_));
    datasets.times("time", begins);
    add_indices(datasets, "hourly", {"time", "parameter"}, {n_steps(), dimension()},
                std::move(values), std::move(half_widths));
    add_indices(datasets, "series", {"parameter"}, {dimension()},
                std::move(series_values), std::move(series_half_widths));
    datasets.vector("hourly_mean", "time", std::move(mean));
    datasets.vector("hourly_variance", "time", std::move(variance));
    std::vector<double> n_used;
    std::vector<Failure> failures;
    for (const ItemAnswer& answer : answers) {
        n_used.push_back(answer.error.empty() ? answer.values[0] : 0);
        failures.insert(failures.end(), answer.failures.begin(), answer.failures.end());
    }
    datasets.vector("block_n_used", "block", std::move(n_used));
    datasets.failures(failures);
    return datasets.take();
}

}  // namespace

std::unique_ptr<Stage> make_hourly_sensitivity(std::string name, const Case& building,
                                               const Period& period,
                                               physics::Quantity quantity,
                                               const SensitivityOptions& options) {
    return std::make_unique<HourlySensitivity>(std::move(name), building, period,
                                               quantity, options);
}

}  // namespace bemcal::study
