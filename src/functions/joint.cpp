/// Type-II maximum likelihood of variances, one pair after the other: given all others, a
/// pair's evidence is a function of its variance alone, by eigenvalues.
/// Source: MacKay 1992 (Bayesian interpolation), Tipping and Faul 2003 (fast marginal
/// likelihood); Vehtari and others 2017 for the score of what was left out.
/// Huber 1967 for the scatter of scores: errors of neighbouring hours are alike, and more
/// so for what follows the season than for what follows the hour. How much the scores of
/// a pair scatter from block to block, over what independent errors would, divides its
/// evidence. Twins are not grouped.
#include "functions/joint.hpp"

#include "functions/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace bemcal::functions {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

using decisions::least_precision, decisions::least_scatter;
using decisions::least_variance, decisions::most_variance;

/// A pair with its columns, and their products with all that have been asked for.
struct Block {
    std::size_t id = 0;
    double log_odds = 0;
    MatrixXf columns;
    double variance = 0;
    double evidence = 0;
    double scatter = 1;
    VectorXd with_residual{};
    std::map<const Block*, MatrixXd> with{};

    const MatrixXd& product_with(const Block& other) {
        MatrixXd& product = with[&other];
        if (product.size() == 0)
            product = (columns.transpose() * other.columns).cast<double>();
        return product;
    }
};

std::vector<MatrixXd> products(const WeighedData& data, const MatrixXf& a,
                               const MatrixXf& b) {
    std::vector<MatrixXd> by_fold;
    by_fold.assign(data.n_folds(), MatrixXd::Zero(a.cols(), b.cols()));
    if (a.cols() == 0 || b.cols() == 0) return by_fold;
    for (std::size_t block = 0; block < data.fold.size(); ++block) {
        const long from = data.first_row[block], n = data.first_row[block + 1] - from;
        by_fold[data.fold[block]] +=
            (a.middleRows(from, n).transpose() * b.middleRows(from, n)).cast<double>();
    }
    return by_fold;
}

/// [columns x blocks] products with what the model leaves.
MatrixXd scores_of(const WeighedData& data, const MatrixXf& columns) {
    MatrixXd scores(columns.cols(), static_cast<long>(data.fold.size()));
    if (columns.cols() == 0) return scores;
    for (std::size_t block = 0; block < data.fold.size(); ++block) {
        const long from = data.first_row[block], n = data.first_row[block + 1] - from;
        scores.col(static_cast<long>(block)) =
            (columns.middleRows(from, n).transpose() * data.left.segment(from, n))
                .cast<double>();
    }
    return scores;
}

MatrixXd sum(const std::vector<MatrixXd>& by_fold) {
    MatrixXd all = by_fold[0];
    for (std::size_t f = 1; f < by_fold.size(); ++f) all += by_fold[f];
    return all;
}

/// A pair seen from all others: A and z of its coefficients with the others integrated
/// out, as eigenvalues.
struct Spectrum {
    VectorXd values;  ///< of A
    VectorXd right;   ///< z in A's eigenvectors
    double scatter = 1;

    double log_evidence(double variance) const {
        double sum = 0;
        for (long k = 0; k < values.size(); ++k) {
            const double d = std::max(values[k], 0.0) / scatter * variance;
            const double z = right[k] / scatter;
            sum += z * z * variance / (1 + d) - std::log1p(d);
        }
        return 0.5 * sum;
    }
};

struct Best {
    double variance = 0, evidence = 0;
};

/// On a grid of half decades, then by golden steps between.
Best best_variance(const Spectrum& spectrum) {
    Best best;
    const auto consider = [&](double variance) {
        const double evidence = spectrum.log_evidence(variance);
        if (evidence > best.evidence) best = {variance, evidence};
    };
    for (double log = std::log10(least_variance); log <= std::log10(most_variance) + 1e-9;
         log += 0.25)
        consider(std::pow(10, log));
    if (best.evidence <= 0) return best;
    for (double step = 0.125; step > 0.01; step /= 2) {
        const double at = std::log10(best.variance);
        consider(std::min(std::pow(10, at + step), most_variance));
        consider(std::pow(10, at - step));
    }
    return best;
}

using Folds = std::vector<char>;  ///< [folds] 1 = in

