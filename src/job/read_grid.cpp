/// Reads a [[study]] of kind "grid": values of each parameter, stages by hand, the rule
/// of the k nearest, targets. Checks them against the buildings or the [simulator].
/// Source: paper 3 (Basurra and Jankovic), whose own grids were edited by hand.
/// What meters show is in `grid_spec`, refinement in `grid_rounds`.
#include "input/units.hpp"
#include "job/readers.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using calibration::NamedGrid;
using calibration::Statistic;
using physics::Quantity;

constexpr double inf = std::numeric_limits<double>::infinity();

/// [study.grid] or a [[study.stage]]: rising values by parameter.
NamedGrid read_values_of_grid(const schema::Section& section) {
    NamedGrid grid;
    for (const schema::Entry& entry : section.root().entries) {
        const schema::Key row{
            section.schema(), "", schema::Type::numbers, "", nullptr, -inf, inf, ""};
        const schema::Node& list = section.node(entry.key);
        if (list.kind != schema::Node::Kind::array)
            section.fail_value(entry.key, "expected a list of numbers");
        std::vector<double> values;
        values.reserve(list.entries.size());
        for (const schema::Entry& value : list.entries)
            values.push_back(
                schema::checked_number(value.node, row, section.where(entry.key)));
        if (values.empty())
            section.fail(entry.key, "is empty; expected the values to try");
        std::ranges::sort(values);
        const auto twice = std::ranges::adjacent_find(values);
        if (twice != values.end())
            section.fail(entry.key, fmt::format("{} stands there twice; expected each "
                                                "value once",
                                                schema::plain(*twice)));
        grid.emplace_back(entry.key, std::move(values));
    }
    if (grid.empty())
        section.fail("", "is empty; expected values of a parameter, air_change = [1, 3]");
    return grid;
}

std::size_t n_points(const NamedGrid& grid) {
    std::size_t n = 1;
    for (const auto& [name, values] : grid)
        n = std::min<std::size_t>(n * values.size(), std::size_t{1} << 40);
    return n;
}

void check_sizes(const schema::Section& section,
                 const calibration::GridOptions& options) {
    std::size_t n = 0;
    for (const NamedGrid& grid : options.grids) {
        n += n_points(grid);
        const bool by_number = options.nearest.count_rule == stats::CountRule::given;
        if (by_number && options.nearest.k > n_points(grid))
            section.fail_value("k",
                               fmt::format("a grid of this study has {} points only; "
                                           "expected at most as many",
                                           n_points(grid)));
    }
    if (n > static_cast<std::size_t>(options.budget))
        section.fail("budget", fmt::format("is {}, and the grids given have {} points; "
                                           "expected fewer values, or a larger budget",
                                           options.budget, n));
}

stats::NearestOptions read_nearest(const schema::Section& section) {
    stats::NearestOptions nearest;
    nearest.count_rule = section.choice_as<stats::CountRule>("k_rule");
    if (nearest.count_rule == stats::CountRule::given)
        nearest.k = static_cast<std::size_t>(section.integer("k"));
    if (section.has("radius")) nearest.radius = section.number("radius");
    if (section.has("density_threshold"))
        nearest.threshold = section.number("density_threshold");
    return nearest;
}

input::UnitKind unit_kind_of(const calibration::OutputSpec& output) {
    if (physics::is_temperature(output.quantity)) return input::UnitKind::temperature;
    return output.statistic == Statistic::peak ? input::UnitKind::power
                                               : input::UnitKind::energy;
}

/// Numbers that the job gives, in the output's own unit.
std::vector<double> read_measured(const schema::Section& section,
                                  const GridTargetSpec& target) {
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
    const input::UnitKind kind = unit_kind_of(target.output);
    const char* usual = kind == input::UnitKind::energy  ? "kWh"
                        : kind == input::UnitKind::power ? "kW"
                                                         : "degC";
    const input::Unit* unit =
        input::find_unit(section.has("unit") ? section.text("unit") : usual);
    if (unit == nullptr || unit->kind != kind)
        section.fail_value("unit", fmt::format("expected one like {}", usual));
    for (double& value : values) value = value * unit->factor + unit->offset;
    return values;
}

