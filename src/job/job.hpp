/// A job file, read and checked: everything that `run` needs, and nothing of how it is
/// run. The work of reading is in read_job.cpp.
#pragma once

#include "calibration/optimisation.hpp"
#include "calibration/screening.hpp"
#include "calibration/staged.hpp"
#include "input/input_files.hpp"
#include "job/grid_spec.hpp"
#include "loop/options.hpp"
#include "posterior/koh_options.hpp"
#include "posterior/koh_runs.hpp"
#include "posterior/posterior.hpp"
#include "retrofit/retrofit.hpp"
#include "sensitivity/sensitivity.hpp"
#include "study/case.hpp"
#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::job {

enum class StudyKind {
    sensitivity,
    hourly_sensitivity,
    office_hour_sensitivity,
    screening,
    posterior,
    kennedy_ohagan,
    loop,
    optimisation,
    retrofit,
    grid,
    stages
};

/// Whether a study is done with every building; the others know none.
bool is_of_buildings(StudyKind kind);
/// Whether it can be done with a [simulator] in place of a building.
bool can_be_of_simulator(StudyKind kind);

using SimulatorPointer = std::shared_ptr<const study::Simulator>;

struct KohStudy {
    posterior::KohOptions options;
    std::optional<posterior::KohRuns> runs;  ///< to be made by the job's simulator
};

struct StudySpec {
    StudyKind kind = StudyKind::screening;
    std::string name;
    sensitivity::SensitivityOptions sensitivity;
    calibration::ScreeningOptions screening;
    posterior::PosteriorOptions posterior;
    KohStudy koh;
    loop::LoopOptions loop;
    calibration::OptimisationOptions optimisation;
    calibration::StagedOptions staged;
    GridSpec grid;
    std::vector<retrofit::RetrofitOptions> retrofits;  ///< one for each building
    std::string period;  ///< not of a screening; empty = the first one
    std::vector<physics::Quantity> quantities;  ///< outputs of a sensitivity study
    /// office_hour_sensitivity: each case fixes the named inputs of
    /// physics/office_hour.hpp
    std::vector<std::pair<std::string, std::vector<double>>> fixed;
};

class Stock;

struct Job {
    std::filesystem::path file;
    std::string name;
    std::string text;  ///< the job file as read
    std::uint64_t seed = 0;
    std::vector<study::Case> buildings;
    std::shared_ptr<const Stock> stock;  ///< in place of buildings, or nullptr
    SimulatorPointer simulator;  ///< what is studied in place of a building, or nullptr
    std::vector<StudySpec> studies;        ///< in the order of the file
    std::vector<input::InputFile> inputs;  ///< every file read, the job's own first
    /// Default result file; empty = beside the working folder.
    std::filesystem::path output;
    /// Quantities of nominal and best to store by hour.
    std::vector<std::string> hourly_outputs;
    /// More failed points than this and the batch has failed.
    double max_failed_share = 0.05;
};

/// Throws UserError with file:line:key, what is wrong, why, and what to write instead.
Job read_job(const std::filesystem::path& file);

/// The same through another reader of files (tests, fuzzers).
Job read_job(const std::filesystem::path& file, input::InputFiles& files);

/// `describe job`: the schema table, as text.
std::string describe_job();
/// `describe parameters`: every number of a building that a parameter may name.
std::string describe_parameters();

}  // namespace bemcal::job
