/// Linear least squares with a normal prior: normal equations by `sums`; solution,
/// inverse, and a jackknife whose blocks are cut from the same sums, by Eigen.
/// Source: textbook; jackknife: Kuensch 1989, one linear step for each block. Left out:
/// iterations and bounds (unknowns are only held fixed). Normal equations square the
/// condition.
#include "stats/least_squares.hpp"

#include "stats/sums.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Dense>

namespace bemcal::stats {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using View = Eigen::Map<const RowMajor>;
using VectorView = Eigen::Map<const Eigen::VectorXd>;

View view(const Matrix& matrix) {
    return {matrix.values.data(), static_cast<Eigen::Index>(matrix.rows),
            static_cast<Eigen::Index>(matrix.cols)};
}

VectorView view(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Matrix to_matrix(const Eigen::MatrixXd& from) {
    Matrix to(static_cast<std::size_t>(from.rows()),
              static_cast<std::size_t>(from.cols()));
    Eigen::Map<RowMajor>(to.values.data(), from.rows(), from.cols()) = from;
    return to;
}

/// The unknowns that are not fixed.
std::vector<Eigen::Index> free_of(std::span<const char> fixed) {
    std::vector<Eigen::Index> free;
    free.reserve(fixed.size());
    for (std::size_t k = 0; k < fixed.size(); ++k)
        if (!fixed[k]) free.push_back(static_cast<Eigen::Index>(k));
    return free;
}

Eigen::MatrixXd reduced(const Matrix& matrix, std::span<const double> diagonal,
                        const std::vector<Eigen::Index>& free) {
    Eigen::MatrixXd full = view(matrix);
    full.diagonal() += view(diagonal);
    return full(free, free);
}

Rows rows_of(const Matrix& matrix) {
    Rows rows;
    rows.reserve(matrix.rows + 2);
    for (std::size_t r = 0; r < matrix.rows; ++r) rows.push_back(matrix.row(r).data());
    return rows;
}

/// Element by element.
std::vector<double> product_of(std::span<const double> a, std::span<const double> b) {
    std::vector<double> product(a.begin(), a.end());
    for (std::size_t k = 0; k < product.size(); ++k) product[k] *= b[k];
    return product;
}

/// A run of readings of one block.
struct Run {
    std::size_t begin, size;
};

std::vector<std::vector<Run>> runs_of(std::span<const int> block_of) {
    const int n_blocks = 1 + *std::ranges::max_element(block_of);
    std::vector<std::vector<Run>> runs(static_cast<std::size_t>(n_blocks));
    for (std::size_t k = 0; k < block_of.size(); ++k) {
        auto& of_block = runs[static_cast<std::size_t>(block_of[k])];
        if (k == 0 || block_of[k] != block_of[k - 1]) of_block.push_back({k, 0});
        ++of_block.back().size;
    }
    return runs;
}

NormalEquations equations_of(const Rows& rows, std::span<const double> r,
                             std::span<const double> weights) {
    NormalEquations made{Matrix(rows.size(), rows.size()),
                         products(rows, product_of(weights, r))};
    made.matrix.values = weighted_gram(rows, weights);
    return made;
}

/// Of a block's readings alone.
NormalEquations equations_of(const Rows& rows, const std::vector<Run>& block,
                             std::span<const double> r, std::span<const double> weights) {
    NormalEquations sum{Matrix(rows.size(), rows.size()),
                        std::vector<double>(rows.size(), 0.0)};
    for (const Run& run : block) {
        Rows part = rows;
        for (const double*& row : part) row += run.begin;
        const NormalEquations of_run = equations_of(part, r.subspan(run.begin, run.size),
                                                    weights.subspan(run.begin, run.size));
        std::ranges::transform(sum.matrix.values, of_run.matrix.values,
                               sum.matrix.values.begin(), std::plus());
        std::ranges::transform(sum.right, of_run.right, sum.right.begin(), std::plus());
    }
    return sum;
}

}  // namespace

NormalEquations normal_equations(const Matrix& derivatives, std::span<const double> r,
                                 std::span<const double> weights) {
    return equations_of(rows_of(derivatives), r, weights);
}

Bordered bordered(const Matrix& derivatives, std::span<const double> s,
                  std::span<const double> r, std::span<const double> weights) {
    Rows rows = rows_of(derivatives);
    rows.insert(rows.end(), {s.data(), r.data()});
    Bordered made{products(rows, product_of(weights, s))};
    made.with_residual = made.with_others.back();
    made.with_others.pop_back();
    made.with_itself = made.with_others.back();
    made.with_others.pop_back();
    return made;
}

Borders::Borders(const Matrix& derivatives, std::span<const double> r,
                 std::span<const double> weights)
    : weighted_(derivatives.rows + 1, derivatives.cols),
      weights_(weights.begin(), weights.end()) {
    for (std::size_t j = 0; j < weighted_.rows; ++j)
        std::ranges::copy(
            product_of(weights, j < derivatives.rows ? derivatives.row(j) : r),
            weighted_.row(j).begin());
}

std::vector<Bordered> Borders::of(const std::vector<const double*>& s) const {
    std::vector<Bordered> all(s.size());
    for (std::size_t j = 0; j < weighted_.rows; ++j) {
        const auto sums = products(s, weighted_.row(j));
        for (std::size_t k = 0; k < s.size(); ++k)
            if (j + 1 < weighted_.rows)
                all[k].with_others.push_back(sums[k]);
            else
                all[k].with_residual = sums[k];
    }
    for (std::size_t k = 0; k < s.size(); ++k)
        all[k].with_itself =
            products({s[k]}, product_of(weights_, {s[k], weights_.size()}))[0];
    return all;
}

std::vector<double> solve(const Matrix& matrix, std::span<const double> diagonal,
                          std::span<const double> right, std::span<const char> fixed) {
    const auto free = free_of(fixed);
    const Eigen::VectorXd all = view(right);
    const Eigen::VectorXd part =
        reduced(matrix, diagonal, free).ldlt().solve(Eigen::VectorXd(all(free)));
    std::vector<double> solution(right.size(), 0.0);
    for (std::size_t k = 0; k < free.size(); ++k)
        solution[static_cast<std::size_t>(free[k])] = part[static_cast<Eigen::Index>(k)];
    return solution;
}

Matrix inverse(const Matrix& matrix, std::span<const double> diagonal,
               std::span<const char> fixed) {
    const auto free = free_of(fixed);
    const Eigen::MatrixXd part = reduced(matrix, diagonal, free);
    const auto size = static_cast<Eigen::Index>(matrix.rows);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(size, size);
    const Eigen::MatrixXd solved =
        part.ldlt().solve(Eigen::MatrixXd::Identity(part.rows(), part.cols()));
    whole(free, free) = solved;
    return to_matrix(whole);
}

std::vector<double> jackknife_deviations(const Matrix& derivatives,
                                         std::span<const double> r,
                                         std::span<const double> weights,
                                         std::span<const int> block_of,
                                         std::span<const double> diagonal,
                                         std::span<const char> fixed) {
    const Rows rows = rows_of(derivatives);
    const auto free = free_of(fixed);
    const auto total = equations_of(rows, r, weights);
    const Eigen::MatrixXd A = reduced(total.matrix, diagonal, free);
    const auto blocks = runs_of(block_of);
    Eigen::MatrixXd moves(A.rows(), static_cast<Eigen::Index>(blocks.size()));
    std::vector<bool> is_told_by_one(fixed.size(), false);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const auto own = equations_of(rows, blocks[b], r, weights);
        for (std::size_t k = 0; k < fixed.size(); ++k)
            if (own.matrix(k, k) > 0.5 * total.matrix(k, k)) is_told_by_one[k] = true;
        const Eigen::MatrixXd others = A - Eigen::MatrixXd(view(own.matrix)(free, free));
        const VectorView right = view(own.right);
        moves.col(static_cast<Eigen::Index>(b)) =
            -others.ldlt().solve(Eigen::VectorXd(right(free)));
    }
    const Eigen::VectorXd squares =
        (moves.colwise() - moves.rowwise().mean()).rowwise().squaredNorm();
    const double n = static_cast<double>(blocks.size());
    std::vector<double> deviations(fixed.size(), 0.0);
    for (std::size_t k = 0; k < free.size(); ++k) {
        const auto unknown = static_cast<std::size_t>(free[k]);
        if (!is_told_by_one[unknown])
            deviations[unknown] =
                std::sqrt((n - 1) / n * squares[static_cast<Eigen::Index>(k)]);
    }
    return deviations;
}

}  // namespace bemcal::stats
