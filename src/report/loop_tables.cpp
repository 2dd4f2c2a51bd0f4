/// What a loop found and how: effects with their evidence and doubts, the steps of the
/// search, what became of the parameters; what is read first stands last.
/// Made from stored datasets alone; other tables of a loop are in loop_fit_tables and
/// loop_data_tables, pictures in scripts/result_report.
#include "base/nan.hpp"
#include "loop/next_measurements.hpp"
#include "report/loop_parts.hpp"
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

using loop::StoredLoop;

std::string count_of(const StoredLoop& loop) {
    const std::size_t n = loop.effects.size();
    return n == 0   ? std::string("no effect found that passes")
           : n == 1 ? std::string("1 effect found that the description lacks")
                    : fmt::format("{} effects found that the description lacks", n);
}

std::string effect_table(const StoredLoop& loop) {
    TextTable table(
        {"effect found", "coefficient", "90 % interval", "unit", "gain", "adequate"});
    for (const StoredLoop::Effect& effect : loop.effects) {
        const bool is_choice = effect.least == effect.most;  // hours, by simulation
        table.add({effect.name, is_choice ? "-" : three_digits(effect.coefficient),
                   is_choice ? "-"
                             : fmt::format("{} to {}", three_digits(effect.least),
                                           three_digits(effect.most)),
                   effect.unit, three_digits(effect.gain),
                   effect.is_adequate() ? "yes" : "NO"});
    }
    return text_of(table, 36);
}

/// What an effect brings.
struct Brings {
    const StoredLoop::Effect* effect;
    std::vector<const StoredLoop::EffectValue*> values;

    /// Size of what it costs; where no tariff is known, of its largest energy.
    double size() const {
        double largest = 0;
        for (const StoredLoop::EffectValue* value : values) {
            if (value->of == "cost" || value->of.starts_with("cost of "))
                return std::abs(value->value);
            largest = std::max(largest, std::abs(value->value));
        }
        return largest;
    }
};

std::vector<Brings> brings_of(const StoredLoop& loop) {
    std::vector<Brings> all;
    for (std::size_t k = 0; k < loop.effects.size(); ++k) {
        Brings& own = all.emplace_back(Brings{&loop.effects[k], {}});
        for (const StoredLoop::EffectValue& value : loop.effect_values)
            if (value.effect == static_cast<double>(k)) own.values.push_back(&value);
    }
    std::ranges::stable_sort(all, std::greater<>(), &Brings::size);
    return all;
}

/// What is set otherwise than described: before and after have it.
std::string setting_table(const StoredLoop& loop) {
    TextTable table({"set otherwise than described", "described", "found",
                     "90 % interval", "unit", "prior sd off"});
    for (const loop::Setting& setting : loop.settings)
        table.add({setting.name, three_digits(setting.described),
                   three_digits(setting.found),
                   fmt::format("{} to {}", three_digits(setting.least),
                               three_digits(setting.most)),
                   setting.unit, fmt::format("{:.1f}", setting.distance)});
    return text_of(table, 36);
}

/// The largest first: what an owner would act on.
std::string worth_table(const StoredLoop& loop) {
    TextTable table({"what it brings", "of", "more with it", "90 % interval", "unit"});
    for (const Brings& own : brings_of(loop))
        for (const StoredLoop::EffectValue* value : own.values)
            table.add({value == own.values.front() ? own.effect->name : "", value->of,
                       three_digits(value->value),
                       fmt::format("{} to {}", three_digits(value->least),
                                   three_digits(value->most)),
                       value->unit});
    return text_of(table, 36);
}

/// "4 weeks from 1 January".
std::string when_of(const StoredLoop::Measurement& measurement) {
    return fmt::format("{:.0f} week{} from {}", measurement.weeks,
                       measurement.weeks == 1 ? "" : "s", measurement.from);
}

std::string percent_of(double share) {
    return std::isfinite(share) ? fmt::format("{:.0f} %", 100 * share) : "-";
}

/// The advised one of each question of a kind.
std::string measurement_table(const StoredLoop& loop, const std::string& kind,
                              const std::vector<std::string>& head) {
    TextTable table(head);
    for (const StoredLoop::Measurement& measurement : loop.measurements)
        if (measurement.kind == kind && measurement.is_advised == 1)
            table.add({measurement.question, measurement.measure, when_of(measurement),
                       percent_of(measurement.now), percent_of(measurement.then)});
    return text_of(table, 36);
}

/// Of questions that no measurement answers.
std::string unanswered_line(const StoredLoop& loop) {
    std::vector<std::string> asked, answered;
    for (const StoredLoop::Measurement& measurement : loop.measurements) {
        const bool is_answered = measurement.is_advised == 1 ||
                                 loop::is_told(measurement.kind, measurement.now);
        auto& list = is_answered ? answered : asked;
        if (std::ranges::find(list, measurement.question) == list.end())
            list.push_back(measurement.question);
    }
    std::erase_if(asked, [&](const std::string& question) {
        return std::ranges::find(answered, question) != answered.end();
    });
    return asked.empty() ? ""
                         : wrapped(fmt::format(
                               "no measurement that was tried says much more of: {}",
                               fmt::join(asked, "; ")));
}