/// The active set: parameters first, then the columns of each pair that has joined.
class Model {
  public:
    explicit Model(const WeighedData& data) : data_(data) {
        parameters_.columns = data.parameters;
        joined_.push_back(&parameters_);
        scores_ = scores_of(data, data.parameters);
        grams_.emplace_back();
        grams_[0].push_back(products(data, data.parameters, data.parameters));
        rights_.push_back(products(data, data.parameters, data.residual));
    }

    std::size_t n_joined() const { return joined_.size() - 1; }
    Block& joined(std::size_t k) { return *joined_[k + 1]; }

    void join(Block& block) {
        std::vector<std::vector<MatrixXd>> row;
        row.reserve(joined_.size() + 1);
        for (Block* other : joined_)
            row.push_back(products(data_, block.columns, other->columns));
        row.push_back(products(data_, block.columns, block.columns));
        grams_.push_back(std::move(row));
        rights_.push_back(products(data_, block.columns, data_.residual));
        joined_.push_back(&block);
    }

    void leave(std::size_t k) {
        const auto at = static_cast<long>(k + 1);
        joined_.erase(joined_.begin() + at);
        rights_.erase(rights_.begin() + at);
        grams_.erase(grams_.begin() + at);
        for (std::size_t row = k + 1; row < grams_.size(); ++row)
            grams_[row].erase(grams_[row].begin() + at);
    }

    /// Of the folds that are in, without block `without` (0 = with all).
    struct Equations {
        MatrixXd matrix;  ///< with priors
        VectorXd right;
    };
    Equations equations(const Folds& in, std::size_t without = 0) const {
        std::vector<long> first{0};
        for (std::size_t k = 0; k < joined_.size(); ++k)
            first.push_back(first.back() +
                            (k > 0 && k == without ? 0 : joined_[k]->columns.cols()));
        Equations all{MatrixXd::Zero(first.back(), first.back()),
                      VectorXd::Zero(first.back())};
        for (std::size_t i = 0; i < joined_.size(); ++i) {
            if (i > 0 && i == without) continue;
            const long n_i = joined_[i]->columns.cols();
            all.right.segment(first[i], n_i) = total(rights_[i], in);
            for (std::size_t j = 0; j <= i; ++j) {
                if (j > 0 && j == without) continue;
                const long n_j = joined_[j]->columns.cols();
                const MatrixXd part = total(grams_[i][j], in);
                all.matrix.block(first[i], first[j], n_i, n_j) = part;
                all.matrix.block(first[j], first[i], n_j, n_i) = part.transpose();
            }
            for (long k = 0; k < n_i; ++k) {
                const double precision =
                    i == 0 ? std::max(data_.precision[k], least_precision) +
                                 precision_of_range()
                           : joined_[i]->scatter / joined_[i]->variance;
                all.matrix(first[i] + k, first[i] + k) += precision;
                if (i == 0) all.right[k] -= data_.precision[k] * data_.at[k];
            }
        }
        return all;
    }

    /// The k-th that has joined, as all others see it.
    Spectrum spectrum_of_joined(std::size_t k) const {
        const std::size_t own = k + 1;
        const Equations others = equations(all_folds(), own);
        MatrixXd with(joined_[own]->columns.cols(), others.matrix.cols());
        long at = 0;
        for (std::size_t j = 0; j < joined_.size(); ++j) {
            if (j == own) continue;
            const long n = joined_[j]->columns.cols();
            with.middleCols(at, n) =
                j < own ? sum(grams_[own][j]) : MatrixXd(sum(grams_[j][own]).transpose());
            at += n;
        }
        const Eigen::LLT<MatrixXd> llt(others.matrix);
        Spectrum seen = spectrum(sum(grams_[own][own]), sum(rights_[own]), with, llt,
                                 llt.matrixL().solve(others.right));
        seen.scatter = joined_[own]->scatter;
        return seen;
    }

    /// Over what independent errors of the weights' size would scatter: the mean over the
    /// directions of a pair's columns, parameters taken off.
    double scatter_of(Block& block) const {
        const MatrixXd& with = block.product_with(parameters_);
        MatrixXd information = sum(grams_[0][0]);
        for (long k = 0; k < information.rows(); ++k)
            information(k, k) += std::max(data_.precision[k], least_precision);
        const Eigen::LLT<MatrixXd> llt(information);
        MatrixXd scores = scores_of(data_, block.columns) - with * llt.solve(scores_);
        // What acts alike in all blocks is no scatter.
        scores.colwise() -= VectorXd(scores.rowwise().mean());
        const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(
            block.product_with(block) - with * llt.solve(with.transpose()));
        const MatrixXd turned = solver.eigenvectors().transpose() * scores;
        double squares = 0, n = 0;
        const double least = 1e-4 * solver.eigenvalues().maxCoeff();
        for (long k = 0; k < turned.rows(); ++k) {
            if (solver.eigenvalues()[k] <= least) continue;
            squares += turned.row(k).squaredNorm();
            n += solver.eigenvalues()[k];
        }
        return n > 0 ? std::max(squares / n, least_scatter) : 1;
    }

