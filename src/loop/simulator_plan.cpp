/// Hands a plan from rank to rank as a conclusion's datasets, packed.
/// Follows from `study::pack`. Factors are scaled as differences are: 1 + scale x value.
#include "loop/simulator_plan.hpp"

#include "study/datasets.hpp"
#include "study/packed_conclusion.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

constexpr const char* plan_group = "plan";

std::vector<double> values_in(const std::vector<study::Dataset>& datasets,
                              const std::string& path) {
    const study::Dataset* found = study::find_dataset(datasets, path);
    return found == nullptr ? std::vector<double>{} : found->values;
}

std::vector<std::string> texts_in(const std::vector<study::Dataset>& datasets,
                                  const std::string& path) {
    const study::Dataset* found = study::find_dataset(datasets, path);
    return found == nullptr ? std::vector<std::string>{} : found->texts;
}

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
    study::DatasetBuilder datasets(group);
    std::vector<std::string> names;
    std::vector<std::string> texts;  // five of each series
    std::vector<double> of_effect, is_factor, values;
    for (std::size_t k = 0; k < effects.size(); ++k) {
        names.push_back(effects[k].name);
        for (const effects::HookSeries& at : effects[k].at) {
            for (const std::string& text : {at.hook, at.unit, at.facade, at.meter})
                texts.push_back(text);
            of_effect.push_back(static_cast<double>(k));
            is_factor.push_back(at.is_factor ? 1 : 0);
            values.insert(values.end(), at.values.begin(), at.values.end());
        }
    }
    datasets.texts("given", "given", names);
    datasets.texts("given_texts", "given_text", texts);
    datasets.vector("given_of", "given_series", of_effect);
    datasets.vector("given_is_factor", "given_series", is_factor);
    datasets.vector("given_values", "given_value", values);
    return datasets.take();
}

std::vector<study::GivenEffect> effects_in(const std::vector<study::Dataset>& datasets,
                                           const std::string& group) {
    const auto at = [&](const char* leaf) { return group + "/" + leaf; };
    std::vector<study::GivenEffect> effects;
    for (std::string& name : texts_in(datasets, at("given")))
        effects.push_back({std::move(name), {}});
    const auto texts = texts_in(datasets, at("given_texts"));
    const auto of_effect = values_in(datasets, at("given_of")),
               is_factor = values_in(datasets, at("given_is_factor")),
               values = values_in(datasets, at("given_values"));
    const std::size_t n = of_effect.size(), n_hours = n > 0 ? values.size() / n : 0;
    for (std::size_t s = 0; s < n; ++s) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(s * n_hours);
        effects[static_cast<std::size_t>(of_effect[s])].at.push_back(
            {texts[4 * s],
             texts[4 * s + 1],
             is_factor[s] == 1,
             texts[4 * s + 2],
             texts[4 * s + 3],
             {begin, begin + static_cast<std::ptrdiff_t>(n_hours)}});
    }
    return effects;
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
                       {}};
    const Matrix searched = matrix_in(datasets, at("searched"));
    for (std::size_t c = 0; c < searched.rows; ++c)
        plan.searched.emplace_back(searched.row(c).begin(), searched.row(c).end());
    return plan;
}

std::vector<study::GivenEffect> scaled(const std::vector<study::GivenEffect>& effects,
                                       std::span<const double> scales) {
    std::vector<study::GivenEffect> all;
    for (std::size_t k = 0; k < std::min(effects.size(), scales.size()); ++k) {
        if (scales[k] == 0 || effects[k].at.empty()) continue;
        all.push_back(effects[k]);
        for (effects::HookSeries& at : all.back().at)
            for (double& value : at.values) value *= scales[k];
    }
    return all;
}

}  // namespace bemcal::loop
