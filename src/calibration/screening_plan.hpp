/// What running and concluding a screening share.
#pragma once

#include "calibration/period_model.hpp"
#include "calibration/ranking.hpp"
#include "calibration/screening_options.hpp"
#include "study/points.hpp"
#include "study/stage.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::calibration {

struct ScreeningPlan {
    ScreeningPlan(std::string stage, const study::Case& building,
                  const ScreeningOptions& chosen, const MakePeriodModel& model);

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

/// The best point; empty where none succeeded.
std::vector<double> best_point_of(const ScreeningPlan& plan,
                                  const std::vector<study::ItemAnswer>& answers);

}  // namespace bemcal::calibration
