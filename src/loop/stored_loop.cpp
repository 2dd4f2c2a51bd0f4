/// Turns a loop's result into datasets and back, by one list of names.
/// Follows from `StoredLoop`: a struct is a row, its fields are columns. Units and
/// meanings are the store's layout's.
/// An older result may lack datasets; what version 0.1.0 has in words is taken from them.
#include "loop/stored_loop.hpp"

#include "loop/stored_simulator.hpp"
#include "study/columns.hpp"
#include "study/datasets.hpp"
#include "study/decision.hpp"

#include <algorithm>
#include <iterator>

namespace bemcal::loop {
namespace {

/// Calls `table` with the dimension, rows and fields of each list.
template <class Loop, class Table>
void visit_tables(Loop& loop, Table&& table) {
    table("channel", loop.channels, [](auto& row, auto&& see) {
        see("channel", row.name);
        see("channel_unit", row.unit);
        see("unexplained", row.unexplained);
        see("unexplained_where", row.unexplained_where);
    });
    const auto names = [&](const char* name, auto& rows) {
        table(name, rows, [name](auto& row, auto&& see) { see(name, row); });
    };
    names("model", loop.models);
    names("period", loop.periods);
    names("resolution", loop.resolutions);
    names("metric", loop.metrics);
    names("hook", loop.hooks);
    names("driver", loop.drivers);
    table("parameter", loop.parameters, [](auto& row, auto&& see) {
        see("parameter", row.name);
        see("parameter_unit", row.unit);
        see("parameter_prior_mean", row.prior_mean);
        see("parameter_prior_sd", row.prior_sd);
    });
    table("structure", loop.structures, [](auto& row, auto&& see) {
        see("structure", row.name);
        see("structure_score", row.score);
    });
    table("refinement", loop.refinements, [](auto& row, auto&& see) {
        see("refinement", row.name);
        see("refinement_is", row.what);
    });
    table("step", loop.steps, [](auto& row, auto&& see) {
        see("step_effect", row.effect);
        see("step_verdict", row.verdict);
        see("step_gain", row.gain);
        see("step_threshold", row.threshold);
        see("step_score", row.score);
    });
    table("candidate", loop.candidates, [](auto& row, auto&& see) {
        see("candidate", row.name);
        see("candidate_gain", row.gain);
    });
    table("effect", loop.effects, [](auto& row, auto&& see) {
        see("effect", row.name);
        see("effect_hook", row.hook);
        see("effect_driver", row.driver);
        see("effect_shape", row.shape);
        see("effect_gate", row.gate);
        see("effect_unit", row.unit);
        see("effect_class", row.class_in_words);
        see("effect_separates", row.separates);
        see("effect_section", row.section);
        see("effect_coefficient", row.coefficient);
        see("effect_least", row.least);
        see("effect_most", row.most);
        see("effect_gain", row.gain);
        see("effect_adequate", row.adequate);
        see("effect_doubt", row.doubt);
    });
    table("effect_value", loop.effect_values, [](auto& row, auto&& see) {
        see("effect_value_of", row.of);
        see("effect_value_effect", row.effect);
        see("effect_value_unit", row.unit);
        see("effect_value", row.value);
        see("effect_value_least", row.least);
        see("effect_value_most", row.most);
    });
    table("setting", loop.settings, [](auto& row, auto&& see) {
        see("setting", row.name);
        see("setting_parameter", row.parameter);
        see("setting_unit", row.unit);
        see("setting_described", row.described);
        see("setting_found", row.found);
        see("setting_least", row.least);
        see("setting_most", row.most);
        see("setting_distance", row.distance);
    });
    table("function", loop.functions, [](auto& row, auto&& see) {
        see("function", row.name);
        see("function_hook", row.hook);
        see("function_driver", row.driver);
        see("function_unit", row.unit);
        see("function_driver_unit", row.driver_unit);
        see("function_size", row.size);
        see("function_evidence", row.evidence);
    });
    table("function_point", loop.function_points, [](auto& row, auto&& see) {
        see("function_point_of", row.function);
        see("function_point_at", row.at);
        see("function_point_and_at", row.and_at);
        see("function_point_value", row.value);
        see("function_point_least", row.least);
        see("function_point_most", row.most);
    });
    table("learned_schedule", loop.schedules, [](auto& row, auto&& see) {
        see("learned_schedule", row.name);
        see("learned_schedule_use", row.use);
        see("learned_schedule_sentence", row.sentence);
        see("learned_schedule_evidence", row.evidence);
    });
    table("learned_hours", loop.hours, [](auto& row, auto&& see) {
        see("learned_hours_of", row.schedule);
        see("learned_hours_days", row.days);
        see("learned_hours_from", row.from);
        see("learned_hours_until", row.until);
        see("learned_hours_probability", row.probability);
        see("learned_hours_from_least", row.from_least);
        see("learned_hours_from_most", row.from_most);
        see("learned_hours_until_least", row.until_least);
        see("learned_hours_until_most", row.until_most);
        see("learned_hours_usual_from", row.usual_from);
        see("learned_hours_usual_until", row.usual_until);
    });
    table("job_part", loop.job_parts, [](auto& row, auto&& see) {
        see("job_part", row.of);
        see("job_part_section", row.section);
    });
    table("measurement", loop.measurements, [](auto& row, auto&& see) {
        see("measurement", row.measure);
        see("measurement_question", row.question);
        see("measurement_kind", row.kind);
        see("measurement_from", row.from);
        see("measurement_weeks", row.weeks);
        see("measurement_now", row.now);
        see("measurement_then", row.then);
        see("measurement_advised", row.is_advised);
    });
    table("power", loop.seen, [](auto& row, auto&& see) {
        see("power_effect", row.effect);
        see("power_alias", row.alias);
        see("power_alias_kind", row.alias_kind);
        see("power_bias_parameter", row.parameter);
        see("power_detectability", row.detectability);
        see("power_visibility", row.visibility);
        see("power_alias_correlation", row.correlation);
        see("power_bias", row.bias);
    });
    table("decision", loop.decisions, [](auto& row, auto&& see) {
        see("decision_series", row.series);
        see("decision_finding", row.finding);
        see("decision_action", row.action);
        see("decision_kind", row.kind);
    });
}

template <class Loop, class See>
void visit_arrays(Loop& loop, See&& see) {
    see("parameter_value", loop.parameter_value);
    see("parameter_sd", loop.parameter_sd);
    see("step_error", loop.step_error);
    see("localisation", loop.localisation);
    see("localisation_after", loop.localisation_after);
    see("fit", loop.fit);
    see("coverage", loop.coverage);
}

template <class Loop, class See>
void visit_numbers(Loop& loop, See&& see) {
    see("misfit", loop.misfit);
    see("least_detectability", loop.least_detectability);
    see("same_signature", loop.same_signature);
}

constexpr const char* structure_chosen = "structure_chosen";

/// A name of an effect's class.
struct Member {
    double effect = 0;  ///< index of the effect
    std::string name;
    double probability = nan;
};
constexpr const char* class_member = "class_member";
void visit_member(auto& row, auto&& see) {
    see("effect_class_of", row.effect);
    see("effect_class_member", row.name);
    see("effect_class_probability", row.probability);
}

void add_members(const std::string& group, const StoredLoop& loop,
                 std::vector<study::Dataset>& datasets) {
    std::vector<Member> members;
    for (std::size_t k = 0; k < loop.effects.size(); ++k)
        for (const auto& [name, probability] : loop.effects[k].members)
            members.push_back({static_cast<double>(k), name, probability});
    study::add_rows(
        group, class_member, members,
        [](auto& row, auto&& see) { visit_member(row, see); }, datasets);
}

void read_members(const std::vector<study::Dataset>& datasets, const std::string& group,
                  StoredLoop& loop) {
    const auto members = study::rows_in<Member>(
        datasets, group, [](auto& row, auto&& see) { visit_member(row, see); });
    const std::size_t n = loop.effects.size();
    for (const Member& member : members)
        if (const std::size_t k = study::place_in(member.effect, n); k < n)
            loop.effects[k].members.push_back({member.name, member.probability});
}

/// Names that version 0.1.0 parted by semicolons.
std::vector<StoredLoop::Effect::Member> parted(const std::string& names) {
    std::vector<StoredLoop::Effect::Member> parts;
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find("; ", begin), names.size());
        parts.push_back({names.substr(begin, end - begin)});
        begin = end + 2;
    }
    return parts;
}