    /// All that have joined, for those that have not.
    struct Others {
        Eigen::LLT<MatrixXd> llt;
        VectorXd half_right;
    };
    Others others() const {
        const Equations all = equations(all_folds());
        Others others{Eigen::LLT<MatrixXd>(all.matrix), {}};
        others.half_right = others.llt.matrixL().solve(all.right);
        return others;
    }
    Spectrum spectrum_of(Block& block, const Others& others) const {
        MatrixXd with(block.columns.cols(), others.half_right.size());
        long at = 0;
        for (const Block* other : joined_) {
            with.middleCols(at, other->columns.cols()) = block.product_with(*other);
            at += other->columns.cols();
        }
        if (block.with_residual.size() == 0)
            block.with_residual =
                (block.columns.transpose() * data_.residual).cast<double>();
        Spectrum seen = spectrum(block.product_with(block), block.with_residual, with,
                                 others.llt, others.half_right);
        seen.scatter = block.scatter;
        return seen;
    }

    /// All variances anew, given the others, in turn; those that are nothing leave.
    void settle() {
        for (int sweep = 0; sweep < decisions::variance_sweeps; ++sweep)
            for (std::size_t k = n_joined(); k-- > 0;) {
                const Best best = best_variance(spectrum_of_joined(k));
                joined(k).variance = best.variance;
                joined(k).evidence = best.evidence;
                if (best.evidence <= 0) leave(k);
            }
    }

    /// Fall of the weighed squares of folds that were left out, next to none.
    double score() const {
        double fall = 0;
        for (std::size_t f = 0; f < data_.n_folds(); ++f) {
            Folds in = all_folds();
            in[f] = 0;
            const Equations without = equations(in);
            const VectorXd beta = without.matrix.llt().solve(without.right);
            long at = 0;
            for (std::size_t i = 0; i < joined_.size(); ++i) {
                const long n_i = joined_[i]->columns.cols();
                const auto own = beta.segment(at, n_i);
                fall += 2 * own.dot(VectorXd(rights_[i][f]));
                long other_at = 0;
                for (std::size_t j = 0; j <= i; ++j) {
                    const long n_j = joined_[j]->columns.cols();
                    fall -= (i == j ? 1 : 2) *
                            own.dot(grams_[i][j][f] * beta.segment(other_at, n_j));
                    other_at += n_j;
                }
                at += n_i;
            }
        }
        return fall;
    }

    Folds all_folds() const { return Folds(data_.n_folds(), 1); }

    Stage stage() const {
        Stage stage{fit(all_folds()), {}};
        for (std::size_t half = 0; half < 2; ++half) {
            Folds in = all_folds();
            for (std::size_t f = half; f < in.size(); f += 2) in[f] = 0;
            stage.halves[half] = fit(in);
        }
        return stage;
    }

    JointFit fit(const Folds& in) const {
        const Equations all = equations(in);
        const Eigen::LLT<MatrixXd> llt(all.matrix);
        const VectorXd beta = llt.solve(all.right);
        JointFit fit;
        fit.parameters = beta.head(parameters_.columns.cols());
        long at = parameters_.columns.cols();
        for (std::size_t k = 1; k < joined_.size(); ++k) {
            const long n = joined_[k]->columns.cols();
            const MatrixXd own = MatrixXd::Identity(beta.size(), n + at).rightCols(n);
            fit.functions.push_back(
                {joined_[k]->id, joined_[k]->variance, joined_[k]->scatter,
                 beta.segment(at, n), joined_[k]->evidence,
                 joined_[k]->scatter * llt.solve(own).middleRows(at, n)});
            at += n;
        }
        return fit;
    }

