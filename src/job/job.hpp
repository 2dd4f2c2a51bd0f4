/// A job file, read and checked: everything that `run` needs, and nothing of how it is
/// run.
#pragma once

#include "study/case.hpp"
#include "study/koh_options.hpp"
#include "study/posterior.hpp"
#include "study/screening.hpp"
#include "study/sensitivity.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
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
    kennedy_ohagan
};

/// Whether a study is done with every building; the others know none.
bool is_of_buildings(StudyKind kind);

struct StudySpec {
    StudyKind kind = StudyKind::screening;
    std::string name;
    study::SensitivityOptions sensitivity;
    study::ScreeningOptions screening;
    study::PosteriorOptions posterior;
    study::KohOptions koh;
    std::string period;  ///< of a sensitivity or posterior; empty = the first one
    std::vector<physics::Quantity> quantities;  ///< outputs of a sensitivity study
    /// office_hour_sensitivity: each case fixes the named inputs of
    /// physics/office_hour.hpp
    std::vector<std::pair<std::string, std::vector<double>>> fixed;
};

struct InputFile {
    std::filesystem::path path;
    std::string hash;  ///< of its content
};

struct Job {
    std::filesystem::path file;
    std::string name;
    std::string text;  ///< the job file as read
    std::uint64_t seed = 0;
    std::vector<study::Case> buildings;
    std::vector<StudySpec> studies;  ///< in the order of the file
    std::vector<InputFile> inputs;   ///< every file read, the job's own first
    /// Default result file; empty = beside the working folder.
    std::filesystem::path output;
    /// Quantities of nominal and best to store by hour.
    std::vector<std::string> hourly_outputs;
    /// More failed points than this and the batch has failed.
    double max_failed_share = 0.05;
};

/// Throws UserError with file:line:key, what is wrong, why, and what to write instead.
Job read_job(const std::filesystem::path& file);

class InputFiles;
/// The same through another reader of files (tests, fuzzers).
Job read_job(const std::filesystem::path& file, InputFiles& files);

/// The stages that the job asks for, in order.
std::vector<std::unique_ptr<study::Stage>> make_plan(const Job& job);

/// `describe job`: the schema table, as text.
std::string describe_job();
/// `describe parameters`: every number of a building that a parameter may name.
std::string describe_parameters();

}  // namespace bemcal::job