/// What would answer what the readings leave open.
std::string next_measurement_tables(const StoredLoop& loop) {
    const std::string names = measurement_table(
        loop, "name", {"to tell which it is", "measure", "when", "sure now", "then"});
    const std::string parameters = measurement_table(
        loop, "parameter", {"to know better", "measure", "when", "sd now", "then"});
    std::string text = names;
    if (!names.empty()) text += "  sure: the chance that the likelier name is right\n";
    if (!names.empty() && !parameters.empty()) text += "\n";
    text += parameters;
    if (!parameters.empty())
        text += "  sd: standard deviation, as a share of the prior's\n";
    return text + unanswered_line(loop);
}

/// " (probability 0.93)"; of results that have none "".
std::string probability_of(const StoredLoop::Effect::Member& member) {
    return std::isnan(member.probability)
               ? ""
               : fmt::format(" (probability {:.2f})", member.probability);
}

std::string own_probability(const StoredLoop::Effect& effect) {
    const auto own =
        std::ranges::find(effect.members, effect.name, &StoredLoop::Effect::Member::name);
    return own == effect.members.end() ? "" : probability_of(*own);
}

/// The class of an effect without itself.
std::string others_of(const StoredLoop::Effect& effect) {
    std::vector<std::string> others;
    for (const auto& member : effect.members)
        if (!member.name.empty() && member.name != effect.name)
            others.push_back(member.name + probability_of(member));
    return fmt::format("{}", fmt::join(others, "; "));
}

/// "blind control: enters at aperture, sun on the facade above 212 W/m2; ..."; the
/// grammar's names say it themselves.
std::string effect_lines(const StoredLoop::Effect& effect) {
    std::string text =
        wrapped(effect.name.starts_with(effect.hook + ": ")
                    ? effect.name + own_probability(effect)
                    : fmt::format("{}{}: enters at {}, {}", effect.name,
                                  own_probability(effect), effect.hook, effect.shape));
    const std::string doubt = effect.doubt.empty() ? "" : ": " + effect.doubt;
    if (!effect.is_adequate())
        text += wrapped("  NOT adequate" + doubt +
                        ", so that its name is only the nearest one");
    const std::string others = others_of(effect);
    if (!others.empty()) text += wrapped("  or else: " + others);
    if (!effect.separates.empty())
        text += wrapped("  what would tell: " + effect.separates);
    return text;
}

std::string indented(const std::string& lines) {
    std::istringstream from(lines);
    std::string text, line;
    while (std::getline(from, line)) text += line.empty() ? "\n" : "    " + line + "\n";
    return text;
}

/// The effects found as sections of a job.
std::string sections_of(const StoredLoop& loop) {
    std::string text;
    for (const StoredLoop::Effect& effect : loop.effects)
        if (!effect.section.empty()) text += "\n" + indented(effect.section);
    return text.empty()
               ? text
               : "\n  to carry on what was found: bemcal-batch adopt writes the job anew; "
                 "by hand, put into it\n" +
                     text;
}

/// What is left has no name: where it enters and what it follows.
std::string function_table(const StoredLoop& loop) {
    TextTable table({"function without a name", "size", "unit", "evidence"});
    for (const StoredLoop::Function& function : loop.functions)
        table.add({function.name, three_digits(function.size), function.unit,
                   three_digits(function.evidence)});
    const std::string text = text_of(table, 60);
    return text.empty() ? text
                        : text + "  size: root mean square over the training period\n";
}

/// "8 (7 to 9)".
std::string hour_of(double hour, double least, double most) {
    return fmt::format("{:.0f} ({:.0f} to {:.0f})", hour, least, most);
}

/// Hours that nobody wrote down: before and after have them, plain the usual ones.
std::string hours_table(const StoredLoop& loop) {
    TextTable table({"hours learned", "days", "from [h]", "until [h]", "usual", "prob."});
    std::string sentences;
    for (std::size_t s = 0; s < loop.schedules.size(); ++s) {
        for (const StoredLoop::DailyHours& day : loop.hours) {
            if (day.schedule != static_cast<double>(s)) continue;
            const bool is_off = day.from == day.until;
            table.add(
                {loop.schedules[s].name, day.days,
                 is_off ? "off" : hour_of(day.from, day.from_least, day.from_most),
                 is_off ? "-" : hour_of(day.until, day.until_least, day.until_most),
                 day.usual_from == day.usual_until
                     ? "off"
                     : fmt::format("{:.0f} to {:.0f}", day.usual_from, day.usual_until),
                 fmt::format("{:.2f}", day.probability)});
        }
        sentences += wrapped(loop.schedules[s].sentence);
    }
    const std::string text = text_of(table, 24);
    return text.empty() ? text
                        : text + sentences +
                              "  in brackets: 90 % of the probability; plain has the "
                              "usual hours\n";
}

