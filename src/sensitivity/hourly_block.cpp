/// Takes a block of an hourly Sobol design through time, sixteen base points together.
/// Each row runs a chunk of steps, and differences are added up while they are in cache.
/// Source: Saltelli's design, rows A, AB_i and B.
/// Outputs are not kept. A base point with a failed row becomes nominal, which adds
/// nothing. Indices are in `hourly_indices`.
#include "sensitivity/hourly_block.hpp"

#include "study/points.hpp"

#include <algorithm>

namespace bemcal::sensitivity {
namespace {

constexpr std::size_t chunk_steps = 144;   ///< a multiple of four
constexpr std::size_t most_companies = 4;  ///< of a visit

/// The sixteen points of each row of the design; nominal where it has no base point left.
std::vector<Matrix> rows_of(const Matrix& design, const kernel::Batch& batch) {
    const std::size_t n_rows = batch.parameters().size() + 2;
    std::vector<Matrix> points(n_rows,
                               study::nominal_points(batch.parameters(), sixteen));
    for (std::size_t j = 0; j < design.rows / n_rows; ++j)
        for (std::size_t r = 0; r < n_rows; ++r)
            std::ranges::copy(design.row(j * n_rows + r), points[r].row(j).begin());
    return points;
}

/// Calls action(begin, n) for each chunk of n_steps.
template <class Action>
void for_chunks(std::size_t n_steps, Action action) {
    for (std::size_t begin = 0; begin < n_steps; begin += chunk_steps)
        action(begin, std::min(chunk_steps, n_steps - begin));
}

}  // namespace

Company::Company(const kernel::Batch& batch, physics::Quantity quantity)
    : batch_(&batch), quantity_(quantity), rows_(batch.parameters().size() + 2) {
    const std::size_t n_groups = sixteen / static_cast<std::size_t>(batch.lanes());
    for (std::size_t k = 0; k < n_groups; ++k) {
        auto groups = batch.make_groups(rows_.size(), quantity);
        for (std::size_t r = 0; r < rows_.size(); ++r)
            rows_[r].push_back(std::move(groups[r]));
        a_.emplace_back(chunk_steps, batch.lanes());
        b_.emplace_back(chunk_steps, batch.lanes());
    }
}

/// \return each point's failure, empty = none
std::vector<std::string> Company::prepare_row(std::size_t row, const Matrix& points) {
    const auto lanes = static_cast<std::size_t>(batch_->lanes());
    std::vector<std::string> failures;
    for (std::size_t k = 0; k < rows_[row].size(); ++k) {
        const auto part = batch_->prepare(points, k * lanes, lanes, *rows_[row][k]);
        failures.insert(failures.end(), part.begin(), part.end());
    }
    return failures;
}

/// \return the base points that failed in some row
std::vector<bool> Company::prepare_rows(const std::vector<Matrix>& points,
                                        std::size_t first_row,
                                        std::vector<study::Failure>& failures) {
    std::vector<bool> failed(sixteen, false);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const auto reasons = prepare_row(r, points[r]);
        for (std::size_t j = 0; j < sixteen; ++j) {
            if (reasons[j].empty()) continue;
            failures.push_back(
                {static_cast<long long>(first_row + j * rows_.size() + r), reasons[j]});
            failed[j] = true;
        }
    }
    return failed;
}

/// A base point with a failed row becomes nominal in every row, which adds nothing.
std::size_t Company::prepare(const Matrix& design, std::size_t first_row,
                             std::vector<study::Failure>& failures) {
    std::vector<Matrix> points = rows_of(design, *batch_);
    const std::vector<bool> failed = prepare_rows(points, first_row, failures);
    const auto n_failed = static_cast<std::size_t>(std::ranges::count(failed, true));
    const std::vector<double> nominal = study::nominal_point(batch_->parameters());
    for (std::size_t r = 0; n_failed > 0 && r < rows_.size(); ++r) {
        for (std::size_t j = 0; j < sixteen; ++j)
            if (failed[j]) std::ranges::copy(nominal, points[r].row(j).begin());
        prepare_row(r, points[r]);
    }
    return design.rows / rows_.size() - n_failed;
}

void Company::warm_up() {
    for (const Groups& groups : rows_)
        for (const auto& group : groups) batch_->warm_up(*group);
}

void Company::add_base(std::size_t begin, std::size_t n, const double* shift,
                       LaneSums& sums) {
    const int from = static_cast<int>(begin), to = static_cast<int>(begin + n);
    for (std::size_t k = 0; k < a_.size(); ++k) {
        batch_->advance(*rows_.front()[k], from, to, quantity_, a_[k].data());
        batch_->advance(*rows_.back()[k], from, to, quantity_, b_[k].data());
        batch_->add_base(shift, to - from, a_[k].data(), b_[k].data(), sums.group(k));
    }
}

Block::Block(const kernel::Batch& batch, physics::Quantity quantity, std::size_t n_steps)
    : batch_(batch),
      quantity_(quantity),
      sums_(batch.parameters().size(), n_steps),
      of_chunk_(static_cast<std::size_t>(batch.lanes()), chunk_steps) {
    make_shift(n_steps);
}

std::size_t Block::most_points() {
    return most_companies * sixteen;
}

void Block::make_shift(std::size_t n_steps) {
    const auto group = batch_.make_group();
    error_ = batch_.prepare(study::nominal_row(batch_.parameters()), 0, 1, *group)[0];
    if (!error_.empty()) return;
    batch_.warm_up(*group);
    LaneArray rows(chunk_steps, batch_.lanes());
    for_chunks(n_steps, [&](std::size_t begin, std::size_t n) {
        batch_.advance(*group, static_cast<int>(begin), static_cast<int>(begin + n),
                       quantity_, rows.data());
        for (std::size_t step = 0; step < n; ++step) shift_.push_back(rows.at(step, 0));
    });
}

void Block::add(const Matrix& design, std::size_t first_row,
                std::vector<study::Failure>& failures) {
    const std::size_t per_company = sixteen * (batch_.parameters().size() + 2);
    std::size_t n_companies = 0;
    for (std::size_t row = 0; row < design.rows; row += per_company, ++n_companies) {
        if (n_companies == companies_.size()) companies_.emplace_back(batch_, quantity_);
        n_used_ += companies_[n_companies].prepare(
            study::part_of(design, row, std::min(per_company, design.rows - row)),
            first_row + row, failures);
    }
    run(n_companies);
}

void Block::run(std::size_t n_companies) {
    const std::span<Company> companies(companies_.data(), n_companies);
    for (Company& company : companies) company.warm_up();
    for_chunks(shift_.size(),
               [&](std::size_t begin, std::size_t n) { run_chunk(begin, n, companies); });
}

/// Every row of the design goes through the same steps before any goes on.
void Block::run_chunk(std::size_t begin, std::size_t n, std::span<Company> companies) {
    of_chunk_.clear();
    for (Company& company : companies)
        company.add_base(begin, n, shift_.data() + begin, of_chunk_);
    sums_.add_base(begin, n, of_chunk_);
    for (std::size_t i = 0; i < batch_.parameters().size(); ++i) {
        for (std::size_t k = 0; k < of_chunk_.n_groups(); ++k) {
            mixed_.clear();
            for (Company& company : companies) mixed_.push_back(company.mixed(i, k));
            batch_.sum_differences(mixed_, static_cast<int>(begin),
                                   static_cast<int>(begin + n), quantity_,
                                   of_chunk_.group(k));
        }
        sums_.add_input(i, begin, n, of_chunk_);
    }
}

}  // namespace bemcal::sensitivity
