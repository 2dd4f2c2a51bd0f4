/// The readers of a building's sections: each turns sections into a plain struct of
/// physics/ or study/, and says where a mistake stands.
#pragma once

#include "external/command_simulator.hpp"
#include "input/input_files.hpp"
#include "job/job.hpp"
#include "physics/office_hour.hpp"
#include "schema/section.hpp"
#include "study/case.hpp"

#include <optional>
#include <vector>

namespace bemcal::job {

/// A building's file and the job's: a section that the first leaves out is taken from the
/// second.
struct Sources {
    schema::Section own;
    std::optional<schema::Section> shared;
    const schema::Section& with(std::string_view key) const {
        return own.has(key) || !shared ? own : *shared;
    }
    bool has(std::string_view key) const { return with(key).has(key); }
};

/// A whole building; throws UserError.
study::Case read_case(const Sources& sources, input::InputFiles& files);

/// What studies need of a job's buildings: parameters, meters, the periods they name.
void check_studies_of(const schema::Section& root, Job& job);

/// Site, sky and weather, cut to the periods and their warm-up, which must be known
/// already.
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

/// Schedules, then series: the rows that `Input::profile` counts.
std::vector<physics::Profile> read_profiles(const Sources& sources,
                                            input::InputFiles& files,
                                            const physics::Site& site,
                                            std::vector<study::DataDecision>& decisions);

/// The series among them, with their units.
std::vector<study::Column> read_columns(const Sources& sources);

physics::Building read_building(const Sources& sources,
                                const std::vector<physics::Profile>& profiles);

/// [[link]], into the building, and all that follows from its numbers.
void read_links(const Sources& sources, physics::Building& building);
/// Throws UserError at `key` where a linked number leaves its range.
void check_linked(const schema::Section& section, const char* key,
                  const physics::Building& building);

/// Throws UserError (config) where the building is outside the method: H_tr,op >=
/// H_tr,ms, an area that is not positive, heating above cooling set-points in an hour of
/// the periods.
void check_building(const Sources& sources, const study::Case& building);

/// Parameters and their priors, into the case.
void read_parameters(const Sources& sources, study::Case& building);

/// What is believed of a parameter: uniform in its range where its section does not say.
study::ParameterPrior read_prior(const schema::Section& section,
                                 const physics::Parameter& parameter);
/// A prior on the parameter's range, from the keys of a prior's section.
stats::Prior read_distribution(const schema::Section& section,
                               const physics::Parameter& parameter);
/// Of a discrete parameter, rising.
std::vector<double> read_values(const schema::Section& section);

/// Readings, corrected as the job says; findings and what was done go to case.decisions.
void read_meters(const Sources& sources, input::InputFiles& files, study::Case& building);

/// \param simulator  of the job, or nullptr
std::vector<StudySpec> read_studies(const schema::Section& job, input::InputFiles& files,
                                    std::uint64_t seed,
                                    const SimulatorPointer& simulator);
/// \param job  its name: of the folder of the points' folders, where the section has none
external::CommandOptions read_simulator(const schema::Section& section,
                                        input::InputFiles& files, const std::string& job);
/// Throws UserError where the study, or a key of it, needs a building.
void check_simulator_study(const schema::Section& section, const StudySpec& study);
/// An input of paper 1's hour by its name; throws UserError at that key.
const physics::OfficeHourInput& office_hour_input(const schema::Section& section,
                                                  const std::string& name);

/// The keys of every study with chains; temperatures that the job leaves out stay.
void read_chains(const schema::Section& section, posterior::ChainOptions& chains);
posterior::PosteriorOptions read_posterior(const schema::Section& section,
                                           std::uint64_t seed);
/// Throws UserError where the study names a meter or building that is not there, or a
/// building it learns from has no reading in the period.
void check_posterior(const schema::Section& section,
                     const posterior::PosteriorOptions& options,
                     const std::vector<study::Case>& buildings);
loop::LoopOptions read_loop(const schema::Section& section, std::uint64_t seed);
/// Throws UserError where the study names a meter, parameter or column that a building
/// does not have, or a building has no reading in the period.
void check_loop(const schema::Section& section, const loop::LoopOptions& options,
                const std::vector<study::Case>& buildings);
calibration::OptimisationOptions read_optimisation(const schema::Section& section,
                                                   std::uint64_t seed);
/// Throws UserError where the study names a meter or parameter that a building does not
/// have, a building has no reading in the period, or weights and meters differ in number.
void check_optimisation(const schema::Section& section,
                        const calibration::OptimisationOptions& options,
                        const std::vector<study::Case>& buildings);

calibration::StagedOptions read_staged(const schema::Section& section,
                                       std::uint64_t seed);
/// Throws UserError where the study names what a building does not have, a stage has no
/// reading in a period, or a validation period overlaps one that a stage sees.
void check_staged(const schema::Section& section,
                  const calibration::StagedOptions& options,
                  const std::vector<study::Case>& buildings);

GridSpec read_grid(const schema::Section& section);
/// Throw UserError where the study names a parameter that is not there, a value outside
/// its range, or a target without a measured value.
void check_grid(const schema::Section& section, const GridSpec& spec,
                const std::string& period, const std::vector<study::Case>& buildings);
void check_grid(const schema::Section& section, const GridSpec& spec,
                const study::Simulator& simulator);
/// [[study.target]], of grids and optimisations.
std::vector<GridTargetSpec> read_targets(const schema::Section& section);
/// Throw UserError where a target has no measured value.
void check_targets(const schema::Section& section, const GridSpec& spec,
                   const std::string& period, const std::vector<study::Case>& buildings);
void check_targets(const schema::Section& section, const GridSpec& spec,
                   const study::Simulator& simulator);

/// What it will do, in a sentence for `check`.
std::string sentence_of(const loop::LoopOptions& options);

/// Throws UserError at the key where a word is none of the names: "x" is no `what`.
void check_word(const schema::Section& section, std::string_view key,
                const std::string& word, const std::vector<std::string>& names,
                const std::string& what);
/// What a study learns, and from what.
struct Learning {
    const std::string& period;
    const std::vector<std::string>& parameters;  ///< empty = all
    const std::vector<std::string>& meters;      ///< empty = all with readings
};
/// Throw UserError where the building does not have them.
void check_parameters(const schema::Section& section, const Learning& learning,
                      const study::Case& building);
void check_meters(const schema::Section& section, const Learning& learning,
                  const study::Case& building);

/// Study `number` of the job, of kind retrofit: the scenarios for every building, and the
/// stage whose points they are applied to. Throws UserError where one does not fit.
void read_retrofit(const schema::Section& root, const schema::Section& section,
                   std::size_t number, Job& job);

/// A Kennedy-O'Hagan study, with its data. Throws UserError where they do not fit.
KohStudy read_koh(const schema::Section& section, input::InputFiles& files,
                  std::uint64_t seed, const SimulatorPointer& simulator);

/// The quantities that words name; throws UserError at `key`.
std::vector<physics::Quantity> read_quantities(const schema::Section& section,
                                               std::string_view key);

/// Calls `read`, and throws its std::invalid_argument or std::domain_error as a UserError
/// that stands at the key.
template <class Read>
auto at_key(const schema::Section& section, std::string_view key, Read read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        section.fail(key, error.what());
    } catch (const std::domain_error& error) {
        section.fail(key, error.what());
    }
}

}  // namespace bemcal::job