/// "gas -8.6": the channel whose error a step lowers most.
std::string best_of(const StoredLoop& loop, std::size_t step) {
    double least = nan;
    std::string text = "-";
    for (std::size_t c = 0; c < loop.channels.size(); ++c) {
        const double change = loop.step_error.at({step, c});
        if (!std::isfinite(change) || change >= least) continue;
        least = change;
        text = fmt::format("{} {:+.1f}", loop.channels[c].name, 100 * change);
    }
    return text;
}

std::string step_table(const StoredLoop& loop) {
    TextTable table(
        {"step", "effect tried", "gain", "needed", "score", "error %: best", "verdict"});
    for (std::size_t k = 0; k < loop.steps.size(); ++k) {
        const StoredLoop::Step& step = loop.steps[k];
        table.add({std::to_string(k + 1), cut(step.effect, 21), three_digits(step.gain),
                   three_digits(step.threshold), three_digits(step.score),
                   best_of(loop, k), step.verdict});
    }
    return text_of(table, 31);
}

std::string end_lines(const StoredLoop& loop) {
    std::string text;
    const auto last = std::ranges::find(loop.steps.rbegin(), loop.steps.rend(),
                                        std::string(), &StoredLoop::Step::effect);
    if (last != loop.steps.rend()) text += wrapped("the search ended: " + last->verdict);
    std::string ranking;
    for (std::size_t k = 0; k < std::min<std::size_t>(loop.candidates.size(), 5); ++k)
        ranking += fmt::format("{}{} ({})", k == 0 ? "" : ", ", loop.candidates[k].name,
                               three_digits(loop.candidates[k].gain));
    if (!ranking.empty())
        text += wrapped("first in the last ranking, with their gains: " + ranking);
    return text;
}

/// What is nothing beside its standard deviation, which is left out, is 0.
std::string plain_of(double value, double sd) {
    return three_digits(std::abs(value) < 1e-6 * sd ? 0 : value);
}

std::string parameter_table(const StoredLoop& loop) {
    TextTable table({"parameter", "unit", "prior", "plain", "before", "after", "moved"});
    for (std::size_t p = 0; p < loop.parameters.size(); ++p) {
        const StoredLoop::Parameter& parameter = loop.parameters[p];
        const auto value = [&](StoredLoop::Model m) {
            return loop.parameter_value.at({m, p});
        };
        const auto sd = [&](StoredLoop::Model m) { return loop.parameter_sd.at({m, p}); };
        const auto both = [&](StoredLoop::Model m) {
            return plus_minus_brief(value(m), sd(m));
        };
        const double moved =
            (value(StoredLoop::after) - value(StoredLoop::before)) / parameter.prior_sd;
        table.add({parameter.name, parameter.unit,
                   plus_minus_brief(parameter.prior_mean, parameter.prior_sd),
                   plain_of(value(StoredLoop::plain), sd(StoredLoop::plain)),
                   both(StoredLoop::before), both(StoredLoop::after),
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

std::string text_of(const TextTable& table, std::size_t widest) {
    return table.is_empty() ? std::string() : table.text(widest);
}

/// What is read first stands last, where a terminal ends.
std::string loop_section(const Group& study) {
    const StoredLoop loop = loop::stored_loop(study.result().datasets, study.path());
    const loop::StoredSimulator simulator =
        loop::stored_simulator(study.result().datasets, study.path());
    const bool is_around = !simulator.parameters.empty();
    std::string effects = effect_table(loop);
    for (const StoredLoop::Effect& effect : loop.effects) effects += effect_lines(effect);
    if (const std::string worth = worth_table(loop); !worth.empty())
        effects += "\n" + worth;
    if (const std::string settings = setting_table(loop); !settings.empty())
        effects += "\n" + settings;
    effects += is_around ? simulator_given_table(simulator) : sections_of(loop);
    const std::string building = study.path().substr(0, study.path().rfind('/'));
    const Texts of_data = study.elsewhere(building + "/data").texts("finding");
    std::string text = fmt::format("\n{}: {}\n", study.path(), count_of(loop));
    for (const std::string& part :
         {failure_lines(study), loop_decision_table(loop, of_data),
          loop_structure_table(loop), loop_power_table(loop),
          loop_unexplained_table(loop), loop_localisation_table(loop), hours_table(loop),
          parameter_table(loop), simulator_tables(simulator),
          step_table(loop) + end_lines(loop), effects, function_table(loop),
          next_measurement_tables(loop), loop_headline(loop) + loop_fit_table(loop)})
        if (!part.empty()) text += "\n" + part;
    return text;
}

}  // namespace bemcal::report
