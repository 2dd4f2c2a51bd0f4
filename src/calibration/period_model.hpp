/// A period as calibrations see it: the errors of points against meters, and a close look
/// at one of them. By our own model, or by an emulator of another program.
#pragma once

#include "study/fit.hpp"
#include "study/summary.hpp"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace bemcal::calibration {

/// Some meters of a case in a period.
struct AskedMeters {
    std::vector<std::size_t> meters;  ///< of the case
    kernel::Request request;          ///< their readings
};

/// Const means shareable: it is asked by many threads at once.
class PeriodModel {
  public:
    PeriodModel(const study::Case& building, const study::Period& period);
    virtual ~PeriodModel() = default;

    const physics::Drive& drive() const { return drive_; }
    /// Of all meters of the case.
    const std::vector<kernel::Readings>& readings() const {
        return all_.request.readings;
    }
    const AskedMeters& all() const { return all_; }
    AskedMeters some(const std::vector<std::size_t>& meters) const;

    /// Errors at points against the meters asked for. [points]
    virtual std::vector<kernel::PointAnswer> evaluate(const Matrix& points,
                                                      const AskedMeters& asked) const = 0;
    /// \param building, period  that it was made of
    virtual study::CloseLook look(const study::Case& building,
                                  const study::Period& period,
                                  std::span<const double> point,
                                  const std::vector<physics::Quantity>& hourly) const = 0;

    /// Errors of a point against some meters, as fits of that period of the case; empty
    /// where it failed.
    std::vector<study::FoundFit> fits_at(std::span<const double> point,
                                         std::size_t period,
                                         const std::vector<std::size_t>& meters) const;

  private:
    physics::Drive drive_;
    AskedMeters all_;
};

/// Makes one of a period of a building.
using MakePeriodModel = std::function<std::unique_ptr<PeriodModel>(
    const study::Case& building, const study::Period& period)>;

/// Our own model, made ready for the kernel.
std::unique_ptr<PeriodModel> own_period_model(const study::Case& building,
                                              const study::Period& period);

}  // namespace bemcal::calibration
