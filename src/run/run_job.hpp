/// A job file, from its first line to the result file.
#pragma once

#include "job/job.hpp"
#include "run/execute.hpp"
#include "run/result_page.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace bemcal::run {

struct JobOptions {
    std::filesystem::path job;
    std::filesystem::path output;  ///< empty = the job's, else its name with .h5
    bool is_numbered = false;      ///< NAME-001.h5, or the next number that is free
    Existing existing = Existing::refuse;
    int n_threads = 0;
    double item_seconds = 0;  ///< as the next one, see ExecuteOptions
    std::optional<std::chrono::steady_clock::time_point> stop_at = std::nullopt;
    /// Of a stock: the result that this night goes on from; empty = there is none.
    std::filesystem::path last_night{};
    int first_chain = 0;  ///< number of the first chain of every posterior
    std::string version;
    std::function<void(const std::string&)> say;             ///< rank 0
    std::function<void(const store::ResultFile&)> on_stage;  ///< rank 0
    std::optional<PageWriter> pages;                         ///< none: no pages
};

/// All ranks call it together; a UserError is thrown on all of them.
Outcome run_job(Comm& comm, const JobOptions& options);

/// What a result tells of its job before the first simulation: program, job text, seed,
/// the input files' hashes, what was found in the data. Paths are relative to the job's
/// folder, so that the result does not depend on where it lies.
store::ResultFile frame_of(const job::Job& job, const std::string& version);
Identity identity_of(const job::Job& job, const std::string& version);

}  // namespace bemcal::run
