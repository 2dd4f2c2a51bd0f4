/// Linear least squares with a normal prior: normal equations by `sums`; solution,
/// inverse, and a jackknife whose blocks are cut from the same sums, by Eigen.
/// Source: textbook; jackknife: Kuensch 1989, one linear step for each block. Left out:
/// iterations and bounds (unknowns are only held fixed). Normal equations square the
/// condition.
#include "stats/least_squares.hpp"

#include "stats/sums.hpp"

#include <algorithm>
#include <cmath>

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
    Eigen::Index begin, size;
};

std::vector<std::vector<Run>> runs_of(std::span<const int> block_of) {
    const int n_blocks = 1 + *std::ranges::max_element(block_of);
    std::vector<std::vector<Run>> runs(static_cast<std::size_t>(n_blocks));
    for (std::size_t k = 0; k < block_of.size(); ++k) {
        auto& of_block = runs[static_cast<std::size_t>(block_of[k])];
        if (k == 0 || block_of[k] != block_of[k - 1])
            of_block.push_back({static_cast<Eigen::Index>(k), 0});
        ++of_block.back().size;
    }
    return runs;
}

}  // namespace

NormalEquations normal_equations(const Matrix& derivatives, std::span<const double> r,
                                 std::span<const double> weights) {
    const Rows rows = rows_of(derivatives);
    NormalEquations made{Matrix(rows.size(), rows.size()),
                         products(rows, product_of(weights, r))};
    made.matrix.values = weighted_gram(rows, weights);
    return made;
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
    const View J = view(derivatives);
    const auto free = free_of(fixed);
    const auto total = normal_equations(derivatives, r, weights);
    const Eigen::MatrixXd A = reduced(total.matrix, diagonal, free);
    const auto blocks = runs_of(block_of);
    const auto n_blocks = static_cast<Eigen::Index>(blocks.size());
    Eigen::MatrixXd moves(A.rows(), n_blocks);
    std::vector<bool> is_told_by_one(fixed.size(), false);
    for (Eigen::Index b = 0; b < n_blocks; ++b) {
        Eigen::MatrixXd A_b = Eigen::MatrixXd::Zero(J.rows(), J.rows());
        Eigen::VectorXd g_b = Eigen::VectorXd::Zero(J.rows());
        for (const Run& run : blocks[static_cast<std::size_t>(b)]) {
            const auto part = J.middleCols(run.begin, run.size);
            const auto w = view(weights).segment(run.begin, run.size);
            const RowMajor scaled = part * w.cwiseSqrt().asDiagonal();
            A_b.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
            g_b += part * w.cwiseProduct(view(r).segment(run.begin, run.size));
        }
        A_b = Eigen::MatrixXd(A_b.selfadjointView<Eigen::Lower>());
        for (std::size_t k = 0; k < fixed.size(); ++k)
            if (A_b.diagonal()[static_cast<Eigen::Index>(k)] > 0.5 * total.matrix(k, k))
                is_told_by_one[k] = true;
        const Eigen::MatrixXd others = A - Eigen::MatrixXd(A_b(free, free));
        moves.col(b) = -others.ldlt().solve(Eigen::VectorXd(g_b(free)));
    }
    const Eigen::VectorXd squares =
        (moves.colwise() - moves.rowwise().mean()).rowwise().squaredNorm();
    const double n = static_cast<double>(n_blocks);
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
