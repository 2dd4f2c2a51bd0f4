/// Reads [[study.target]], and makes targets of them: what a building's meters show of
/// each output, or the numbers that the job gives; of another program the job's only.
/// Follows from paper 3's bills: electricity and gas of the period by default, errors in
/// per cent, so no target may be 0.
/// Errors are computed by the grid or the optimisation.
#include "job/targets.hpp"

#include "description/words.hpp"
#include "input/suggest.hpp"
#include "input/units.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using calibration::GridTarget;
using calibration::Statistic;
using physics::Quantity;

constexpr const char* target_section = "study.target";

input::UnitKind unit_kind_of(const calibration::OutputSpec& output) {
    if (physics::is_temperature(output.quantity)) return input::UnitKind::temperature;
    return output.statistic == Statistic::peak ? input::UnitKind::power
                                               : input::UnitKind::energy;
}

const input::Unit& read_unit(const schema::Section& section, input::UnitKind kind) {
    const char* usual = kind == input::UnitKind::energy  ? "kWh"
                        : kind == input::UnitKind::power ? "kW"
                                                         : "degC";
    const input::Unit* unit =
        input::find_unit(section.has("unit") ? section.text("unit") : usual);
    if (unit == nullptr || unit->kind != kind)
        section.fail_value("unit", fmt::format("expected one like {}", usual));
    return *unit;
}

/// Numbers that the job gives, in the output's own unit.
std::vector<double> read_measured(const schema::Section& section,
                                  const TargetSpec& target) {
    const bool by_month =
        target.simulator_output.empty() && target.output.statistic == Statistic::months;
    const char* key = by_month ? "measured_months" : "measured";
    if (!section.has(key)) return {};
    std::vector<double> values =
        by_month ? section.numbers(key) : std::vector<double>{section.number(key)};
    if (std::ranges::count(values, 0.0) > 0)
        section.fail_value(key,
                           "errors are in per cent of it; expected a number other "
                           "than 0");
    if (!target.simulator_output.empty()) return values;
    const input::Unit& unit = read_unit(section, unit_kind_of(target.output));
    for (double& value : values) value = value * unit.factor + unit.offset;
    return values;
}

TargetSpec read_target(const schema::Section& section) {
    TargetSpec target;
    if (section.has("output")) {
        target.simulator_output = section.text("output");
    } else {
        target.output.quantity = section.choice_as<Quantity>("quantity");
        target.output.statistic = section.choice_as<Statistic>("statistic");
    }
    target.measured = read_measured(section, target);
    if (target.measured.empty() && section.has("meter"))
        target.meter = section.text("meter");
    section.number_if("scale", target.scale);
    return target;
}

/// Annual electricity and gas, where the job does not say.
TargetSpecs or_usual(const TargetSpecs& specs) {
    if (!specs.empty()) return specs;
    TargetSpecs usual(2);
    usual[0].output = {Quantity::electricity, Statistic::period};
    usual[1].output = {Quantity::gas, Statistic::period};
    return usual;
}

std::string no_meter(const std::string& name, const std::string& building) {
    return fmt::format("\"{}\" is no meter of {}", name, building);
}

/// The total of a meter is held against the same quantity.
void check_quantity(const TargetSpec& target, const study::Meter& meter) {
    if (meter.quantity != target.output.quantity)
        throw std::invalid_argument(fmt::format(
            "the meter \"{}\" is of {}, and the target of {}; expected a meter "
            "of {}",
            meter.name, physics::name_of(meter.quantity),
            physics::name_of(target.output.quantity),
            physics::name_of(target.output.quantity)));
}

std::size_t meter_of(const TargetSpec& target, const study::Case& building) {
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        const study::Meter& meter = building.meters[m];
        if (target.meter.empty() ? meter.quantity != target.output.quantity ||
                                       !study::has_reading(meter.values)
                                 : meter.name != target.meter)
            continue;
        check_quantity(target, meter);
        return m;
    }
    const char* quantity = physics::name_of(target.output.quantity);
    if (!target.meter.empty())
        throw std::invalid_argument(no_meter(target.meter, building.name));
    throw std::invalid_argument(
        fmt::format("the target {0} is missing: {1} has no meter of {0} with readings; "
                    "expected one, or a [[study.target]] with measured",
                    quantity, building.name));
}

std::vector<double> measured_of(const TargetSpec& target, const study::Case& building,
                                const study::Period& period) {
    if (target.measured.empty())
        return calibration::measured_outputs(target.output, building, period,
                                             meter_of(target, building));
    const std::size_t n = calibration::outputs_of(target.output, building, period).size();
    if (target.measured.size() != n)
        throw std::invalid_argument(
            fmt::format("{} numbers are measured, and {} has {} months; expected one for "
                        "each",
                        target.measured.size(), period.name, n));
    return target.measured;
}

