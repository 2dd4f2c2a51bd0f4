/// The points of a screening in their order, and periods made ready for the kernel.
/// Source: Joe and Kuo 2008 for the sequence.
/// What points are simulated for is left to `screening`.
#include "calibration/screening_plan.hpp"

#include "base/nan.hpp"
#include "stats/sobol_sequence.hpp"

#include <algorithm>
#include <stdexcept>

namespace bemcal::calibration {
namespace {

bool have_reading(const std::vector<kernel::Readings>& readings) {
    return std::ranges::any_of(readings, [](const kernel::Readings& meter) {
        return study::has_reading(meter.values);
    });
}

}  // namespace

ScreeningPlan::ScreeningPlan(std::string stage, const study::Case& given,
                             const ScreeningOptions& chosen, const MakePeriodModel& model)
    : name(std::move(stage)),
      building(given),
      options(chosen),
      layout{given.periods.size(), given.meters.size()} {
    for (const study::Period& period : building.periods)
        models.push_back(model(building, period));
    if (models.empty() || !have_reading(models[0]->readings()))
        throw std::invalid_argument("no meter has a reading in the first period");
}

std::size_t ScreeningPlan::n_items() const {
    return (n_points() + options.points_per_item - 1) / options.points_per_item;
}

std::size_t ScreeningPlan::size_of(std::size_t item) const {
    return std::min(options.points_per_item, n_points() - first_of(item));
}

Matrix ScreeningPlan::points(std::size_t first, std::size_t n) const {
    const std::size_t n_nominal = first == 0 && n > 0 ? 1 : 0;
    const int dimension = static_cast<int>(building.parameters.size());
    Matrix sample = study::in_ranges(
        stats::scrambled_sobol_points(first + n_nominal - 1, n - n_nominal, dimension,
                                      options.seed),
        building.parameters);
    if (n_nominal == 0) return sample;
    const std::vector<double> nominal = study::nominal_point(building.parameters);
    sample.values.insert(sample.values.begin(), nominal.begin(), nominal.end());
    sample.rows += 1;
    return sample;
}

}  // namespace bemcal::calibration
