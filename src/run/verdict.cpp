#include "run/verdict.hpp"

#include "store/layout.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

constexpr const char* leaf = "shortfall";

std::string first_reason(const study::ItemAnswer& answer) {
    if (!answer.error.empty() || answer.failures.empty()) return answer.error;
    return answer.failures[0].reason;
}

}  // namespace

void Verdict::count(const study::Stage& stage,
                    const std::vector<study::ItemAnswer>& answers) {
    const auto n_items = static_cast<double>(answers.size());
    const auto n_known = static_cast<double>(stage.n_simulations());
    const double n_points = n_known > 0 ? n_known : n_items;
    n_points_ += n_points;
    for (const auto& answer : answers) {
        const auto n_own = static_cast<double>(answer.failures.size());
        if (!answer.error.empty())
            n_failed_ += n_points / n_items;
        else
            n_failed_ += n_known > 0 ? n_own : 0;
        if (first_error_.empty()) first_error_ = first_reason(answer);
    }
}

void Verdict::take_shortfalls(const std::vector<study::Dataset>& datasets) {
    for (const study::Dataset& dataset : datasets)
        if (store::leaf_of(dataset.path) == leaf && !dataset.texts.empty())
            shortfalls_.push_back(store::group_of(dataset.path) + ": " +
                                  dataset.texts[0]);
}

ExitCode Verdict::code() const {
    if (is_over_budget()) return ExitCode::data;
    return shortfalls_.empty() ? ExitCode::ok : ExitCode::not_reached;
}

std::vector<std::string> Verdict::sentences() const {
    std::vector<std::string> all = shortfalls_;
    if (is_over_budget())
        all.push_back(fmt::format(
            "{:.0f} of {:.0f} simulations failed, more than the share of {} that the job "
            "accepts; the first: {}",
            n_failed_, n_points_, max_failed_share_, first_error_));
    return all;
}

study::Dataset shortfall_dataset(const study::Stage& stage, const std::string& sentence) {
    return {stage.name() + "/" + leaf, {}, {}, {}, {sentence}};
}

}  // namespace bemcal::run
