/// The kind "office_hour_sensitivity": Sobol indices of paper 1's single hour, with
/// inputs held at values case by case.
/// Source: paper 1, step 1.
/// It knows no building; the hour is in physics/office_hour.
#include "job/kind.hpp"
#include "job/office_hour_inputs.hpp"
#include "job/sobol_keys.hpp"
#include "sensitivity/simulators.hpp"

#include <fmt/format.h>

namespace bemcal::job {

namespace {

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"office_hour_sensitivity\"", "",
     "Which inputs matter in paper 1's single hour of an office; it needs no building."},
    {"study.fixed", "[study.fixed]", "",
     "Inputs held at a value, one for each case: theta_ext = [10, 30]; the names are "
     "those of "
     "the model.",
     true}};

constexpr schema::Key keys[] = {
    {"study", "fixed", schema::Type::table, "", "", 0, 0, "[study.fixed]"},
};

struct OfficeHourStudy {
    sensitivity::SensitivityOptions options;
    /// By input, a value for each case.
    std::vector<std::pair<std::string, std::vector<double>>> fixed;

    std::size_t n_cases() const { return fixed.empty() ? 0 : fixed[0].second.size(); }
};

/// The values of one input, one for each case.
std::vector<double> read_cases(const schema::Section& section,
                               const schema::Entry& entry) {
    const schema::Key row =
        office_hour_row(office_hour_input(section, entry.key), schema::Type::numbers);
    const std::string where =
        fmt::format("{}:{}: study.fixed.{}", section.file(), entry.line, entry.key);
    std::vector<double> values;
    for (const schema::Entry& value : section.node(entry.key).entries)
        values.push_back(schema::checked_number(value.node, row, where));
    if (values.empty())
        section.fail(entry.key, "has no values; expected a list of numbers");
    return values;
}

void read_fixed(const schema::Section& section, OfficeHourStudy& study) {
    if (!section.has("fixed")) return;
    const schema::Section table = section.table("fixed", "study.fixed");
    for (const schema::Entry& entry : table.root().entries) {
        study.fixed.emplace_back(entry.key, read_cases(table, entry));
        const std::size_t n = study.fixed.back().second.size();
        if (n != study.n_cases())
            table.fail(entry.key,
                       fmt::format("has {} values, but {} has {}; expected one for "
                                   "each case",
                                   n, study.fixed[0].first, study.n_cases()));
    }
}

void read(const StudySource& source, StudySpec& study) {
    OfficeHourStudy made;
    made.options.seed = source.seed;
    made.options.kind = "office_hour_sensitivity";
    read_design(source.section, made.options);
    read_indices(source.section, made.options);
    read_fixed(source.section, made);
    study.options = std::move(made);
}

std::unique_ptr<study::Stage> stage_of(
    const std::string& name, const std::vector<std::pair<std::string, double>>& fixed,
    const OfficeHourStudy& study) {
    return sensitivity::make_sensitivity(
        name, sensitivity::make_office_hour_simulator(fixed), study.options);
}

/// One stage, or one for each case of fixed inputs: "sobol/case_01", ...
Stages stages(const StudySpec& spec, const Job&) {
    const auto& study = spec.as<OfficeHourStudy>();
    if (study.fixed.empty()) return only(stage_of(spec.name, {}, study));
    Stages stages;
    for (std::size_t c = 0; c < study.n_cases(); ++c) {
        std::vector<std::pair<std::string, double>> fixed;
        fixed.reserve(study.fixed.size());
        for (const auto& [input, values] : study.fixed)
            fixed.emplace_back(input, values[c]);
        stages.push_back(
            stage_of(fmt::format("{}/case_{:02}", spec.name, c + 1), fixed, study));
    }
    return stages;
}

}  // namespace

extern const Kind office_hour_sensitivity_kind{.word = "office_hour_sensitivity",
                                               .sections = {sections},
                                               .keys = {keys, design_keys, index_keys},
                                               .is_of_buildings = false,
                                               .read = read,
                                               .stages = stages};

}  // namespace bemcal::job
