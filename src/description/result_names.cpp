/// Refuses names that cannot be groups of a result: with a slash, or of something that
/// stands there already, for each kind of thing.
/// Follows from the layout of results, to which a test holds the lists.
/// Nothing is renamed: a refused name is the user's to change.
#include "description/result_names.hpp"

#include "loop/stored_loop.hpp"

#include <algorithm>
#include <span>

namespace bemcal::description {

namespace {

/// Beside the buildings in a result.
constexpr const char* of_result[] = {"run", "inputs", "input_file"};
/// Beside the periods of a posterior, and the buildings of a pooled one.
constexpr const char* of_posterior[] = {"kind",
                                        "function",
                                        "unknown",
                                        "unknown_unit",
                                        "posterior",
                                        "posterior_mean",
                                        "posterior_sd",
                                        "posterior_q05",
                                        "posterior_q50",
                                        "posterior_q95",
                                        "posterior_predictive",
                                        "observed_data",
                                        "prior",
                                        "sample_stats",
                                        "gelman_rubin",
                                        "rhat_split",
                                        "rhat_rank",
                                        "ess_bulk",
                                        "ess_tail",
                                        "mcse_mean",
                                        "convergence",
                                        "shortfall",
                                        "target_rhat",
                                        "target_ess",
                                        "contraction",
                                        "shift",
                                        "range_share",
                                        "data_finding",
                                        "data_words",
                                        "simulator_parameter",
                                        "simulator_parameter_unit",
                                        "simulator_parameter_least",
                                        "simulator_parameter_most",
                                        "simulator_run",
                                        "simulator_run_failure",
                                        "simulator_run_value",
                                        "simulator_channel",
                                        "simulator_emulator_error"};
/// Beside the studies of a building.
constexpr const char* of_building[] = {"data"};
/// Beside the periods of a screening: its datasets and dimensions. A test holds the list
/// to the layout of results.
constexpr const char* of_screening[] = {"parameter",
                                        "parameter_unit",
                                        "parameter_least",
                                        "parameter_most",
                                        "n_failed",
                                        "failure",
                                        "failed_point",
                                        "failed_reason",
                                        "shortfall",
                                        "meter",
                                        "meter_unit",
                                        "period",
                                        "candidate",
                                        "metric",
                                        "resolution",
                                        "point",
                                        "points",
                                        "score",
                                        "cv_rmse",
                                        "nmbe",
                                        "mape",
                                        "monthly_cv_rmse",
                                        "monthly_nmbe",
                                        "monthly_mape",
                                        "meets_guideline_14",
                                        "guideline_14_count",
                                        "rank",
                                        "best_point",
                                        "best_score",
                                        "best_parameters",
                                        "best_cv_rmse",
                                        "best_nmbe",
                                        "best_mape",
                                        "best_monthly_cv_rmse",
                                        "best_monthly_nmbe",
                                        "best_monthly_mape",
                                        "candidate_parameters",
                                        "fit",
                                        "monthly_fit",
                                        "n_points",
                                        "best_run_output",
                                        "best_run_unit",
                                        "best_run_value",
                                        "best_run_foretold"};
/// Beside the meters of a period.
constexpr const char* of_period[] = {"hourly", "time", "month", "outdoor_temperature"};

bool has(std::span<const char* const> names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// Beside the periods of a loop.
bool is_of_loop(const std::string& name) {
    static const std::vector<std::string> names = loop::stored_names();
    return std::ranges::find(names, name) != names.end();
}

std::span<const char* const> taken(Named kind) {
    switch (kind) {
        case Named::building:
            return of_result;
        case Named::study:
            return of_building;
        case Named::period:
            return of_screening;
        case Named::meter:
            return of_period;
    }
    return {};
}

}  // namespace

std::string refusal_of_name(Named kind, const std::string& name) {
    if (name.find('/') != std::string::npos)
        return "has a slash, which parts the names of a result; expected another name";
    const bool in_posterior = kind == Named::building || kind == Named::period;
    if (name == "." || name == ".." || has(taken(kind), name) ||
        (in_posterior && has(of_posterior, name)) ||
        (kind == Named::period && is_of_loop(name)))
        return "something else in a result has this name; expected another name";
    return {};
}

void check_name(const schema::Section& section, std::string_view key, Named kind,
                const std::string& name) {
    const std::string refusal = refusal_of_name(kind, name);
    if (refusal.empty()) return;
    if (section.has(key) && kind != Named::period) section.fail_value(key, refusal);
    section.fail(key, "\"" + name + "\": " + refusal);
}

}  // namespace bemcal::description
