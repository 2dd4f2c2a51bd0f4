/// What meters would read, as a function of the parameters, with the way back to these:
/// by our own model of a building, or by an emulator of another program's.
///
/// A caller predicts a group of points, looks at the readings of every lane, writes how
/// strongly its objective depends on each, and pulls that back to the parameters.
#pragma once

#include "base/matrix.hpp"
#include "study/case.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::posterior {

class MeterResponse {
  public:
    /// A group of points with all that the way back needs; one per thread, used again.
    class Run {
      public:
        virtual ~Run() = default;
    };

    virtual ~MeterResponse() = default;
    virtual int lanes() const = 0;  ///< points of a run
    virtual std::unique_ptr<Run> make_run() const = 0;
    /// Answers rows [first, first + count) of points, 1 <= count <= lanes(); unused lanes
    /// repeat the last. Returns each row's failure (empty = none).
    virtual std::vector<std::string> predict(const Matrix& points, std::size_t first,
                                             std::size_t count, Run& run) const = 0;
    /// [n_readings x lanes] kWh of the interval, or mean degC.
    virtual const double* readings(const Run& run, std::size_t meter) const = 0;
    /// [n_readings x lanes] d objective / d reading, all of it to be written by the
    /// caller before pull_back.
    virtual double* sensitivities(Run& run, std::size_t meter) const = 0;
    /// d objective / d parameter of the rows predicted last.
    /// \param gradient  [count x parameters]
    virtual void pull_back(Run& run, Matrix& gradient) const = 0;
};

/// Makes them, for any period of a building.
class ResponseSource {
  public:
    virtual ~ResponseSource() = default;
    /// \param meters  of the building, rising. The building must outlive what is made.
    virtual std::unique_ptr<MeterResponse> response(
        const study::Case& building, const study::Period& period,
        std::span<const std::size_t> meters) const = 0;
    /// So many of the parameters, the last ones, are errors of its own, not numbers of
    /// the building: they are drawn with the others, and not reported.
    virtual std::size_t n_errors() const { return 0; }
};

/// Our own model, simulated.
std::shared_ptr<const ResponseSource> own_model();

}  // namespace bemcal::posterior
