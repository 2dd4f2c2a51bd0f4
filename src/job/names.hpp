/// Names that a study gives: of a building's periods, parameters and meters, and of
/// studies above it. They are held against what the job's sections are called, so that a
/// wrong one is told beside mistakes in those sections.
#pragma once

#include "description/building_readers.hpp"
#include "schema/section.hpp"
#include "study/case.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::job {

struct Kind;

using Words = std::vector<std::string>;

/// What a building calls its parts.
struct BuildingNames {
    std::string building;
    Words periods, parameters, meters;
};

BuildingNames names_of(const study::Case& building);
/// With the names of sections that could not be read.
BuildingNames names_of(const study::Case& building, const description::Sources& sources);

struct NamedStudy {
    std::string name;            ///< "" = not known, because of a mistake
    const Kind* kind = nullptr;  ///< nullptr = not known
};
/// \param study  its section, be it right or not
NamedStudy named_study(const schema::Node& study);

/// Where a study names something.
struct NamePlace {
    const schema::Section& section;  ///< the study's
    const BuildingNames& names;      ///< of a building
    const std::vector<NamedStudy>& above;
};

/// The text or texts at a key that the section's reader has asked for.
Words words_at(const schema::Node& section, std::string_view key);

/// Throw UserError where a word is no name, Follows where it may be one of a section that
/// could not be read. Where there are no names at all, nothing is said.
void check_periods(const schema::Section& section, const char* key, const Words& words,
                   const BuildingNames& names);
void check_parameters(const schema::Section& section, const char* key, const Words& words,
                      const BuildingNames& names);
void check_meters(const schema::Section& section, const char* key, const Words& words,
                  const BuildingNames& names);

/// All names of a study that hold for any kind, then those of its own kind.
void check_names(const Kind& kind, const NamePlace& place);

}  // namespace bemcal::job
