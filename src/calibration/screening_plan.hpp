/// What running and concluding a screening share.
#pragma once

#include "calibration/ranking.hpp"
#include "calibration/screening_options.hpp"
#include "study/points.hpp"
#include "study/stage.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::calibration {

/// A period made ready for the kernel.
struct PeriodModel {
    PeriodModel(const study::Case& building, const study::Period& period);
    physics::Drive drive;
    kernel::Batch batch;
    kernel::Request request;

    /// Errors of a point against some meters, as fits of that period of the case; empty
    /// where it failed.
    std::vector<study::FoundFit> fits_at(std::span<const double> point,
                                         std::size_t period,
                                         const std::vector<std::size_t>& meters) const;
};

struct ScreeningPlan {
    ScreeningPlan(std::string stage, const study::Case& building,
                  const ScreeningOptions& chosen);

    std::string name;
    study::Case building;
    ScreeningOptions options;
    std::vector<std::unique_ptr<PeriodModel>> models;  ///< one for each period
    RowLayout layout;

    std::size_t n_points() const { return options.n_points + 1; }
    std::size_t n_items() const;
    std::size_t first_of(std::size_t item) const {
        return item * options.points_per_item;
    }
    std::size_t size_of(std::size_t item) const;
    /// Points [first, first + n): 0 is the nominal building, the others are the sample.
    Matrix points(std::size_t first, std::size_t n) const;
};

study::Conclusion conclude_screening(const ScreeningPlan& plan,
                                     const std::vector<study::ItemAnswer>& answers);

}  // namespace bemcal::calibration
