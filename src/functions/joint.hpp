/// All functions and parameters of a building together: a linear model of its readings in
/// which each function has a variance of its own, found by the marginal likelihood.
#pragma once

#include "functions/decisions.hpp"

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Dense>

namespace bemcal::functions {

/// Readings and what moves them, each divided by its standard deviation, block by block.
struct WeighedData {
    std::vector<long> first_row;    ///< [blocks + 1]
    std::vector<std::size_t> fold;  ///< [blocks] that is left out together
    Eigen::VectorXf residual;       ///< [readings] of the model without functions
    Eigen::VectorXf left;           ///< [readings] of the model that stands
    Eigen::MatrixXf parameters;     ///< [readings x parameters] its derivatives
    Eigen::VectorXd precision;      ///< [parameters] of their priors; 0 = none
    Eigen::VectorXd at;             ///< [parameters] where they are, in prior sd
    /// How far the model is nearly linear in a parameter [prior sd]: moves are as if
    /// drawn around 0 with this standard deviation. 0 = everywhere.
    double linear_range = 0;

    std::size_t n_folds() const;
};

/// A hook with a driver.
struct Pair {
    std::size_t id = 0;
    double log_odds = 0;  ///< of its prior: what evidence it must bring beyond 0
};

/// Columns of a pair, in the rows and weights of WeighedData. [readings x columns]
using ColumnsOf = std::function<Eigen::MatrixXf(std::size_t id)>;

struct FunctionFit {
    std::size_t id = 0;
    double variance = 0;           ///< of its coefficients
    double scatter = 1;            ///< of its scores (joint.cpp)
    Eigen::VectorXd mean;          ///< of its coefficients
    double evidence = 0;           ///< log marginal likelihood that it brings
    Eigen::MatrixXd covariance{};  ///< of its coefficients
};

struct JointFit {
    std::vector<FunctionFit> functions;
    Eigen::VectorXd parameters;  ///< [parameters] by how much they move
};

/// The model after a pair has joined: fitted to all folds, and to either half of them:
/// `halves[h]` has not seen the folds of which the number is 2 k + h.
struct Stage {
    JointFit all;
    std::array<JointFit, 2> halves;
};

/// How the search went.
struct Path {
    std::vector<Stage> stages;  ///< the first has the functions that were there
};

struct SearchOptions {
    std::size_t most_functions = decisions::most_functions;
    /// Kept in memory after the first pass.
    std::size_t most_candidates = decisions::most_candidates;
};

/// A pair that is in the model from the beginning, as an earlier search left it.
struct There {
    std::size_t id = 0;
    double variance = 0, scatter = 1;
};

/// Pairs join those that are there while the best of the rest brings more evidence than
/// its prior odds ask for, and foretells folds that it has not seen; variances are found
/// again after each.
Path search_functions(const WeighedData& data, const std::vector<Pair>& pairs,
                      const ColumnsOf& columns_of, const std::vector<There>& there = {},
                      const SearchOptions& options = {});

}  // namespace bemcal::functions
