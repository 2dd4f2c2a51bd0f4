/// Hands a plan from rank to rank as a conclusion's datasets, packed.
/// Follows from `study::pack`.
/// What an item does with its part is left to the loop.
#include "loop/simulator_plan.hpp"

#include "loop/stored_simulator.hpp"
#include "study/datasets.hpp"
#include "study/packed_conclusion.hpp"

#include <iterator>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

constexpr const char* plan_group = "plan";

Matrix matrix_in(const std::vector<study::Dataset>& datasets, const std::string& path) {
    const study::Dataset* found = study::find_dataset(datasets, path);
    if (found == nullptr) return {};
    Matrix matrix(found->shape[0], found->shape[1]);
    matrix.values = found->values;
    return matrix;
}

}  // namespace

std::vector<study::Dataset> datasets_of(const std::string& group,
                                        const std::vector<study::GivenEffect>& effects) {
    StoredSimulator stored;
    add_given(effects, std::vector<double>(effects.size(), 1.0), stored);
    return datasets_of(group, stored);
}

std::vector<study::GivenEffect> effects_in(const std::vector<study::Dataset>& datasets,
                                           const std::string& group) {
    return given_in(stored_simulator(datasets, group));
}

std::vector<double> pack(const SimulatorPlan& plan) {
    study::DatasetBuilder datasets(plan_group);
    const auto add = [&](const char* leaf, const Matrix& matrix) {
        datasets.array(leaf, {"item", "column"}, {matrix.rows, matrix.cols},
                       matrix.values);
    };
    add("points", plan.points);
    add("scales", plan.scales);
    Matrix searched(plan.searched.size(), plan.is_search() ? plan.searched[0].size() : 0);
    searched.values.clear();
    for (const auto& channel : plan.searched)
        searched.values.insert(searched.values.end(), channel.begin(), channel.end());
    add("searched", searched);
    datasets.vector("is_of_others", "plan", {plan.is_of_others ? 1.0 : 0.0});
    study::Conclusion all{datasets.take()};
    std::ranges::move(datasets_of(plan_group, plan.effects),
                      std::back_inserter(all.datasets));
    return study::pack(all);
}

SimulatorPlan unpack_plan(std::span<const double> packed) {
    const auto datasets = study::unpack_conclusion(packed).datasets;
    const auto at = [](const char* leaf) {
        return fmt::format("{}/{}", plan_group, leaf);
    };
    SimulatorPlan plan{matrix_in(datasets, at("points")),
                       matrix_in(datasets, at("scales")),
                       effects_in(datasets, plan_group),
                       {},
                       study::find_dataset(datasets, at("is_of_others"))->values[0] != 0};
    const Matrix searched = matrix_in(datasets, at("searched"));
    for (std::size_t c = 0; c < searched.rows; ++c)
        plan.searched.emplace_back(searched.row(c).begin(), searched.row(c).end());
    return plan;
}

}  // namespace bemcal::loop
