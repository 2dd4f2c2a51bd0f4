/// The kind "grid": values of each parameter, stages by hand, the rule of the k nearest,
/// targets; checked against the buildings or the [simulator].
/// Source: paper 3 (Basurra and Jankovic), whose own grids were edited by hand.
/// Targets are read by `read_targets`, refinement is in `grid_rounds`.
#include "job/grid_kind.hpp"

#include "description/words.hpp"
#include "job/emulated.hpp"
#include "job/kind.hpp"
#include "job/names.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

namespace {

using calibration::NamedGrid;
using schema::Type;

constexpr double inf = std::numeric_limits<double>::infinity();

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"grid\"", "",
     "Every combination of given values is simulated and held against measured numbers; "
     "the k nearest say which values survive, and the next grid is refined around them."},
    {"study.grid", "[study.grid]", "",
     "Values of parameters, NAME = [1, 3, 5]; every combination is simulated, and "
     "parameters that are not named stay nominal.",
     true},
    {"study.stage", "[[study.stage]]", "",
     "The same for the second stage, and the third, in place of a refinement.", true},
};

constexpr schema::Key keys[] = {
    {"study", "period", Type::text, "", "", 0, 0, "Default: the first."},
    {"study", "grid", Type::table, "", "", 0, 0, "[study.grid]"},
    {"study", "stage", Type::tables, "", "", 0, 0, "[[study.stage]]"},
    {"study", "target", Type::tables, "", "", 0, 0, "[[study.target]]"},
    {"study", "k", Type::integer, "", "7", 1, 1e9, "So many nearest points are kept."},
    {"study", "k_rule", Type::choice, "given|sqrt_n", "given", 0, 0,
     "sqrt_n: the square root of the stage's points, in place of k."},
    {"study", "radius", Type::number, "", "", 0, 1e300,
     "Of the surroundings in which points are counted, in the distance's unit; default: "
     "half the distance of the k-th nearest."},
    {"study", "density_threshold", Type::number, "", "", 0, 1e300,
     "Share of the stage's points per volume of the surroundings, above which their "
     "nearest is left out; default: that of the k nearest in the ball that they fill "
     "around the reference."},
    {"study", "distance", Type::choice, "euclidean|scaled", "euclidean", 0, 0,
     "Of the errors in per cent, or of the errors over their scales."},
    {"study", "target_error", Type::number, "%", "0", 0, 1e6,
     "It ends where the nearest point is no further off (Euclidean, in per cent)."},
    {"study", "most_stages", Type::integer, "", "", 1, 1000,
     "Default: those given, or 10 where only the first is."},
    {"study", "budget", Type::integer, "", "100000", 1, 1e12,
     "Points of all stages together at most."},
    {"study", "threshold", Type::number, "-", "0.05", 0, 1,
     "Total-order index above which a fixed parameter counts as determined."},
    {"study", "points_per_item", Type::integer, "", "128", 1, 1 << 20,
     "Points that are handed out together."},
};

std::vector<double> read_values_of(const schema::Section& section,
                                   const std::string& name) {
    const schema::Key row{section.schema(), "",   Type::numbers, "",
                          nullptr,          -inf, inf,           ""};
    const schema::Node& list = section.node(name);
    if (list.kind != schema::Node::Kind::array)
        section.fail_value(name, "expected a list of numbers");
    std::vector<double> values;
    values.reserve(list.entries.size());
    for (const schema::Entry& value : list.entries)
        values.push_back(schema::checked_number(value.node, row, section.where(name)));
    if (values.empty()) section.fail(name, "is empty; expected the values to try");
    std::ranges::sort(values);
    const auto twice = std::ranges::adjacent_find(values);
    if (twice != values.end())
        section.fail(name, fmt::format("{} stands there twice; expected each value once",
                                       schema::plain(*twice)));
    return values;
}

/// [study.grid] or a [[study.stage]]: rising values by parameter.
NamedGrid read_values(const schema::Section& section) {
    NamedGrid grid;
    for (const schema::Entry& entry : section.root().entries)
        grid.emplace_back(entry.key, read_values_of(section, entry.key));
    if (grid.empty())
        section.fail("", "is empty; expected values of a parameter, air_change = [1, 3]");
    return grid;
}

