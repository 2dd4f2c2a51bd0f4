/// Sums over base points that hourly Sobol indices are made of, step by step.
///
/// Sixteen base points go through time together (a row of 16 values for each step: four
/// quads); their order of summation is written out, so that the bits depend on no
/// compiler, lane count or instruction set. Outputs are shifted by a nominal trajectory:
/// sums stay well conditioned, and a base point that is nominal in every row adds exactly
/// nothing.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::study {

constexpr std::size_t sixteen = 16;

/// Rows of 16 values: side by side (width 16), or two tables of rows of 8 (width 8).
struct Rows {
    double* first = nullptr;
    std::size_t width = sixteen;
    std::size_t to_second = 0;  ///< from one table to the other [doubles]
};

/// Sums over base points, for every step of a period; a row for each term.
class HourlySums {
  public:
    HourlySums(std::size_t dimension, std::size_t n_steps);

    std::size_t dimension() const { return dimension_; }
    std::size_t n_steps() const { return n_steps_; }

    /// Steps from `begin` on: a and b, first shifted: a sums; b is left shifted in place.
    void add_base(std::size_t begin, std::size_t n, const Rows& a, const Rows& b,
                  const double* shift);
    /// The same steps of input i: ab against a, with the shifted b.
    void add_mixed(std::size_t begin, std::size_t n, std::size_t i, const Rows& a,
                   const Rows& b, const Rows& ab);

    /// [n_steps x terms]: sum of a, of b, of a^2 + b^2, then for each i of b (ab_i - a),
    /// of ab_i - a, and of (ab_i - a)^2.
    std::vector<double> values() const;
    static std::size_t n_terms(std::size_t dimension) { return 3 + 3 * dimension; }

  private:
    double* term(std::size_t row, std::size_t step) {
        return sums_.data() + row * padded_ + step;
    }

    std::size_t dimension_, n_steps_, padded_;
    bool with_avx2_;
    std::vector<double> sums_;  ///< [n_terms x padded_]: steps rounded up to whole fours
};

/// What the sums of one step say, relative to the variance.
struct StepEstimate {
    double mean = 0;            ///< over the design, less the shift
    double variance = 0;        ///< over the rows A and B
    std::vector<double> parts;  ///< [2 d] S1 variance for each input, then ST variance
};
/// \param sums  the terms of a step   \param n  base points in them
StepEstimate estimate(std::span<const double> sums, double n);

}  // namespace bemcal::study
