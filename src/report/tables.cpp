/// Everything a result holds as text: the sections of its studies one after another,
/// failures by reason, missed targets, and `status`.
/// Plain text without a source. Which sections there are is told by the datasets that are
/// there; the sections themselves are in files of their own.
#include "report/tables.hpp"

#include "report/sections.hpp"
#include "report/stock_tables.hpp"
#include "report/text_table.hpp"

#include <map>
#include <sstream>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

std::string value_or(const std::map<std::string, std::string>& attributes,
                     const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? "?" : found->second;
}

/// Simulations that failed for the same reason, with other numbers.
struct Reason {
    int count = 0;
    std::string first;
    bool differs = false;
};

/// The words without a digit: which reason it is.
std::string without_numbers(const std::string& reason) {
    std::istringstream words(reason);
    std::string text;
    for (std::string word; words >> word;)
        if (word.find_first_of("0123456789") == std::string::npos) text += word + " ";
    return text;
}

}  // namespace

std::string decision_section(const Group& data) {
    const auto &series = data.texts("series"), &findings = data.texts("finding");
    const auto& actions = data.texts("action");
    TextTable table({"data", "finding", "done about it"});
    for (std::size_t k = 0; k < series.size(); ++k)
        table.add({series[k], findings[k], actions[k]});
    return table.is_empty() ? "" : fmt::format("\n{}\n", data.path()) + table.text(38);
}

std::string failure_lines(const Group& study) {
    const double n_failed = study.value("n_failed");
    if (!(n_failed > 0)) return {};
    std::map<std::string, Reason> reasons;
    for (const std::string& text : study.texts("failed_reason")) {
        Reason& reason = reasons[without_numbers(text)];
        if (reason.count++ == 0) reason.first = text;
        reason.differs = reason.differs || text != reason.first;
    }
    std::string text = fmt::format("  {:.0f} simulation{} failed:\n", n_failed,
                                   n_failed == 1 ? "" : "s");
    int n_shown = 0;
    for (const auto& [key, reason] : reasons) {
        if (++n_shown > 10)
            return text + fmt::format("  and for {} more reasons\n", reasons.size() - 10);
        text += fmt::format("  {:>8} x {}{}\n", reason.count,
                            reason.differs ? "like: " : "", reason.first);
    }
    return text;
}

std::string shortfall_lines(const store::ResultFile& result) {
    std::string text;
    for (const Group& study : groups_with(result, "shortfall"))
        for (const std::string& sentence : study.texts("shortfall"))
            text += fmt::format("NOT REACHED: {}: {}\n", study.path(), sentence);
    return text;
}

std::string tables_of(const store::ResultFile& result) {
    store::check_layout(result);
    std::string text = shortfall_lines(result);
    for (const Group& stock : groups_with(result, "stock_building"))
        text += stock_section(stock);
    for (const Group& data : groups_with(result, "finding"))
        text += decision_section(data);
    for (const Group& study : groups_with(result, "total_order"))
        text += sensitivity_section(study);
    for (const Group& study : groups_with(result, "series_total_order"))
        text += hourly_section(study);
    for (const Group& study : groups_with(result, "guideline_14_count"))
        text += screening_section(study);
    for (const Group& study : groups_with(result, "objective"))
        text += optimisation_section(study);
    for (const Group& study : groups_with(result, "unknown"))
        text += posterior_section(study);
    for (const Group& study : groups_with(result, "structure_chosen"))
        text += loop_section(study);
    for (const Group& study : groups_with(result, "stage_points"))
        text += grid_section(study);
    for (const Group& study : groups_with(result, "saving_quantile"))
        text += retrofit_section(study);
    for (const Group& study : groups_with(result, "calibration_stage"))
        text += staged_section(study);
    return text;
}

std::string status_of(const store::ResultFile& result) {
    const std::string now = store::result_hash(result);
    const std::string missed = shortfall_lines(result);
    std::string text = !result.complete ? "NOT complete\n"
                       : missed.empty() ? "complete\n"
                                        : "complete, but a target was missed\n" + missed;
    if (result.run.contains("failed"))
        text += fmt::format("  FAILED: {}\n", result.run.at("failed"));
    const auto to_rerun = result.run.find("items_to_rerun");
    if (to_rerun != result.run.end() && to_rerun->second != "0")
        text += fmt::format(
            "  failed items: {}; `run JOB -o FILE --rerun-failed` does "
            "only those again\n",
            to_rerun->second);
    if (now != result.hash)
        text += fmt::format("  DAMAGED: its content has hash {}\n", now);
    text += fmt::format("  result hash {}\n", result.hash);
    text += fmt::format(
        "  job {}, seed {}, version {}\n", value_or(result.attributes, "title"),
        value_or(result.attributes, "seed"), value_or(result.attributes, "version"));
    const auto& run = result.run;
    text += fmt::format("  run on {} from {} to {}: ranks: {}, threads: {}, {}\n",
                        value_or(run, "host"), value_or(run, "started"),
                        value_or(run, "finished"), value_or(run, "n_ranks"),
                        value_or(run, "n_threads"), value_or(run, "instruction_set"));
    text += fmt::format(
        "  seconds: read {}, plan {}, simulate {} (idle share {}), conclude {}, "
        "store {}\n",
        value_or(run, "seconds_read"), value_or(run, "seconds_plan"),
        value_or(run, "seconds_simulate"), value_or(run, "idle_share"),
        value_or(run, "seconds_conclude"), value_or(run, "seconds_store"));
    return text;
}

}  // namespace bemcal::report