std::vector<NamedGrid> read_grids(const schema::Section& section) {
    if (!section.has("grid"))
        section.fail("grid",
                     "is missing; expected a section [study.grid] with values of "
                     "each parameter: air_change = [1, 3, 5]");
    std::vector<NamedGrid> grids{read_values(section.table("grid", "study.grid"))};
    for (const schema::Section& stage : section.tables("stage", "study.stage"))
        grids.push_back(read_values(stage));
    return grids;
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

int read_most_stages(const schema::Section& section, std::size_t n_given) {
    if (section.has("most_stages"))
        return static_cast<int>(section.integer("most_stages"));
    return n_given > 1 ? static_cast<int>(n_given) : 10;
}

calibration::GridOptions read_options(const schema::Section& section) {
    calibration::GridOptions options;
    options.grids = read_grids(section);
    options.nearest = read_nearest(section);
    options.distance = section.choice_as<calibration::GridDistance>("distance");
    options.target_error = section.number("target_error");
    options.most_stages = read_most_stages(section, options.grids.size());
    options.budget = section.integer("budget");
    options.index_threshold = section.number("threshold");
    options.points_per_item =
        static_cast<std::size_t>(section.integer("points_per_item"));
    return options;
}

void read(const StudySource& source, StudySpec& study) {
    GridStudy grid{read_options(source.section), {}, read_runs(source)};
    check_sizes(source.section, grid.options);
    grid.targets = read_targets(source.section);
    study.period = source.section.text("period");
    study.options = std::move(grid);
}

/// Whose parameters the grid's are.
struct Owner {
    const std::vector<physics::Parameter>& parameters;
    std::string name;
};

void check_values_of(const schema::Section& section, const std::string& name,
                     const std::vector<double>& values, const Owner& owner) {
    description::check_word(section, name, name, description::names_of(owner.parameters),
                            "parameter of " + owner.name);
    const auto& parameter =
        *std::ranges::find(owner.parameters, name, &physics::Parameter::name);
    for (const double value : values)
        if (value < parameter.least || value > parameter.most)
            section.fail(name,
                         fmt::format("{} lies outside the parameter's range; "
                                     "expected {} to {}",
                                     schema::plain(value), schema::plain(parameter.least),
                                     schema::plain(parameter.most)));
}

/// Each parameter is there, and its values lie within its range.
void check_values(const schema::Section& section, const NamedGrid& grid,
                  const Owner& owner) {
    for (const auto& [name, values] : grid) check_values_of(section, name, values, owner);
}

void check_grids(const schema::Section& section, const std::vector<NamedGrid>& grids,
                 const Owner& owner) {
    check_values(section.table("grid", "study.grid"), grids[0], owner);
    std::size_t next = 1;
    for (const schema::Section& stage : section.tables("stage", "study.stage"))
        check_values(stage, grids[next++], owner);
}

void check_names_in(const schema::Section& section, const BuildingNames& names) {
    section.attempt_each(section.root().entries, [&](const schema::Entry& entry) {
        check_parameters(section, entry.key.c_str(), {entry.key}, names);
    });
}

void check_names(const NamePlace& place) {
    const schema::Section& section = place.section;
    section.attempt_all(
        [&] {
            if (section.has("grid"))
                check_names_in(section.table("grid", "study.grid"), place.names);
        },
        [&] {
            for (const schema::Section& stage : section.tables("stage", "study.stage"))
                check_names_in(stage, place.names);
        },
        [&] { check_target_meters(section, place.names); });
}

void check(const StudyPlace& place, StudySpec& study) {
    const auto& [options, targets, n_runs] = study.as<GridStudy>();
    if (const auto& simulator = place.job.simulator) {
        check_grids(place.section, options.grids,
                    {simulator->parameters(), "the simulator"});
        check_targets(place.section, targets, *simulator);
        check_emulated(place, n_runs);
        return;
    }
    for (const study::Case& building : place.job.buildings)
        check_grids(place.section, options.grids, {building.parameters, building.name});
    check_targets(place.section, targets, study.period, place.job.buildings);
}

Stages stages(const StudySpec& study, const Job& job) {
    const auto& grid = study.as<GridStudy>();
    if (job.simulator)
        return stages_of_simulator(study, job, grid.n_runs, [&](auto simulator) {
            const auto options = options_for(grid, *simulator);
            return calibration::make_grid(study.name, std::move(simulator), options);
        });
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        const study::Period& period = period_of(building, study.period);
        return calibration::make_grid(std::move(name),
                                      target_simulator(grid.targets, building, period),
                                      options_for(grid, building, period));
    });
}

/// "air 5 x lights 6 = 30 points"
std::string words_of(const NamedGrid& grid) {
    std::vector<std::string> axes;
    for (const auto& [name, values] : grid)
        axes.push_back(fmt::format("{} {}", name, values.size()));
    return fmt::format("{} = {} points", fmt::join(axes, " x "), n_points(grid));
}

std::vector<Fitted> fitted(const StudySpec& study, const study::Case& building) {
    return fitted_by(study.as<GridStudy>().targets, study.period, building);
}

std::string sentence(const StudySpec& study) {
    const calibration::GridOptions& options = study.as<GridStudy>().options;
    std::vector<std::string> grids;
    grids.reserve(options.grids.size());
    for (const NamedGrid& grid : options.grids) grids.push_back(words_of(grid));
    const bool is_refined = options.most_stages > static_cast<int>(options.grids.size());
    return fmt::format("{}{}", fmt::join(grids, ", then "),
                       is_refined ? fmt::format(", then refined by itself: at most {} "
                                                "points in {} stages",
                                                options.budget, options.most_stages)
                                  : std::string());
}

}  // namespace

calibration::GridOptions options_for(const GridStudy& grid, const study::Case& building,
                                     const study::Period& period) {
    calibration::GridOptions options = grid.options;
    for (std::size_t p = 0; p < building.priors.size(); ++p)
        if (!building.priors[p].values.empty())
            options.discrete.push_back(building.parameters[p].name);
    options.targets = targets_of(grid.targets, building, period);
    return options;
}

calibration::GridOptions options_for(const GridStudy& grid,
                                     const study::Simulator& simulator) {
    calibration::GridOptions options = grid.options;
    if (simulator.is_slow()) options.points_per_item = 1;
    options.targets = targets_of(grid.targets, simulator);
    return options;
}

extern const Kind grid_kind{.word = "grid",
                            .sections = {sections, target_sections},
                            .keys = {keys, target_keys, emulated_keys},
                            .takes_simulator = true,
                            .read = read,
                            .check_names = check_names,
                            .check = check,
                            .stages = stages,
                            .sentence = sentence,
                            .points_of = stage_name,
                            .fitted = fitted};

}  // namespace bemcal::job
