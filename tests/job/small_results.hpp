/// The result of one small job with a study of nearly every kind, and that of a stock:
/// what tables, fuzzers and damage are tried on.
#pragma once

#include "job/small_office.hpp"
#include "job/stages.hpp"
#include "job/stock.hpp"
#include "stock/stage.hpp"
#include "store/result.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::job {

constexpr const char* small_studies = R"(
[[study]]
kind = "sensitivity"
n_base = 64
n_bootstrap = 10
[[study]]
kind = "hourly_sensitivity"
quantity = "electricity"
n_base = 64
[[study]]
kind = "screening"
n_points = 16
[[study]]
kind = "optimisation"
evaluations = 40
[[study]]
kind = "grid"
budget = 40
most_stages = 2
[[study.target]]
quantity = "electricity"
measured = 9000
[study.grid]
infiltration = [0.3, 0.4, 0.5]
set_point = [-0.5, 0, 0.5]
[[study]]
kind = "stages"
meters = ["air"]
evaluations = 40
[[study.stage]]
name = "envelope"
periods = ["training"]
parameters = ["infiltration"]
[[study.validation]]
period = "held_out"
stage = "envelope"
[[study]]
kind = "posterior"
sampler = "random_walk"
n_chains = 2
warm_up = 5
draws_per_round = 4
most_draws = 4
n_predictive = 4
autocorrelated = false
[[study]]
kind = "retrofit"
of = "screening"
[[study]]
kind = "loop"
most_effects = 1
try_structures = false
[[scenario]]
name = "walls"
[[scenario.change]]
target = "construction.wall.u_value"
factor = 0.5
)";

/// The sample job without its studies.
inline std::string small_building_text() {
    const std::string text = small_office_text();
    return text.substr(0, text.find("[[study]]"));
}

/// All rounds of a stage, item by item.
inline study::Conclusion conclusion_of(study::Stage& stage) {
    return stage.conclude(test::answers_of(stage));
}

inline store::ResultFile result_of_stages(
    const std::vector<std::unique_ptr<study::Stage>>& stages) {
    store::ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"title", "small"}, {"job", "x"}};
    result.complete = true;
    std::vector<study::Summary> found;
    for (const auto& stage : stages) {
        stage->see(found);
        study::Conclusion conclusion = conclusion_of(*stage);
        std::ranges::move(conclusion.datasets, std::back_inserter(result.datasets));
        std::ranges::move(conclusion.summaries, std::back_inserter(found));
    }
    return result;
}

inline store::ResultFile small_result() {
    const Folder folder;
    const std::string text = small_building_text() + small_studies;
    const auto job = read_job(write_small_office(folder, text));
    return result_of_stages(make_plan(job));
}

/// Two buildings, and one whose readings are missing.
inline store::ResultFile small_stock_result() {
    const Folder folder;
    folder.write("weather.csv", small_weather());
    folder.write("one.csv", small_readings());
    folder.write("building.toml", small_stock_building());
    folder.write("stock.csv", "name,meter\none,one.csv\ntwo,one.csv\nthree,three.csv\n");
    const auto job = read_job(folder.write(
        "job.toml",
        "seed = 3\n[stock]\ntable = \"stock.csv\"\ntemplate = \"building.toml\"\n"
        "[[study]]\nkind = \"screening\"\nn_points = 16\n"));
    std::vector<std::unique_ptr<study::Stage>> stages;
    stages.push_back(stock::make_stock_stage(job, {"1", {}}));
    return result_of_stages(stages);
}

}  // namespace bemcal::job
