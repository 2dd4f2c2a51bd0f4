/// Our own model over a period, and what all models of a period share.
/// Follows from the kernel's batch and its requests; a close look is the plain
/// simulation. Which points are asked for is the calibrations' own.
#include "calibration/period_model.hpp"

#include "base/nan.hpp"

#include <numeric>

namespace bemcal::calibration {
namespace {

AskedMeters all_meters(const study::Case& building, const study::Period& period) {
    AskedMeters all{std::vector<std::size_t>(building.meters.size()),
                    {{}, {}, study::readings_of(building, period)}};
    std::iota(all.meters.begin(), all.meters.end(), std::size_t{0});
    return all;
}

class OwnPeriodModel : public PeriodModel {
  public:
    OwnPeriodModel(const study::Case& building, const study::Period& period)
        : PeriodModel(building, period),
          batch_(building.building, building.parameters, drive()) {}

    std::vector<kernel::PointAnswer> evaluate(const Matrix& points,
                                              const AskedMeters& asked) const override {
        return batch_.evaluate(points, asked.request);
    }
    study::CloseLook look(const study::Case& building, const study::Period& period,
                          std::span<const double> point,
                          const std::vector<physics::Quantity>& hourly) const override {
        return study::look_closely(building, period, drive(), point, hourly);
    }

  private:
    kernel::Batch batch_;
};

}  // namespace

PeriodModel::PeriodModel(const study::Case& building, const study::Period& period)
    : drive_(study::drive_of(building, period)), all_(all_meters(building, period)) {}

AskedMeters PeriodModel::some(const std::vector<std::size_t>& meters) const {
    AskedMeters asked{meters, {}};
    for (const std::size_t m : meters) asked.request.readings.push_back(readings()[m]);
    return asked;
}

std::vector<study::FoundFit> PeriodModel::fits_at(
    std::span<const double> point, std::size_t period,
    const std::vector<std::size_t>& meters) const {
    Matrix points(0, point.size());
    points.add_row(point);
    const kernel::PointAnswer answer = evaluate(points, all_).at(0);
    std::vector<study::FoundFit> fits;
    for (const std::size_t m : meters) {
        if (!answer.failure.empty()) break;
        const stats::FitMetrics own =
            study::fit_of(readings()[m], answer.errors[m], answer.monthly_errors[m]).own;
        fits.push_back({period, m, nan, own.cv_rmse, own.nmbe});
    }
    return fits;
}

std::unique_ptr<PeriodModel> own_period_model(const study::Case& building,
                                              const study::Period& period) {
    return std::make_unique<OwnPeriodModel>(building, period);
}

}  // namespace bemcal::calibration
