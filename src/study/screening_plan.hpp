/// What running and concluding a screening share.
#pragma once

#include "study/points.hpp"
#include "study/ranking.hpp"
#include "study/screening.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// A period made ready for the kernel.
struct PeriodModel {
    PeriodModel(const Case& building, const Period& period);
    physics::Drive drive;
    physics::Batch batch;
    physics::Request request;
};

struct ScreeningPlan {
    ScreeningPlan(std::string stage, const Case& building,
                  const ScreeningOptions& chosen);

    std::string name;
    Case building;
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

std::vector<Dataset> conclude_screening(const ScreeningPlan& plan,
                                        const std::vector<ItemAnswer>& answers);

}  // namespace bemcal::study
