/// A kind of study: one row of the table in kinds.cpp.
///
/// A kind stands in a file of its own, WORD_kind.cpp: its keys, their reader, and what
/// follows from them. All others that work with studies go through the row. What a kind
/// does not need, its row leaves out.
///
/// A new kind is five files: its stage's header and source, whose `conclude` stores the
/// word (`DatasetBuilder::kind`), its WORD_kind.cpp, its line in kinds.cpp, and the rows
/// of its datasets in store/layout.cpp. `report` shows it as it is stored; tables of its
/// own are a source in report/, named in sections.hpp and tables.cpp; its pictures are a
/// row in scripts/report/kinds.py.
#pragma once

#include "input/input_files.hpp"
#include "job/job.hpp"
#include "schema/section.hpp"
#include "study/stage.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>

namespace bemcal::job {

struct NamePlace;

using study::Stages;

/// Rows of a kind's own and those that it shares with other kinds.
template <class Row>
using Rows = std::array<std::span<const Row>, 5>;

/// What a study is read from.
struct StudySource {
    const schema::Section& section;
    input::InputFiles& files;
    std::uint64_t seed = 0;
    const SimulatorPointer& simulator;  ///< of the job, or nullptr
};

/// Where a study stands, when the buildings are known.
struct StudyPlace {
    const schema::Section& root;     ///< the job's
    const schema::Section& section;  ///< the study's
    const Job& job;
};

/// A stage of a study.
struct StudyStage {
    const StudySpec& study;
    const Job& job;
    const study::Stage& stage;
    const study::Case* building = nullptr;  ///< the stage's, or its first; nullptr = none
};

/// What a stage takes; begins with what the stage says itself.
struct Effort {
    double simulations = 0;
    double rounds = 1;       ///< of its items
    double hours = 0;        ///< that a simulation lasts, without the warm-up
    bool has_errors = true;  ///< false: a step is only summed up, at half the cost
    std::optional<double> seconds{};  ///< on one core, where steps are not what it takes
    double working_bytes = 0;         ///< that an item takes while it is worked on
};

/// Meters whose readings of a period are fitted.
struct Fitted {
    std::string period;               ///< empty = the first
    std::vector<std::string> meters;  ///< empty = all with readings
};

struct Kind {
    const char* word;  ///< in a job, and in a result, where the study's dataset `kind` is
                       ///< written by its stages
    /// "study" itself, which says what the kind is for, then the sections in it.
    Rows<schema::SectionInfo> sections;
    Rows<schema::Key> keys;  ///< beside `kind` and `name`, which all have

    bool is_of_buildings = true;   ///< done with every building; false: it knows none
    bool needs_parameters = true;  ///< of a building
    bool takes_simulator = false;  ///< a [simulator] may stand in place of the building
    bool takes_twin = false;  ///< of a [simulator], with the building beside it as a twin
    bool calibrates_twin = false;  ///< and the twin's parameters are needed, too
    bool takes_stock = false;      ///< it can be done with every building of a stock
    bool finds_effects = false;    ///< around a [simulator] it has one point, with these
    bool has_chains = false;       ///< it draws in rounds until it has converged

    /// Reads its keys: options, period. Throws UserError.
    void (*read)(const StudySource& source, StudySpec& study);
    /// Throws UserError where it names, in keys of its kind alone, what a building or the
    /// job does not have; not where there is a [simulator].
    void (*check_names)(const NamePlace& place) = nullptr;
    /// The names are right. Throws UserError where the study does not fit the job's
    /// buildings or simulator;
    /// completes what depends on them.
    void (*check)(const StudyPlace& place, StudySpec& study) = nullptr;
    /// What it does, over all buildings. Throws std::invalid_argument where the study
    /// does not fit.
    Stages (*stages)(const StudySpec& study, const Job& job);
    /// Corrects what the stage says of itself.
    void (*cost)(const StudyStage& stage, Effort& effort) = nullptr;
    /// What it will do, in a sentence for `check`.
    std::string (*sentence)(const StudySpec& study) = nullptr;
    /// The stage whose result has points of the building's parameters, which a retrofit
    /// can take; left out: it finds none.
    std::string (*points_of)(const StudySpec& study,
                             const study::Case& building) = nullptr;
    /// The same around a [simulator] with hours of the building's meters.
    std::string (*points_around)(const StudySpec& study,
                                 const study::Case& building) = nullptr;
    /// The building with all that its points are of; left out: as the job has it.
    study::Case (*case_of)(const StudySpec& study, const study::Case& building) = nullptr;
    /// What it fits of a building; left out: it fits no meter.
    std::vector<Fitted> (*fitted)(const StudySpec& study,
                                  const study::Case& building) = nullptr;
};

/// "BUILDING/STUDY": the stage of a building.
std::string stage_name(const StudySpec& study, const study::Case& building);

/// A stage for every building, made by `make(name, building)`.
template <class Make>
Stages for_each_building(const StudySpec& study, const Job& job, Make make) {
    Stages stages;
    for (const study::Case& building : job.buildings)
        stages.push_back(make(stage_name(study, building), building));
    return stages;
}

/// The only stage of a study.
Stages only(std::unique_ptr<study::Stage> stage);

}  // namespace bemcal::job
