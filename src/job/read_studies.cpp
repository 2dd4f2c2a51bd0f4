/// Reads [[study]]: kind and name, then the keys of that kind by its reader.
/// Sensitivities and screenings are read here.
/// Source: paper 1, step 1, for inputs of its single hour that are fixed case by case.
/// What a study needs of buildings is in `check_studies_of`, a retrofit in
/// `read_scenarios`.
#include "input/suggest.hpp"
#include "job/readers.hpp"
#include "job/result_names.hpp"
#include "physics/office_hour.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using physics::Quantity;

void read_sensitivity(const schema::Section& section, StudySpec& study) {
    sensitivity::SensitivityOptions& options = study.sensitivity;
    options.n_base = static_cast<std::size_t>(section.integer("n_base"));
    options.scramble = section.flag("scramble");
    options.threshold = section.number("threshold");
    if (study.kind == StudyKind::hourly_sensitivity) {
        study.quantities = {section.choice_as<Quantity>("quantity")};
        if (options.n_base < 64)
            section.fail_value("n_base",
                               "expected at least 64: the intervals come from 32 blocks");
    } else {
        options.n_bootstrap = static_cast<int>(section.integer("n_bootstrap"));
    }
    if (study.kind == StudyKind::sensitivity) {
        study.quantities = read_quantities(section, "quantities");
        if (study.quantities.empty())
            study.quantities = {Quantity::heating, Quantity::cooling};
    }
    if (study.kind != StudyKind::office_hour_sensitivity)
        study.period = section.text("period");
}

void read_screening(const schema::Section& section,
                    calibration::ScreeningOptions& options) {
    options.n_points = static_cast<std::size_t>(section.integer("n_points"));
    options.points_per_item =
        static_cast<std::size_t>(section.integer("points_per_item"));
    options.keep_points = section.flag("keep_points");
    options.n_best = static_cast<std::size_t>(section.integer("n_best"));
}

}  // namespace

const physics::OfficeHourInput& office_hour_input(const schema::Section& section,
                                                  const std::string& name) {
    std::vector<std::string> names;
    for (const physics::OfficeHourInput& input : physics::office_hour_inputs()) {
        if (name == input.name) return input;
        names.emplace_back(input.name);
    }
    section.fail(name, fmt::format("unknown input{}", input::suggestion(name, names)));
}

namespace {

/// The values of one input, one for each case.
std::vector<double> read_cases(const schema::Section& section,
                               const schema::Entry& entry) {
    const physics::OfficeHourInput& input = office_hour_input(section, entry.key);
    const schema::Key row{"study.fixed", input.name,    schema::Type::numbers,
                          input.unit,    nullptr,       -1e9,
                          1e9,           input.sentence};
    const std::string where =
        fmt::format("{}:{}: study.fixed.{}", section.file(), entry.line, entry.key);
    std::vector<double> values;
    for (const schema::Entry& value : section.node(entry.key).entries)
        values.push_back(schema::checked_number(value.node, row, where));
    if (values.empty())
        section.fail(entry.key, "has no values; expected a list of numbers");
    return values;
}

void read_fixed(const schema::Section& section, StudySpec& study) {
    if (!section.has("fixed")) return;
    const schema::Section table = section.table("fixed", "study.fixed");
    for (const schema::Entry& entry : table.root().entries) {
        study.fixed.emplace_back(entry.key, read_cases(table, entry));
        if (study.fixed.back().second.size() != study.fixed[0].second.size())
            table.fail(entry.key,
                       fmt::format("has {} values, but {} has {}; expected one for "
                                   "each case",
                                   study.fixed.back().second.size(), study.fixed[0].first,
                                   study.fixed[0].second.size()));
    }
}

StudySpec read_study(const schema::Section& section, input::InputFiles& files,
                     std::uint64_t seed, const SimulatorPointer& simulator) {
    StudySpec study;
    study.kind = section.choice_as<StudyKind>("kind");
    study.name = section.has("name") ? section.text("name") : section.choice("kind");
    study.sensitivity.seed = study.screening.seed = seed;
    check_name(section, "name", Named::study, study.name);
    if (study.kind == StudyKind::posterior) {
        study.posterior = read_posterior(section, seed);
        study.period = study.posterior.period;
    } else if (study.kind == StudyKind::kennedy_ohagan) {
        check_name(section, "name", Named::building, study.name);
        study.koh = read_koh(section, files, seed, simulator);
    } else if (study.kind == StudyKind::loop) {
        study.loop = read_loop(section, seed);
        study.period = study.loop.period;
    } else if (study.kind == StudyKind::grid) {
        study.grid = read_grid(section);
        study.period = section.text("period");
    } else if (study.kind == StudyKind::retrofit) {
        study.period = section.text("period");
    } else if (study.kind == StudyKind::optimisation) {
        study.optimisation = read_optimisation(section, seed);
        study.period = study.optimisation.period;
        study.grid.targets = read_targets(section);
    } else if (study.kind == StudyKind::stages) {
        study.staged = read_staged(section, seed);
    } else if (study.kind == StudyKind::screening) {
        read_screening(section, study.screening);
    } else {
        read_sensitivity(section, study);
    }
    if (study.kind == StudyKind::office_hour_sensitivity) read_fixed(section, study);
    return study;
}

}  // namespace

std::vector<Quantity> read_quantities(const schema::Section& section,
                                      std::string_view key) {
    const std::vector<std::string> names(physics::quantity_names.begin(),
                                         physics::quantity_names.end());
    std::vector<Quantity> chosen;
    for (const std::string& word : section.texts(key)) {
        const auto found = std::find(names.begin(), names.end(), word);
        if (found == names.end())
            section.fail(key, fmt::format("\"{}\" is no quantity{}", word,
                                          input::suggestion(word, names)));
        chosen.push_back(static_cast<Quantity>(found - names.begin()));
    }
    return chosen;
}

std::vector<StudySpec> read_studies(const schema::Section& job, input::InputFiles& files,
                                    std::uint64_t seed,
                                    const SimulatorPointer& simulator) {
    std::vector<StudySpec> studies;
    for (const schema::Section& section : job.tables("study", "study")) {
        studies.push_back(read_study(section, files, seed, simulator));
        const auto same = [&](const StudySpec& other) {
            return other.name == studies.back().name;
        };
        if (std::any_of(studies.begin(), studies.end() - 1, same))
            section.fail("name",
                         fmt::format("another study is called \"{}\"; give this one a "
                                     "name of its own",
                                     studies.back().name));
    }
    return studies;
}

}  // namespace bemcal::job
