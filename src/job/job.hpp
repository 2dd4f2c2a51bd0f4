/// A job file, read and checked: everything that `run` needs, and nothing of how it is
/// run. The work of reading is in read_job.cpp.
#pragma once

#include "input/input_files.hpp"
#include "study/case.hpp"
#include "study/hourly_simulator.hpp"
#include "study/simulator.hpp"

#include <any>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::job {

using SimulatorPointer = std::shared_ptr<const study::Simulator>;

struct Kind;

/// A study as the job says it.
struct StudySpec {
    const Kind* kind = nullptr;  ///< what is known of its kind: a row of kinds.cpp
    std::string name;
    std::string period;  ///< empty = the first one, or it asks for none
    std::any options;    ///< of its kind, as the kind's reader made them

    /// Throws std::bad_any_cast where the kind has other options.
    template <class Options>
    const Options& as() const {
        return std::any_cast<const Options&>(options);
    }
    template <class Options>
    Options& as() {
        return std::any_cast<Options&>(options);
    }
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
    /// The hours of the same, whose building stands beside it as a twin; or nullptr.
    std::shared_ptr<const study::HourlySimulator> hourly_simulator;
    std::vector<StudySpec> studies;  ///< in the order of the file
    int first_chain = 0;  ///< number of the first one: arrays of a job differ in it
    std::vector<input::InputFile> inputs;  ///< every file read, the job's own first
    /// Default result file; empty = beside the working folder.
    std::filesystem::path output;
    /// Quantities of nominal and best to store by hour.
    std::vector<physics::Quantity> hourly_outputs;
    /// More failed points than this and the batch has failed.
    double max_failed_share = 0.05;
};

/// Throws UserError with file:line:key, what is wrong, why, and what to write instead.
Job read_job(const std::filesystem::path& file);

/// The same through another reader of files (tests, fuzzers).
Job read_job(const std::filesystem::path& file, input::InputFiles& files);

/// `describe job`: the schema table, as text.
std::string describe_job();
/// `describe posterior`, `describe meter`: a kind of study or a section, with the
/// sections in it; empty where it is none of job_topics().
std::string describe_topic(const std::string& topic);
/// Kinds of study, then sections, as they are named there.
std::vector<std::string> job_topics();
/// `describe parameters`: every number of a building that a parameter may name.
std::string describe_parameters();

}  // namespace bemcal::job
