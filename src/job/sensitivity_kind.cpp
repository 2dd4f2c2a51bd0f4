/// The kind "sensitivity": Sobol indices of totals over a period, or of the outputs of
/// the [simulator].
/// Source: paper 1, step 1.
/// Indices by the hour are a kind of their own.
#include "description/read_quantities.hpp"
#include "job/emulated.hpp"
#include "job/kind.hpp"
#include "job/sobol_keys.hpp"
#include "sensitivity/simulators.hpp"

namespace bemcal::job {

namespace {

using physics::Quantity;
using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"sensitivity\"", "",
     "Which parameters matter: Sobol indices of quantities over a period, or of the "
     "outputs of the [simulator]."}};

constexpr schema::Key keys[] = {
    {"study", "period", Type::text, "", "", 0, 0, "Default: the first."},
    {"study", "quantities", Type::texts, "", "", 0, 0,
     "Totals (means) over the period; default: heating and cooling."},
};

struct SensitivityStudy {
    sensitivity::SensitivityOptions options;
    std::vector<Quantity> quantities;
    int n_runs = 0;  ///< of the [simulator]; 0 = one for each point
};

void read(const StudySource& source, StudySpec& study) {
    SensitivityStudy made;
    made.options.seed = source.seed;
    read_design(source.section, made.options);
    read_indices(source.section, made.options);
    made.quantities = description::read_quantities(source.section, "quantities");
    if (made.quantities.empty()) made.quantities = {Quantity::heating, Quantity::cooling};
    made.n_runs = read_runs(source);
    study.period = source.section.text("period");
    study.options = std::move(made);
}

Stages stages(const StudySpec& study, const Job& job) {
    const auto& [options, quantities, n_runs] = study.as<SensitivityStudy>();
    if (job.simulator)
        return stages_of_simulator(study, job, n_runs, [&](auto simulator) {
            return sensitivity::make_sensitivity(study.name, std::move(simulator),
                                                 options);
        });
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return sensitivity::make_sensitivity(
            std::move(name),
            sensitivity::make_batch_simulator(building, period_of(building, study.period),
                                              quantities),
            options);
    });
}

void cost(const StudyStage&, Effort& effort) {
    effort.has_errors = false;
}

}  // namespace

extern const Kind sensitivity_kind{.word = "sensitivity",
                                   .sections = {sections},
                                   .keys = {keys, design_keys, index_keys, emulated_keys},
                                   .takes_simulator = true,
                                   .read = read,
                                   .stages = stages,
                                   .cost = cost};

}  // namespace bemcal::job
