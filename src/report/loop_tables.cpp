/// What a loop found and how: effects with their evidence and doubts, the steps of the
/// search, what became of the parameters; what is read first stands last.
/// Made from stored datasets alone; other tables of a loop are in loop_fit_tables and
/// loop_data_tables, pictures in scripts/loop_report.
#include "report/loop_parts.hpp"
#include "report/sections.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

std::string count_of(const Group& study) {
    const std::size_t n = study.texts("effect").size();
    return n == 0   ? std::string("no effect found that passes")
           : n == 1 ? std::string("1 effect found that the description lacks")
                    : fmt::format("{} effects found that the description lacks", n);
}

std::string effect_table(const Group& study) {
    TextTable table(
        {"effect found", "coefficient", "90 % interval", "unit", "gain", "adequate"});
    const auto& names = study.texts("effect");
    for (std::size_t k = 0; k < names.size(); ++k)
        table.add({names[k],
                   three_digits(number_at(study.values("effect_coefficient"), k)),
                   fmt::format("{} to {}",
                               three_digits(number_at(study.values("effect_least"), k)),
                               three_digits(number_at(study.values("effect_most"), k))),
                   text_at(study.texts("effect_unit"), k),
                   three_digits(number_at(study.values("effect_gain"), k)),
                   number_at(study.values("effect_adequate"), k) == 1 ? "yes" : "NO"});
    return text_of(table, 36);
}

/// The class of an effect without itself.
std::string others_of(const Group& study, std::size_t k) {
    const std::string members = text_at(study.texts("effect_class"), k);
    const std::string& own = study.texts("effect")[k];
    std::string others;
    for (std::size_t begin = 0; begin < members.size();) {
        const std::size_t end = std::min(members.find("; ", begin), members.size());
        const std::string name = members.substr(begin, end - begin);
        if (name != own) others += (others.empty() ? "" : "; ") + name;
        begin = end + 2;
    }
    return others;
}

/// Why an effect is not adequate; results of before that was written do not say.
std::string doubt_of(const Group& study, std::size_t k) {
    const std::string doubt = text_at(study.texts("effect_doubt"), k);
    return doubt.empty() ? "the alarm that raised it stays with it" : doubt;
}

/// "blind control: enters at aperture, sun on the facade above 212 W/m2; ..."; the
/// grammar's names say it themselves.
std::string effect_lines(const Group& study, std::size_t k) {
    const std::string& name = study.texts("effect")[k];
    const std::string hook = text_at(study.texts("effect_hook"), k);
    std::string text =
        wrapped(name.starts_with(hook + ": ")
                    ? name
                    : fmt::format("{}: enters at {}, {}", name, hook,
                                  text_at(study.texts("effect_shape"), k)));
    if (number_at(study.values("effect_adequate"), k) != 1)
        text += wrapped(
            fmt::format("  NOT adequate: {}, so that its name is only the nearest one",
                        doubt_of(study, k)));
    const std::string others = others_of(study, k);
    if (!others.empty()) text += wrapped("  these data cannot tell it from: " + others);
    const std::string separates = text_at(study.texts("effect_separates"), k);
    if (!separates.empty()) text += wrapped("  what would tell: " + separates);
    return text;
}

/// "gas -8.6": the channel whose error a step lowers most.
std::string best_of(const Group& study, std::size_t step) {
    const auto& channels = study.texts("channel");
    double least = std::numeric_limits<double>::quiet_NaN();
    std::string text = "-";
    for (std::size_t c = 0; c < channels.size() && study.has("step_error"); ++c) {
        const double change =
            number_at(study.values("step_error"), step * channels.size() + c);
        if (!std::isfinite(change) || change >= least) continue;
        least = change;
        text = fmt::format("{} {:+.1f}", channels[c], 100 * change);
    }
    return text;
}

std::string step_table(const Group& study) {
    TextTable table(
        {"step", "effect tried", "gain", "needed", "score", "error %: best", "verdict"});
    const auto& names = study.texts("step_effect");
    for (std::size_t k = 0; k < names.size(); ++k)
        table.add({std::to_string(k + 1), cut(names[k], 21),
                   three_digits(number_at(study.values("step_gain"), k)),
                   three_digits(number_at(study.values("step_threshold"), k)),
                   three_digits(number_at(study.values("step_score"), k)),
                   best_of(study, k), text_at(study.texts("step_verdict"), k)});
    return text_of(table, 31);
}

