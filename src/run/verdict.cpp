/// Whether a batch that ran to its end succeeded: failed points against the share that
/// the job accepts, stages of which all failed, targets that were missed.
/// Our own rules, without a source. An item that failed as a whole counts with its share
/// of the stage's simulations. Whether results are plausible is not judged.
#include "run/verdict.hpp"

#include "store/dataset_path.hpp"
#include "study/bias.hpp"

#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::run {
namespace {

constexpr const char* leaf = "shortfall";
constexpr const char *failed_key = "failed", *rerun_key = "items_to_rerun";

std::string first_reason(const study::ItemAnswer& answer) {
    if (!answer.error.empty() || answer.failures.empty()) return answer.error;
    return answer.failures[0].reason;
}

}  // namespace

bool deserves_rerun(const study::Stage& stage, const study::ItemAnswer& answer) {
    return !answer.error.empty() ||
           (stage.failures_may_pass() && !answer.failures.empty());
}

void Verdict::count(const study::Stage& stage,
                    const std::vector<study::ItemAnswer>& answers) {
    const auto n_items = static_cast<double>(answers.size());
    const auto n_known = static_cast<double>(stage.n_simulations());
    const double n_points = n_known > 0 ? n_known : n_items;
    double n_failed = 0;
    std::string first_error;
    for (const auto& answer : answers) {
        const auto n_own = static_cast<double>(answer.failures.size());
        if (!answer.error.empty())
            n_failed += n_points / n_items;
        else
            n_failed += n_known > 0 ? n_own : 0;
        if (first_error.empty()) first_error = first_reason(answer);
        n_to_rerun_ += deserves_rerun(stage, answer);
    }
    if (n_points > 0 && n_failed > n_points - 0.5)
        lost_stages_.push_back(fmt::format("{}: all of it failed; the first: {}",
                                           stage.name(), first_error));
    n_points_ += n_points;
    n_failed_ += n_failed;
    if (first_error_.empty()) first_error_ = first_error;
}

void Verdict::take_shortfalls(const std::vector<study::Dataset>& datasets) {
    for (const study::Dataset& dataset : datasets)
        if (store::leaf_of(dataset.path) == leaf && !dataset.texts.empty())
            shortfalls_.push_back(store::group_of(dataset.path) + ": " +
                                  dataset.texts[0]);
}

std::vector<std::string> Verdict::failures() const {
    std::vector<std::string> all = lost_stages_;
    if (!stored_.empty()) all.push_back(stored_);
    if (n_failed_ > max_failed_share_ * n_points_)
        all.push_back(fmt::format(
            "{:.0f} of {:.0f} simulations failed, more than the share of {} that the job "
            "accepts; the first: {}",
            n_failed_, n_points_, max_failed_share_, first_error_));
    return all;
}

void Verdict::store(std::map<std::string, std::string>& run) const {
    run[rerun_key] = std::to_string(n_to_rerun_);
    const auto sentences = failures();
    if (!sentences.empty())
        run[failed_key] = fmt::format("{}", fmt::join(sentences, "; "));
}

void Verdict::take_stored(const std::map<std::string, std::string>& run) {
    const auto failed = run.find(failed_key), rerun = run.find(rerun_key);
    if (failed != run.end()) stored_ = failed->second;
    if (rerun != run.end()) n_to_rerun_ = std::atoi(rerun->second.c_str());
}

ExitCode Verdict::code() const {
    if (!failures().empty()) return ExitCode::data;
    return shortfalls_.empty() ? ExitCode::ok : ExitCode::not_reached;
}

std::vector<std::string> Verdict::sentences() const {
    std::vector<std::string> all = shortfalls_;
    for (std::string& sentence : failures()) all.push_back(std::move(sentence));
    return all;
}

std::vector<study::Dataset> shortfall_datasets(const study::Stage& stage,
                                               const std::string& sentence,
                                               const std::vector<study::Summary>& found) {
    std::map<std::string, std::vector<std::string>> missed{{stage.name(), {sentence}}};
    for (const study::Summary& summary : found)
        missed[summary.study].push_back(summary.shortfall);
    std::vector<study::Dataset> datasets;
    for (const auto& [study, sentences] : missed)
        if (std::string said = study::joined_sentences(sentences); !said.empty())
            datasets.push_back({study + "/" + leaf, {}, {}, {}, {std::move(said)}});
    return datasets;
}

std::vector<study::Dataset> failed_item_datasets(
    const study::Stage& stage, const std::vector<study::ItemAnswer>& answers) {
    std::vector<double> items;
    std::vector<std::string> reasons;
    for (std::size_t item = 0; item < answers.size(); ++item) {
        if (answers[item].error.empty()) continue;
        items.push_back(static_cast<double>(item));
        reasons.push_back(answers[item].error);
    }
    if (items.empty()) return {};
    const std::string path = stage.name() + "/failed_item";
    const std::vector<std::string> dims{"failed_item"};
    const std::vector<std::size_t> shape{items.size()};
    return {{path, dims, shape, std::move(items), {}},
            {path + "_reason", dims, shape, {}, std::move(reasons)}};
}

}  // namespace bemcal::run
