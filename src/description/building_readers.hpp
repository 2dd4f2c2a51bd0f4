/// The readers of a building's sections: each turns sections into a plain struct of
/// physics/ or study/, and says where a mistake stands.
#pragma once

#include "description/words.hpp"
#include "input/input_files.hpp"
#include "schema/section.hpp"
#include "study/case.hpp"

#include <optional>
#include <vector>

namespace bemcal::description {

/// A building's file and the job's: a section that the first leaves out is taken from the
/// second.
struct Sources {
    schema::Section own;
    std::optional<schema::Section> shared;
    const schema::Section& with(std::string_view key) const {
        return own.has(key) || !shared ? own : *shared;
    }
    bool has(std::string_view key) const { return with(key).has(key); }
    /// Reads each section of a list, as Section::each does.
    template <class Read>
    bool each(const char* key, Read read) const {
        return with(key).each(key, key, read);
    }
    /// Does the work, and keeps its mistake: what stands at the keys counts as not read.
    /// \return whether it went well
    template <class Work>
    bool attempt(Work work, std::initializer_list<const char*> keys = {}) const {
        if (own.attempt(work)) return true;
        skip(keys);
        return false;
    }
    void skip(std::initializer_list<const char*> keys) const {
        for (const char* key : keys) with(key).skip(key);
    }
};

/// A whole building; throws UserError. Where mistakes are kept and there is one, what has
/// been read.
study::Case read_case(const Sources& sources, input::InputFiles& files);

/// Site, sky and weather, cut to the periods and their warm-up. Without periods, because
/// of a mistake in them, what its files say is looked at, and it Follows.
void read_weather(const Sources& sources, input::InputFiles& files,
                  study::Case& building);

/// "training" first, the others in the order of the file.
std::vector<study::Period> read_periods(const Sources& sources);

/// [from, to); a last day without an hour is included. Throws UserError at `key`.
study::Period read_range(const schema::Section& section, std::string_view key,
                         const std::string& from, const std::string& to);
/// The same of "from/to", or of one day.
study::Period read_slashed_range(const schema::Section& section, std::string_view key,
                                 const std::string& text);

/// Schedules, before series: the rows that `Input::profile` counts.
/// \param holidays  of schedules that name none themselves
void read_schedules(const Sources& sources,
                    const std::vector<physics::DateRange>& holidays,
                    input::InputFiles& files, std::vector<physics::Profile>& profiles);
/// Series, by the clock of the case's site, behind its schedules, and what they are to
/// columns.
/// \param is_placed  site and periods are known; else keys, files and names of columns
/// are looked at, and all of them Follow
void read_series(const Sources& sources, input::InputFiles& files, bool is_placed,
                 study::Case& building);

/// Schedules with hours = "learn", into the case, which has profiles and building; a note
/// for each goes to case.decisions. Throws UserError where nothing follows one.
void read_unknown_hours(const Sources& sources, study::Case& building);

physics::Building read_building(const Sources& sources,
                                const std::vector<physics::Profile>& profiles);

/// `structure`: what its refinements change of the building as described. Their effects
/// are read_effects', their numbers the next one's.
void read_structure(const Sources& sources, study::Case& building);
/// The structure's numbers as parameters: those that the job's own parameters leave, and
/// that it does not write.
void add_parameters_of_structure(const Sources& sources, study::Case& building);

/// [[link]], into the building, and all that follows from its numbers.
void read_links(const Sources& sources, physics::Building& building);
/// Throws UserError at `key` where a linked number leaves its range.
void check_linked(const schema::Section& section, const char* key,
                  const physics::Building& building);

/// Throws UserError (config) where the building is outside the method: H_tr,op >=
/// H_tr,ms, an area that is not positive, heating above cooling set-points in an hour of
/// the periods.
void check_building(const Sources& sources, const study::Case& building);

/// [[effect]], and those of the structure that no section has, into the case, which has
/// all but parameters and meters.
void read_effects(const Sources& sources, study::Case& building);
/// Whether loads that effects follow can be simulated, with the parameters' values.
void check_loads(const Sources& sources, const study::Case& building);

/// Parameters and their priors, into the case.
void read_parameters(const Sources& sources, study::Case& building);

/// Readings, corrected as the job says; findings and what was done go to case.decisions.
/// \param is_placed  as for read_series
void read_meters(const Sources& sources, input::InputFiles& files, bool is_placed,
                 study::Case& building);

}  // namespace bemcal::description