void add(std::vector<GridTarget>& targets, const std::string& output, double measured,
         double scale) {
    if (measured == 0)
        throw std::invalid_argument(
            fmt::format("the target {} is 0, and errors are in per cent of it; expected "
                        "another number, or leave it out",
                        output));
    targets.push_back({output, measured, scale});
}

/// Where a mistake in the targets stands.
const char* key_of_targets(const schema::Section& study) {
    return study.has("target") ? "target" : "kind";
}

}  // namespace

TargetSpecs read_targets(const schema::Section& study) {
    TargetSpecs targets;
    for (const schema::Section& target : study.tables("target", target_section))
        targets.push_back(read_target(target));
    return targets;
}

std::vector<calibration::OutputSpec> outputs_of(const TargetSpecs& specs) {
    std::vector<calibration::OutputSpec> outputs;
    for (const TargetSpec& target : or_usual(specs)) outputs.push_back(target.output);
    return outputs;
}

std::vector<GridTarget> targets_of(const TargetSpecs& specs, const study::Case& building,
                                   const study::Period& period) {
    std::vector<GridTarget> targets;
    for (const TargetSpec& target : or_usual(specs)) {
        const auto outputs = calibration::outputs_of(target.output, building, period);
        const auto measured = measured_of(target, building, period);
        for (std::size_t k = 0; k < outputs.size(); ++k)
            add(targets, outputs[k].name, measured[k], target.scale);
    }
    return targets;
}

std::vector<GridTarget> targets_of(const TargetSpecs& specs,
                                   const study::Simulator& simulator) {
    const std::vector<std::string> names = description::names_of(simulator.outputs());
    if (specs.empty())
        throw std::invalid_argument(
            "the targets of a [simulator] are missing; expected a [[study.target]] with "
            "output and measured");
    std::vector<GridTarget> targets;
    for (const TargetSpec& target : specs) {
        if (target.simulator_output.empty())
            throw std::invalid_argument(fmt::format(
                "the target of a [simulator] has no output; expected output = "
                "\"{}\" in place of quantity",
                fmt::join(names, "\" or \"")));
        if (std::ranges::count(names, target.simulator_output) == 0)
            throw std::invalid_argument(fmt::format(
                "\"{}\" is no output of the simulator{}", target.simulator_output,
                input::suggestion(target.simulator_output, names)));
        if (target.measured.size() != 1)
            throw std::invalid_argument(
                fmt::format("the target {} is missing; expected it as measured",
                            target.simulator_output));
        add(targets, target.simulator_output, target.measured[0], target.scale);
    }
    return targets;
}

std::vector<Fitted> fitted_by(const TargetSpecs& specs, const std::string& period,
                              const study::Case& building) {
    Fitted fitted{period, {}};
    for (const TargetSpec& target : or_usual(specs))
        if (target.measured.empty() && target.output.statistic != Statistic::peak)
            fitted.meters.push_back(building.meters[meter_of(target, building)].name);
    if (fitted.meters.empty()) return {};
    return {std::move(fitted)};
}

std::shared_ptr<const study::Simulator> target_simulator(const TargetSpecs& specs,
                                                         const study::Case& building,
                                                         const study::Period& period) {
    return calibration::make_target_simulator(building, period, outputs_of(specs));
}

void check_target_meters(const schema::Section& study, const BuildingNames& names) {
    const auto check = [&](const schema::Section& target, const std::string& meter) {
        if (names.meters.empty() || std::ranges::count(names.meters, meter) > 0) return;
        if (target.is_lost(meter) || target.is_lost("meter")) throw schema::Follows();
        study.fail("target", no_meter(meter, names.building));
    };
    study.attempt_each(study.tables("target", target_section), [&](const auto& target) {
        for (const std::string& meter : words_at(target.root(), "meter"))
            check(target, meter);
    });
}

void check_targets(const schema::Section& study, const TargetSpecs& specs,
                   const std::string& period, const std::vector<study::Case>& buildings) {
    for (const study::Case& building : buildings)
        description::at_key(study, key_of_targets(study), [&] {
            targets_of(specs, building, period_of(building, period));
        });
    for (const schema::Section& target : study.tables("target", target_section))
        if (target.has("output"))
            target.fail("output",
                        "is of a [simulator]; expected the quantity of a "
                        "building");
}

void check_targets(const schema::Section& study, const TargetSpecs& specs,
                   const study::Simulator& simulator) {
    description::at_key(study, key_of_targets(study),
                        [&] { targets_of(specs, simulator); });
}

}  // namespace bemcal::job