std::string end_lines(const Group& study) {
    const auto &verdicts = study.texts("step_verdict"),
               &effects = study.texts("step_effect");
    std::string text;
    for (std::size_t k = std::min(verdicts.size(), effects.size()); k-- > 0;)
        if (effects[k].empty()) {  // a verdict of the search, not of an effect
            text += wrapped("the search ended: " + verdicts[k]);
            break;
        }
    const auto& candidates = study.texts("candidate");
    std::string ranking;
    for (std::size_t k = 0; k < std::min<std::size_t>(candidates.size(), 5); ++k)
        ranking +=
            fmt::format("{}{} ({})", k == 0 ? "" : ", ", candidates[k],
                        three_digits(number_at(study.values("candidate_gain"), k)));
    if (!ranking.empty())
        text += wrapped("first in the last ranking, with their gains: " + ranking);
    return text;
}

/// Its standard deviation is left out; what is nothing beside it is 0.
std::string plain_of(const Group& study, std::size_t parameter) {
    const double value = number_at(study.values("parameter_value"), parameter);
    const double sd = number_at(study.values("parameter_sd"), parameter);
    return three_digits(std::abs(value) < 1e-6 * sd ? 0 : value);
}

std::string parameter_table(const Group& study) {
    const auto& names = study.texts("parameter");
    const std::size_t n = names.size();
    const auto &values = study.values("parameter_value"),
               &sds = study.values("parameter_sd"),
               &means = study.values("parameter_prior_mean"),
               &prior_sds = study.values("parameter_prior_sd");
    TextTable table({"parameter", "unit", "prior", "plain", "before", "after", "moved"});
    for (std::size_t p = 0; p < n; ++p) {
        const double moved = (number_at(values, 2 * n + p) - number_at(values, n + p)) /
                             number_at(prior_sds, p);
        table.add(
            {names[p], text_at(study.texts("parameter_unit"), p),
             plus_minus_brief(number_at(means, p), number_at(prior_sds, p)),
             plain_of(study, p),
             plus_minus_brief(number_at(values, n + p), number_at(sds, n + p)),
             plus_minus_brief(number_at(values, 2 * n + p), number_at(sds, 2 * n + p)),
             std::isfinite(moved) ? fmt::format("{:+.2f}", moved) : "-"});
    }
    const std::string text = text_of(table, 19);
    return text.empty()
               ? text
               : text +
                     "  moved: from before to after, in standard deviations of the "
                     "prior\n";
}

}  // namespace

std::string three_digits(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    return size >= 1000 && size < 1e6 ? fmt::format("{:.0f}", value)
                                      : fmt::format("{:.3g}", value);
}

std::string plus_minus_brief(double value, double sd) {
    if (!std::isfinite(value) || !std::isfinite(sd)) return three_digits(value);
    const double shown = std::abs(value) > 1e-6 * sd ? value : 0;
    return fmt::format("{} +- {}", three_digits(shown),
                       sd < 1000 ? fmt::format("{:.2g}", sd) : three_digits(sd));
}

double number_at(const std::vector<double>& values, std::size_t k) {
    return k < values.size() ? values[k] : std::numeric_limits<double>::quiet_NaN();
}

std::string text_at(const std::vector<std::string>& texts, std::size_t k) {
    return k < texts.size() ? texts[k] : std::string();
}

std::string wrapped(const std::string& sentence) {
    constexpr std::size_t widest = 98;
    std::istringstream words(sentence);
    std::string text, line = sentence.starts_with("  ") ? "   " : " ";
    for (std::string word; words >> word;) {
        if (line.size() + 1 + word.size() > widest) {
            text += line + "\n";
            line = "     ";
        }
        line += " " + word;
    }
    return text + line + "\n";
}

std::string text_of(const TextTable& table, std::size_t widest) {
    return table.is_empty() ? std::string() : table.text(widest);
}

/// What is read first stands last, where a terminal ends.
std::string loop_section(const Group& study) {
    std::string effects = effect_table(study);
    for (std::size_t k = 0; k < study.texts("effect").size(); ++k)
        effects += effect_lines(study, k);
    std::string text = fmt::format("\n{}: {}\n", study.path(), count_of(study));
    for (const std::string& part :
         {failure_lines(study), loop_decision_table(study), loop_structure_table(study),
          loop_power_table(study), loop_unexplained_table(study),
          loop_localisation_table(study), parameter_table(study),
          step_table(study) + end_lines(study), effects,
          loop_headline(study) + loop_fit_table(study)})
        if (!part.empty()) text += "\n" + part;
    return text;
}

}  // namespace bemcal::report