/// A result of version 0.1.0 says some of it in words only, here and nowhere else.
void take_words_of_0_1_0(StoredLoop& loop) {
    for (StoredLoop::Effect& effect : loop.effects)
        if (effect.members.empty()) effect.members = parted(effect.class_in_words);
    for (StoredLoop::Seen& seen : loop.seen)
        if (seen.alias_kind.empty() && seen.alias == words_of_parameters)
            seen.alias_kind = name_of(AliasKind::parameters);
    for (StoredLoop::Decision& decision : loop.decisions)
        if (decision.kind.empty() && decision.finding.starts_with("one class with "))
            decision.kind = study::name_of(study::DecisionKind::one_class);
}

void add_period(const StoredPeriod& period, study::DatasetBuilder& datasets) {
    datasets.times(period.name + "/time", period.begins);
    datasets.times(period.name + "/month", period.months, "month");
    datasets.vector(period.name + "/outdoor_temperature", "time",
                    period.outdoor_temperature);
    for (const StoredPeriod::Channel& channel : period.channels) {
        const std::string folder = period.name + "/" + channel.name + "/";
        datasets.vector(folder + "measured", "time", channel.measured);
        datasets.array(folder + "simulated", channel.simulated);
        datasets.vector(folder + "predicted_q05", "time", channel.q05);
        datasets.vector(folder + "predicted_q95", "time", channel.q95);
        datasets.vector(folder + "month_predicted", "month", channel.month);
        datasets.vector(folder + "month_q05", "month", channel.month_q05);
        datasets.vector(folder + "month_q95", "month", channel.month_q95);
        if (channel.reading_begin.empty()) continue;
        datasets.times(folder + "reading_begin", channel.reading_begin, "reading");
        datasets.times(folder + "reading_end", channel.reading_end, "reading");
        datasets.vector(folder + "reading_measured", "reading", channel.reading_measured);
    }
}

}  // namespace

