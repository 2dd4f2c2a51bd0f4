/// What meters would read, as a function of the parameters, with its derivative: the
/// forward run of a group of points, and the way back (the adjoint) through it.
///
/// A caller predicts, looks at the readings of every lane, writes how strongly its
/// objective depends on each (d objective / d reading), and pulls that back to the
/// parameters: one way back for all parameters at once, so its cost does not depend on
/// their number. The derivative is exact wherever no set-point or capacity limit
/// switches; at a switch it is that of the side taken. The warm-up is part of the way.
///
/// Left out: buildings that run plain, and numbers that follow from others
/// (`has_derivatives`).
#pragma once

#include "kernel/batch.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::kernel {

/// Whether there is a way back: none for a building that runs plain, nor for one with
/// numbers that follow from others (derived.hpp).
bool has_derivatives(const physics::Building& building);

struct ResponsePlan;
struct ResponseRun;

class Response {
  public:
    /// The batch must outlive it.
    Response(const Batch& batch, std::vector<Channel> channels);
    ~Response();

    const std::vector<Channel>& channels() const;
    std::size_t n_readings(std::size_t channel) const;  ///< intervals of the period
    int lanes() const;                                  ///< points of a run
    bool is_differentiable() const;

    /// A group of points with all that the way back needs; one per thread, used again.
    using Run = ResponseRun;
    struct DeleteRun {
        void operator()(Run* run) const;
    };
    using RunPointer = std::unique_ptr<Run, DeleteRun>;
    RunPointer make_run(Way way = Way::there_and_back) const;

    /// Simulates rows [first, first + count) of points, 1 <= count <= lanes(); unused
    /// lanes repeat the last. Returns each lane's failure (empty = none).
    std::vector<std::string> predict(const Matrix& points, std::size_t first,
                                     std::size_t count, Run& run) const;
    /// [n_readings x lanes] kWh of the interval, or mean degC.
    const double* readings(const Run& run, std::size_t channel) const;
    /// [n_readings x lanes] d objective / d reading, all of it to be written by the
    /// caller before pull_back.
    double* sensitivities(Run& run, std::size_t channel) const;
    /// d objective / d parameter of the rows predicted last; NaN where a row has failed.
    /// Of two parameters that write to the same number the last one has its derivative.
    /// Allocates nothing. Throws std::logic_error where not is_differentiable(), or
    /// the run goes there alone.
    /// \param gradient  [count or more x parameters]
    void pull_back(Run& run, Matrix& gradient) const;

    using Plan = ResponsePlan;

  private:
    std::unique_ptr<Plan> plan_;
};

}  // namespace bemcal::kernel
