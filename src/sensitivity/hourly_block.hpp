/// A block of base points of an hourly Sobol design, taken through time together.
///
/// Chunk by chunk of steps: the rows of A and B are written, then input by input the
/// mixed rows of all companies run and add their differences while the sums are in the
/// first-level cache. Memory does not depend on the number of base points: a block takes
/// them a visit at a time.
#pragma once

#include "kernel/batch.hpp"
#include "sensitivity/hourly_sums.hpp"
#include "study/stage.hpp"

namespace bemcal::sensitivity {

/// Sixteen base points with every row of their design.
class Company {
  public:
    Company(const kernel::Batch& batch, physics::Quantity quantity);

    /// Up to sixteen base points. One that fails in any row counts as none.
    /// \param design  rows as saltelli_points, in the ranges
    /// \param first_row  of the whole design, for the failures \return points used
    std::size_t prepare(const Matrix& design, std::size_t first_row,
                        std::vector<study::Failure>& failures);
    void warm_up();
    /// Rows A and B of steps [begin, begin + n), shifted; adds them to the sums.
    void add_base(std::size_t begin, std::size_t n, const double* shift, LaneSums& sums);
    /// Group k of the rows of input i, against the chunk of add_base.
    kernel::Batch::Mixed mixed(std::size_t i, std::size_t k) const {
        return {rows_[1 + i][k].get(), a_[k].data(), b_[k].data()};
    }

  private:
    using Groups = std::vector<kernel::Batch::GroupPointer>;
    std::vector<std::string> prepare_row(std::size_t row, const Matrix& points);
    std::vector<bool> prepare_rows(const std::vector<Matrix>& points,
                                   std::size_t first_row,
                                   std::vector<study::Failure>& failures);

    const kernel::Batch* batch_;
    physics::Quantity quantity_;
    std::vector<Groups> rows_;      ///< [row of the design][group]
    std::vector<LaneArray> a_, b_;  ///< [group] of a chunk
};

class Block {
  public:
    Block(const kernel::Batch& batch, physics::Quantity quantity, std::size_t n_steps);

    static std::size_t most_points();  ///< base points of a visit
    /// Adds up to most_points() base points. \param design  as Company::prepare's
    void add(const Matrix& design, std::size_t first_row,
             std::vector<study::Failure>& failures);

    const std::string& error() const { return error_; }
    std::size_t n_used() const { return n_used_; }
    std::vector<double> sums() const { return sums_.values(); }
    /// [n_steps] the nominal trajectory
    const std::vector<double>& shift() const { return shift_; }

  private:
    void make_shift(std::size_t n_steps);
    void run(std::size_t n_companies);
    void run_chunk(std::size_t begin, std::size_t n, std::span<Company> companies);

    const kernel::Batch& batch_;
    physics::Quantity quantity_;
    std::vector<double> shift_;
    HourlySums sums_;
    LaneSums of_chunk_;
    std::vector<Company> companies_;
    std::vector<kernel::Batch::Mixed> mixed_;  ///< scratch
    std::string error_;
    std::size_t n_used_ = 0;
};

}  // namespace bemcal::sensitivity