  private:
    static Spectrum spectrum(const MatrixXd& own, const VectorXd& right,
                             const MatrixXd& with_others, const Eigen::LLT<MatrixXd>& llt,
                             const VectorXd& half_right) {
        const MatrixXd half = llt.matrixL().solve(with_others.transpose());
        const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(own -
                                                             half.transpose() * half);
        return {solver.eigenvalues(), solver.eigenvectors().transpose() *
                                          (right - half.transpose() * half_right)};
    }

    double precision_of_range() const {
        return data_.linear_range > 0 ? 1 / (data_.linear_range * data_.linear_range) : 0;
    }

    static MatrixXd total(const std::vector<MatrixXd>& by_fold, const Folds& in) {
        MatrixXd all = MatrixXd::Zero(by_fold[0].rows(), by_fold[0].cols());
        for (std::size_t f = 0; f < by_fold.size(); ++f)
            if (in[f] != 0) all += by_fold[f];
        return all;
    }

    const WeighedData& data_;
    Block parameters_;
    MatrixXd scores_;  ///< [parameters x blocks]
    std::vector<Block*> joined_;
    std::vector<std::vector<std::vector<MatrixXd>>> grams_;  ///< [i][j <= i][fold]
    std::vector<std::vector<MatrixXd>> rights_;              ///< [i][fold]
};

/// Pairs that bring more than is asked of them, seen from the parameters alone; only the
/// most promising, so that few columns are held at once.
std::vector<std::unique_ptr<Block>> promising(const Model& model,
                                              const std::vector<Pair>& pairs,
                                              const ColumnsOf& columns_of,
                                              const std::vector<There>& there,
                                              std::size_t most) {
    const Model::Others others = model.others();
    const auto beyond = [](const auto& block) {
        return block->evidence - block->log_odds;
    };
    std::vector<std::unique_ptr<Block>> blocks;
    for (const Pair& pair : pairs) {
        if (std::ranges::find(there, pair.id, &There::id) != there.end()) continue;
        auto block = std::make_unique<Block>();
        block->id = pair.id, block->log_odds = pair.log_odds;
        block->columns = columns_of(pair.id);
        block->scatter = model.scatter_of(*block);
        block->evidence = best_variance(model.spectrum_of(*block, others)).evidence;
        if (beyond(block) <= 0) continue;
        blocks.push_back(std::move(block));
        if (blocks.size() > most)
            blocks.erase(std::ranges::min_element(blocks, {}, beyond));
    }
    return blocks;
}

/// The one that brings most beyond what is asked of it, with its best variance; nullptr:
/// none does.
Block* best_of(const Model& model, const std::vector<std::unique_ptr<Block>>& blocks,
               const std::vector<Block*>& judged) {
    const Model::Others others = model.others();
    Block* next = nullptr;
    double most = 0;
    for (const auto& block : blocks) {
        if (std::ranges::find(judged, block.get()) != judged.end()) continue;
        const Best best = best_variance(model.spectrum_of(*block, others));
        block->variance = best.variance;
        block->evidence = best.evidence;
        if (best.evidence - block->log_odds <= most) continue;
        most = best.evidence - block->log_odds;
        next = block.get();
    }
    return next;
}

}  // namespace

std::size_t WeighedData::n_folds() const {
    return fold.empty() ? 0 : *std::ranges::max_element(fold) + 1;
}

Path search_functions(const WeighedData& data, const std::vector<Pair>& pairs,
                      const ColumnsOf& columns_of, const std::vector<There>& there,
                      const SearchOptions& options) {
    Model model(data);
    std::vector<std::unique_ptr<Block>> first;
    for (const There& one : there) {
        first.push_back(std::make_unique<Block>());
        Block& block = *first.back();
        block.id = one.id, block.variance = one.variance, block.scatter = one.scatter;
        block.columns = columns_of(one.id);
        model.join(block);
    }
    if (!first.empty()) model.settle();
    const auto blocks =
        promising(model, pairs, columns_of, there, options.most_candidates);
    std::vector<Block*> judged;
    Path path;
    path.stages.push_back(model.stage());
    double score = model.score();
    while (model.n_joined() < options.most_functions) {
        Block* next = best_of(model, blocks, judged);
        if (next == nullptr) break;
        judged.push_back(next);
        model.join(*next);
        const double with = model.score();
        if (with > score) {
            model.settle();
            score = model.score();
            path.stages.push_back(model.stage());
        } else {
            model.leave(model.n_joined() - 1);
        }
    }
    return path;
}

}  // namespace bemcal::functions