bool StoredLoop::Decision::is_of_class() const {
    return kind == study::name_of(study::DecisionKind::one_class);
}

std::vector<study::Dataset> datasets_of(const std::string& group, const StoredLoop& loop,
                                        const std::vector<StoredPeriod>& periods) {
    std::vector<study::Dataset> datasets;
    visit_tables(loop, [&](const char* dim, const auto& rows, const auto& visit) {
        study::add_rows(group, dim, rows, visit, datasets);
    });
    add_members(group, loop, datasets);
    study::DatasetBuilder others(group);
    others.kind("loop");
    visit_arrays(loop, [&](const char* leaf, const study::Array& array) {
        others.array(leaf, array);
    });
    visit_numbers(loop,
                  [&](const char* leaf, double number) { others.scalar(leaf, number); });
    others.text(structure_chosen, loop.structure_chosen);
    for (const StoredPeriod& period : periods) add_period(period, others);
    std::ranges::move(others.take(), std::back_inserter(datasets));
    return datasets;
}

StoredLoop stored_loop(const std::vector<study::Dataset>& datasets,
                       const std::string& group) {
    StoredLoop loop;
    const auto find = [&](const char* leaf) {
        return study::find_dataset(datasets, group + "/" + leaf);
    };
    visit_tables(loop, [&](const char*, auto& rows, const auto& visit) {
        using Row = std::ranges::range_value_t<decltype(rows)>;
        rows = study::rows_in<Row>(datasets, group, visit);
    });
    read_members(datasets, group, loop);
    take_words_of_0_1_0(loop);
    visit_arrays(loop, [&](const char* leaf, study::Array& array) {
        if (const study::Dataset* stored = find(leaf))
            array = {stored->dims, stored->shape, stored->values};
    });
    visit_numbers(loop, [&](const char* leaf, double& number) {
        const study::Dataset* stored = find(leaf);
        if (stored != nullptr && !stored->values.empty()) number = stored->values[0];
    });
    const study::Dataset* chosen = find(structure_chosen);
    if (chosen != nullptr && !chosen->texts.empty())
        loop.structure_chosen = chosen->texts[0];
    return loop;
}

std::vector<std::string> stored_names() {
    std::vector<study::Dataset> all = datasets_of("", {}, {});
    std::ranges::move(datasets_of("", StoredSimulator{}), std::back_inserter(all));
    std::vector<std::string> names;
    for (const study::Dataset& dataset : all) {
        names.push_back(dataset.path.substr(1));
        names.insert(names.end(), dataset.dims.begin(), dataset.dims.end());
    }
    return names;
}

}  // namespace bemcal::loop
