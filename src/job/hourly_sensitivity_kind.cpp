/// The kind "hourly_sensitivity": Sobol indices of one quantity for every step of a
/// period.
/// Source: paper 1, step 1, by the hour.
/// The intervals come from blocks of base points, so a bootstrap has no keys here.
#include "job/kind.hpp"
#include "job/sobol_keys.hpp"
#include "schema/words.hpp"

namespace bemcal::job {

namespace {

using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"hourly_sensitivity\"", "",
     "Which parameters matter in each hour: Sobol indices of a quantity in every step of "
     "a period."}};

constexpr schema::Key keys[] = {
    {"study", "period", Type::text, "", "", 0, 0, "Default: the first."},
    {"study", "quantity", Type::choice, schema::quantities, "heating", 0, 0, ""},
};

struct HourlyStudy {
    sensitivity::SensitivityOptions options;
    physics::Quantity quantity = physics::Quantity::heating;
};

void read(const StudySource& source, StudySpec& study) {
    const schema::Section& section = source.section;
    HourlyStudy made;
    made.options.seed = source.seed;
    read_design(section, made.options);
    if (made.options.n_base < 64)
        section.fail_value("n_base",
                           "expected at least 64: the intervals come from 32 blocks");
    made.quantity = section.choice_as<physics::Quantity>("quantity");
    study.period = section.text("period");
    study.options = made;
}

Stages stages(const StudySpec& study, const Job& job) {
    const auto& [options, quantity] = study.as<HourlyStudy>();
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return sensitivity::make_hourly_sensitivity(std::move(name), building,
                                                    period_of(building, study.period),
                                                    quantity, options);
    });
}

}  // namespace

extern const Kind hourly_sensitivity_kind{.word = "hourly_sensitivity",
                                          .sections = {sections},
                                          .keys = {keys, design_keys},
                                          .read = read,
                                          .stages = stages};

}  // namespace bemcal::job
