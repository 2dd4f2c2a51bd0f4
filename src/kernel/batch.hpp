/// Thousands of points of one building at once: the fast version of simulate.hpp.
///
/// One lane = one point. The hour is reduced to affine maps and clamps (affine.hpp),
/// whose coefficients hold while the conductances and set-points hold (a "regime"); the
/// time loop (kernel.hpp, one file per instruction set) reduces while it runs. A lane's
/// bits depend on its point only: not on the lane, its neighbours, the compiler or the
/// instruction set. Zones coupled to each other, or with a radiator, are not for the
/// kernel: such buildings run plain, point by point, behind the same interface.
#pragma once

#include "base/matrix.hpp"
#include "physics/drive.hpp"
#include "physics/meters.hpp"
#include "physics/parameters.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::kernel {

enum class InstructionSet { scalar, v3, v4 };
const char* name_of(InstructionSet set);

/// Whether the building is not for the kernel.
bool runs_plain(const physics::Building& building);

bool is_supported(InstructionSet set);
/// The widest that this processor has; the environment's BEMCAL_KERNEL = scalar | v3 | v4
/// overrides. Throws std::invalid_argument for one that it does not have.
InstructionSet choose_instruction_set();

/// Readings of a meter over a period, one for each of its intervals; NaN = missing.
struct Readings {
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
    std::vector<double> values;  ///< [kWh] or [degC]
};

/// Sums over the intervals that have a reading; all that the error metrics need.
struct ErrorSums {
    double n = 0, error = 0, square = 0;                      ///< of simulated - measured
    double simulated = 0, simulated_square = 0, product = 0;  ///< product with measured
    double n_relative = 0, relative = 0;  ///< |error| / |measured| where it is not 0
};

/// What is wanted of every point.
struct Request {
    std::vector<physics::Quantity>
        annual;  ///< totals (means for temperature) over the period
    std::vector<physics::Quantity>
        monthly;                     ///< the same for each calendar month of the period
    std::vector<Readings> readings;  ///< error sums against each, at its own interval
                                     ///< and, where that is finer, also by calendar month
};

struct PointAnswer {
    std::string failure;            ///< empty = it went well
    std::vector<double> annual;     ///< [annual.size()] kWh or degC
    std::vector<double> monthly;    ///< [monthly.size() x n_months]
    std::vector<ErrorSums> errors;  ///< [readings.size()] at the reading's interval
    /// [readings.size()]; a month counts where all of its readings' intervals compared
    /// are summed.
    std::vector<ErrorSums> monthly_errors;
};

class Batch {
  public:
    /// The plan that all points share: regimes, schedule rows, segments. The building and
    /// the drive must outlive it.
    Batch(const physics::Building& nominal, std::vector<physics::Parameter> parameters,
          const physics::Drive& drive, InstructionSet set = choose_instruction_set());
    ~Batch();

    const std::vector<physics::Parameter>& parameters() const;
    int lanes() const;     ///< points that are simulated together
    int n_months() const;  ///< calendar months that the period touches

    /// \param points  [n x parameters]
    std::vector<PointAnswer> evaluate(const Matrix& points, const Request& request) const;

    /// A group of up to lanes() points on its way through time.
    struct Group;
    struct DeleteGroup {
        void operator()(Group* group) const;
    };
    using GroupPointer = std::unique_ptr<Group, DeleteGroup>;
    GroupPointer make_group() const;
    /// Groups whose points lie close to each other's: they are prepared one after the
    /// other with the buildings of one, and advance in this quantity only.
    std::vector<GroupPointer> make_groups(std::size_t n,
                                          physics::Quantity quantity) const;
    /// Coefficients and the state before the warm-up for rows [first, first + count) of
    /// points; unused lanes repeat the last. Returns each lane's failure (empty = none).
    std::vector<std::string> prepare(const Matrix& points, std::size_t first,
                                     std::size_t count, Group& group) const;
    /// Runs the group through the warm-up.
    void warm_up(Group& group) const;
    /// Steps [begin, end) of the period, in order. Writes one row of lanes() doubles for
    /// each step: the quantity's power on the meter [W], or temperature [degC].
    void advance(Group& group, int begin, int end, physics::Quantity quantity,
                 double* out) const;
    /// Mixed rows of a Sobol design, and what they are compared with: rows
    /// [steps x lanes()] of its matrices A and B, of the same base points.
    struct Mixed {
        Group* group;
        const double *a, *b;
    };
    /// The same steps of groups that nothing is written of but sums [steps x 3 x lanes()]
    /// over the groups, lane by lane: of b (y - a), y - a and (y - a)^2.
    void sum_differences(std::span<const Mixed> groups, int begin, int end,
                         physics::Quantity quantity, double* sums) const;
    /// Takes the shift [n_steps] off rows a and b [n_steps x lanes()], b in place; adds
    /// a, b and a^2 + b^2 to the sums [n_steps x 3 x lanes()].
    void add_base(const double* shift, int n_steps, const double* a, double* b,
                  double* sums) const;

    struct Plan;
    const Plan& plan() const { return *plan_; }

  private:
    std::unique_ptr<Plan> plan_;
};

}  // namespace bemcal::kernel
