/// Everything a result holds as text: the sections of its studies one after another,
/// failures by reason, missed targets, and `status`.
/// Plain text without a source. A study's section is that of its kind; the sections
/// themselves are in files of their own.
#include "report/tables.hpp"

#include "report/sections.hpp"
#include "report/stock_tables.hpp"
#include "report/studies.hpp"
#include "report/text_table.hpp"

#include <algorithm>
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
    std::string lines;
    for (std::size_t k = 0; k < series.size(); ++k)
        lines += finding_line(series[k], findings[k], actions[k]);
    return lines.empty() ? "" : fmt::format("\n{}\n", data.path()) + lines;
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

namespace {

/// The section of each kind of study, in the order in which they are shown.
struct KindSection {
    const char* kind;
    std::string (*section)(const Group& study);
};
constexpr KindSection kind_sections[] = {{"sensitivity", sensitivity_section},
                                         {"office_hour_sensitivity", sensitivity_section},
                                         {"hourly_sensitivity", hourly_section},
                                         {"screening", screening_section},
                                         {"optimisation", optimisation_section},
                                         {"posterior", posterior_section},
                                         {"kennedy_ohagan", posterior_section},
                                         {"loop", loop_section},
                                         {"grid", grid_section},
                                         {"retrofit", retrofit_section},
                                         {"stages", staged_section}};

bool has_section(const std::string& kind) {
    return kind == "stock" || std::ranges::any_of(kind_sections, [&](const auto& row) {
               return kind == row.kind;
           });
}

std::string sections_of(const std::vector<StoredStudy>& studies, const std::string& kind,
                        std::string (*section)(const Group&)) {
    std::string text;
    for (const StoredStudy& study : studies)
        if (study.kind == kind) text += section(study.group);
    return text;
}

}  // namespace

std::string tables_of(const store::ResultFile& result) {
    store::check_layout(result);
    const std::vector<StoredStudy> studies = studies_in(result);
    std::string text =
        shortfall_lines(result) + sections_of(studies, "stock", stock_section);
    for (const Group& data : groups_with(result, "finding"))
        text += decision_section(data);
    for (const KindSection& row : kind_sections)
        text += sections_of(studies, row.kind, row.section);
    for (const StoredStudy& study : studies)
        if (!has_section(study.kind)) text += plain_section(study.group);
    return text;
}

bool is_damaged(const store::ResultFile& result) {
    return !store::is_sound(result);
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
    else if (is_damaged(result))
        text += "  DAMAGED: its units or /run are not those that were written\n";
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