GridTargetSpec read_target(const schema::Section& section) {
    GridTargetSpec target;
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

/// Each parameter is there, and its values lie within its range.
void check_values(const schema::Section& section, const NamedGrid& grid,
                  const std::vector<physics::Parameter>& parameters,
                  const std::string& owner) {
    std::vector<std::string> names;
    names.reserve(parameters.size());
    for (const physics::Parameter& parameter : parameters)
        names.push_back(parameter.name);
    for (const auto& [name, values] : grid) {
        check_word(section, name, name, names, "parameter of " + owner);
        const auto& parameter =
            *std::ranges::find(parameters, name, &physics::Parameter::name);
        for (const double value : values)
            if (value < parameter.least || value > parameter.most)
                section.fail(name, fmt::format("{} lies outside the parameter's range; "
                                               "expected {} to {}",
                                               schema::plain(value),
                                               schema::plain(parameter.least),
                                               schema::plain(parameter.most)));
    }
}

void check_values(const schema::Section& section, const GridSpec& spec,
                  const std::vector<physics::Parameter>& parameters,
                  const std::string& owner) {
    check_values(section.table("grid", "study.grid"), spec.options.grids[0], parameters,
                 owner);
    std::size_t next = 1;
    for (const schema::Section& stage : section.tables("stage", "study.stage"))
        check_values(stage, spec.options.grids[next++], parameters, owner);
}

}  // namespace

GridSpec read_grid(const schema::Section& section) {
    GridSpec spec;
    calibration::GridOptions& options = spec.options;
    if (!section.has("grid"))
        section.fail("grid",
                     "is missing; expected a section [study.grid] with values of "
                     "each parameter: air_change = [1, 3, 5]");
    options.grids = {read_values_of_grid(section.table("grid", "study.grid"))};
    for (const schema::Section& stage : section.tables("stage", "study.stage"))
        options.grids.push_back(read_values_of_grid(stage));
    const auto n_given = static_cast<int>(options.grids.size());
    options.nearest = read_nearest(section);
    options.distance = section.choice_as<calibration::GridDistance>("distance");
    options.target_error = section.number("target_error");
    options.most_stages = section.has("most_stages")
                              ? static_cast<int>(section.integer("most_stages"))
                          : n_given > 1 ? n_given
                                        : 10;
    options.budget = section.integer("budget");
    options.index_threshold = section.number("threshold");
    if (section.has("points_per_item"))
        options.points_per_item =
            static_cast<std::size_t>(section.integer("points_per_item"));
    check_sizes(section, options);
    spec.targets = read_targets(section);
    return spec;
}

std::vector<GridTargetSpec> read_targets(const schema::Section& section) {
    std::vector<GridTargetSpec> targets;
    for (const schema::Section& target : section.tables("target", "study.target"))
        targets.push_back(read_target(target));
    return targets;
}

void check_grid(const schema::Section& section, const GridSpec& spec,
                const std::string& period, const std::vector<study::Case>& buildings) {
    for (const study::Case& building : buildings)
        check_values(section, spec, building.parameters, building.name);
    check_targets(section, spec, period, buildings);
}

void check_targets(const schema::Section& section, const GridSpec& spec,
                   const std::string& period, const std::vector<study::Case>& buildings) {
    for (const study::Case& building : buildings)
        at_key(section, section.has("target") ? "target" : "kind",
               [&] { options_for(spec, building, period_of(building, period)); });
    for (const schema::Section& target : section.tables("target", "study.target"))
        if (target.has("output"))
            target.fail("output",
                        "is of a [simulator]; expected the quantity of a "
                        "building");
}

void check_grid(const schema::Section& section, const GridSpec& spec,
                const study::Simulator& simulator) {
    check_values(section, spec, simulator.parameters(), "the simulator");
    check_targets(section, spec, simulator);
}

void check_targets(const schema::Section& section, const GridSpec& spec,
                   const study::Simulator& simulator) {
    at_key(section, section.has("target") ? "target" : "kind",
           [&] { options_for(spec, simulator); });
}

}  // namespace bemcal::job
