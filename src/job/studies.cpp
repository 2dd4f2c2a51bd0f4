/// Reads every [[study]], kind and name, then the keys of that kind by its row; checks
/// what all studies of buildings, or of a [simulator], need.
/// Follows from the table of kinds.
/// What one kind needs beside that is in the kind's own file.
#include "job/studies.hpp"

#include "description/result_names.hpp"
#include "job/kinds.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

StudySpec read_study(const Kind& kind, const StudySource& source) {
    const schema::Section& section = source.section;
    StudySpec study;
    study.kind = &kind;
    section.attempt_all(
        [&] {
            study.name = section.has("name") ? section.text("name") : kind.word;
            description::check_name(section, "name", description::Named::study,
                                    study.name);
        },
        [&] { kind.read(source, study); });
    return study;
}

void check_not_there(const schema::Section& section, const std::string& name,
                     const std::vector<StudySpec>& others) {
    if (std::ranges::find(others, name, &StudySpec::name) == others.end()) return;
    section.fail("name", fmt::format("another study is called \"{}\"; give this one a "
                                     "name of its own",
                                     name));
}

bool has_period(const study::Case& building, const std::string& name) {
    return name.empty() ||
           std::ranges::find(building.periods, name, &study::Period::name) !=
               building.periods.end();
}

/// Parameters, and the period that it names.
void check_buildings(const schema::Section& section, const StudySpec& study,
                     const Job& job) {
    const Kind& kind = *study.kind;
    const bool are_needed =
        kind.needs_parameters && (!job.simulator || kind.calibrates_twin);
    for (const study::Case& building : job.buildings) {
        if (are_needed && building.parameters.empty())
            section.fail(
                "kind",
                fmt::format("needs parameters, and {} has none; add [[parameter]]",
                            building.name));
        if (!has_period(building, study.period))
            section.fail_value("period",
                               fmt::format("{} has no such period", building.name));
    }
}

void check_simulator(const schema::Section& root, const schema::Section& section,
                     const StudySpec& study, const study::Simulator& simulator) {
    if (!study.kind->takes_simulator)
        section.fail_value(
            "kind",
            "needs a building, and the job has a [simulator] in its place; expected " +
                words_of_kinds([](const Kind& kind) { return kind.takes_simulator; }));
    if (root.table("simulator", "simulator").has("effect"))
        section.fail_value("kind",
                           "asks for numbers, and [[simulator.effect]] is of runs "
                           "that give hours; expected a job of its own for it");
    if (simulator.outputs().empty())
        section.fail_value("kind",
                           "needs numbers of the [simulator]; expected a "
                           "[[simulator.output]]");
    description::check_name(section, "name", description::Named::building, study.name);
    for (const char* key : {"period", "quantities"})
        if (section.has(key))
            section.fail(key,
                         "is of a building; a [simulator] is studied in its own outputs");
}

/// Whether its names are those of buildings, and not of a [simulator].
bool names_buildings(const schema::Section& root, const Kind& kind) {
    return kind.is_of_buildings && !root.has("simulator") && !root.is_lost("simulator");
}

void check_study(const StudyPlace& place, StudySpec& study) {
    const Kind& kind = *study.kind;
    if (place.job.simulator && !kind.takes_twin)
        check_simulator(place.root, place.section, study, *place.job.simulator);
    else if (kind.is_of_buildings)
        check_buildings(place.section, study, place.job);
    if (kind.check != nullptr) kind.check(place, study);
}

}  // namespace

std::vector<StudySpec> read_studies(const schema::Section& root, input::InputFiles& files,
                                    std::uint64_t seed,
                                    const SimulatorPointer& simulator) {
    std::vector<StudySpec> studies;
    for (const schema::Node* node : root.list_of_tables("study"))
        root.attempt_on(*node, [&] {
            const auto [kind, section] = open_study(*node, root.file(), root.mistakes());
            StudySpec study = read_study(*kind, {section, files, seed, simulator});
            check_not_there(section, study.name, studies);
            studies.push_back(std::move(study));
        });
    return studies;
}

void check_studies_of(const schema::Section& root,
                      const std::vector<BuildingNames>& names, bool is_whole, Job& job) {
    std::vector<NamedStudy> above;
    for (const schema::Node* node : root.list_of_tables("study")) {
        root.attempt_on(*node, [&] {
            const OpenStudy study = open_study(*node, root.file(), root.mistakes());
            if (names_buildings(root, *study.kind))
                for (const BuildingNames& building : names)
                    check_names(*study.kind, {study.section, building, above});
            if (is_whole)
                check_study({root, study.section, job}, job.studies[above.size()]);
        });
        above.push_back(named_study(*node));
    }
}

}  // namespace bemcal::job
