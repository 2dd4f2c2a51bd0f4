/// What the items of a round of a loop around another program do: runs at points, with
/// effects at a scale each; or the search in the residual of one of them.
#pragma once

#include "base/matrix.hpp"
#include "study/hourly_simulator.hpp"
#include "study/stage.hpp"

#include <span>
#include <vector>

namespace bemcal::loop {

struct SimulatorPlan {
    Matrix points;  ///< [items x parameters] on the scale 0 to 1
    Matrix scales;  ///< [items x effects]; 0 = without it, 1 = as it was found
    std::vector<study::GivenEffect> effects;
    /// Of the run whose residual is searched [channels][hours]; then there is one item.
    std::vector<std::vector<double>> searched;

    /// The runs are of the periods beside training, at points that were run for it.
    bool is_of_others = false;

    bool is_search() const { return !searched.empty(); }
    int n_items() const { return is_search() ? 1 : static_cast<int>(points.rows); }
};

/// As numbers, which every rank is handed.
std::vector<double> pack(const SimulatorPlan& plan);
SimulatorPlan unpack_plan(std::span<const double> packed);

/// The effects as datasets under a group, and back.
std::vector<study::Dataset> datasets_of(const std::string& group,
                                        const std::vector<study::GivenEffect>& effects);
std::vector<study::GivenEffect> effects_in(const std::vector<study::Dataset>& datasets,
                                           const std::string& group);

}  // namespace bemcal::loop
