/// A job file from its first line to the result file: read on every rank, planned,
/// executed, and its pages written; and what a result tells of its job.
/// Plain order of steps, without a source. Reading is the job's, the night of a stock its
/// stage's, tables on the terminal report's.
#include "run/run_job.hpp"

#include "job/kind.hpp"
#include "job/model_range.hpp"
#include "job/stages.hpp"
#include "job/stock.hpp"
#include "kernel/batch.hpp"
#include "run/output_names.hpp"
#include "run/timer.hpp"
#include "run/together.hpp"
#include "stock/stage.hpp"
#include "store/layout_check.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>
#include <memory>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

std::string relative_name(const job::Job& job, const fs::path& file) {
    const fs::path folder = fs::absolute(job.file).parent_path().lexically_normal();
    return fs::absolute(file).lexically_normal().lexically_proximate(folder).string();
}

study::Dataset texts(std::string path, std::string dim, std::vector<std::string> values) {
    const std::size_t n = values.size();
    return {std::move(path), {std::move(dim)}, {n}, {}, std::move(values)};
}

void add_inputs(const job::Job& job, std::vector<study::Dataset>& datasets) {
    std::vector<std::string> names, hashes;
    for (const auto& input : job.inputs) {
        names.push_back(relative_name(job, input.path));
        hashes.push_back(input.hash);
    }
    datasets.push_back(texts("inputs/input_file", "input_file", names));
    datasets.push_back(texts("inputs/content_hash", "input_file", hashes));
}

void add_decisions(const study::Case& building, std::vector<study::Dataset>& datasets) {
    if (building.decisions.empty()) return;
    std::vector<std::string> series, findings, actions;
    for (const auto& decision : building.decisions) {
        series.push_back(decision.series);
        findings.push_back(decision.finding);
        actions.push_back(decision.action);
    }
    const std::string group = building.name + "/data/";
    datasets.push_back(texts(group + "series", "decision", series));
    datasets.push_back(texts(group + "finding", "decision", findings));
    datasets.push_back(texts(group + "action", "decision", actions));
}

/// Rank 0's choice; the result's name for all: they may see the folder a moment later.
OutputNames agreed_output(Comm& comm, const job::Job& job, const JobOptions& options) {
    OutputNames names;
    together(comm, [&] {
        if (comm.rank() == 0)
            names = choose_output(
                job, {options.output, options.is_numbered, options.last_night});
    });
    const std::string text = names.result.string();
    Bytes bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    const Bytes chosen = comm.all_gather(bytes)[0];
    names.result =
        std::string(reinterpret_cast<const char*>(chosen.data()), chosen.size());
    return names;
}

/// Arrays of a job: every run has chains of its own.
void set_first_chain(job::Job& job, int first_chain) {
    job.first_chain = first_chain;
    const bool has_chains = std::ranges::any_of(
        job.studies, [](const job::StudySpec& study) { return study.kind->has_chains; });
    if (first_chain > 0 && !has_chains)
        throw UserError(ExitCode::usage,
                        fmt::format("--first-chain {}: {} has no study of kind "
                                    "\"posterior\"; leave it out",
                                    first_chain, job.file.string()));
}

Work work_of(const job::Job& job, const JobOptions& options) {
    Work work;
    work.frame = frame_of(job, options.version);
    work.identity = identity_of(job, options.version);
    if (options.first_chain > 0) {
        const std::string first = std::to_string(options.first_chain);
        work.frame.attributes["first_chain"] = first;
        work.identity.emplace_back("first chain", first);
    }
    work.max_failed_share = job.max_failed_share;
    return work;
}

std::vector<std::string> names_of(
    const std::vector<std::unique_ptr<study::Stage>>& stages) {
    std::vector<std::string> names;
    names.reserve(stages.size());
    for (const auto& stage : stages) names.push_back(stage->name());
    return names;
}

/// Of a result that was written now, by rank 0.
void write_pages(const JobOptions& options, const fs::path& output,
                 const std::vector<std::string>& stages) {
    if (!options.pages) return;
    for (const std::string& line : options.pages->write(output, stages))
        options.say(line);
}

/// The last night's records, and a line of identity for them.
stock::StockNight night_of(const JobOptions& options, double hours, Work& work) {
    stock::StockNight night;
    night.version = options.version;
    if (!options.last_night.empty()) {
        if (!store::is_sound(store::read_result(options.last_night)))
            throw UserError(ExitCode::data,
                            fmt::format("{}: is damaged: its content is not what was "
                                        "written; take another night for --after, or do "
                                        "that one again",
                                        options.last_night.string()));
        const store::ResultFile last = store::read_result(options.last_night, "stock");
        store::check_layout(last);
        night.before = stock::records_in(last.datasets);
        if (night.before.empty())
            throw UserError(
                ExitCode::data,
                fmt::format("{}: is no result of a stock; --after takes that of "
                            "the last night",
                            options.last_night.string()));
        work.identity.emplace_back("last night", last.hash);
        work.frame.attributes["last_night"] = last.hash;
    }
    if (hours > 0) {
        const auto end = std::chrono::steady_clock::now() +
                         std::chrono::duration<double, std::ratio<3600>>(hours);
        night.is_over = [end] { return std::chrono::steady_clock::now() >= end; };
    }
    return night;
}

/// On rank 0, which writes them.
void add_ranges(Comm& comm, const job::Job& job, store::ResultFile& frame) {
    if (comm.rank() != 0) return;
    for (const study::Case& building : job.buildings)
        std::ranges::move(
            job::range_datasets(building, job::fitted_ranges(job, building)),
            std::back_inserter(frame.datasets));
}

std::vector<std::unique_ptr<study::Stage>> stages_of(const job::Job& job,
                                                     const JobOptions& options,
                                                     Work& work) {
    if (!job.stock) {
        if (!options.last_night.empty())
            throw UserError(ExitCode::usage,
                            "--after: the job has no [stock]; leave it out");
        return job::make_plan(job);
    }
    std::vector<std::unique_ptr<study::Stage>> stages;
    stages.push_back(
        stock::make_stock_stage(job, night_of(options, job.stock->options.hours, work)));
    return stages;
}

}  // namespace

store::ResultFile frame_of(const job::Job& job, const std::string& version) {
    store::ResultFile frame;
    frame.attributes = {{"program", "bemcal-batch"},
                        {"version", version},
                        {"format", "1"},
                        {"title", job.name},
                        {"job", job.text},
                        {"seed", std::to_string(job.seed)}};
    frame.run["instruction_set"] = kernel::name_of(kernel::choose_instruction_set());
    add_inputs(job, frame.datasets);
    for (const study::Case& building : job.buildings)
        add_decisions(building, frame.datasets);
    return frame;
}

Identity identity_of(const job::Job& job, const std::string& version) {
    Identity identity{{"version", version}};
    for (const auto& input : job.inputs)
        identity.emplace_back("file " + relative_name(job, input.path), input.hash);
    return identity;
}

Outcome run_job(Comm& comm, const JobOptions& options) {
    double seconds_read = 0, seconds_plan = 0;
    const auto kept = std::make_shared<job::Job>();  // by threads that are left behind
    job::Job& job = *kept;
    Work work;
    together(comm, [&] {
        const Timer timer(seconds_read);
        job = job::read_job(options.job);
        set_first_chain(job, options.first_chain);
    });
    together(comm, [&] {
        const Timer timer(seconds_plan);
        work = work_of(job, options);
        work.stages = stages_of(job, options, work);
        add_ranges(comm, job, work.frame);
        work.data = kept;
    });
    work.frame.run["seconds_read"] = fmt::format("{:.3f}", seconds_read);
    work.frame.run["seconds_plan"] = fmt::format("{:.3f}", seconds_plan);
    const OutputNames names = agreed_output(comm, job, options);
    const std::vector<std::string> stages = names_of(work.stages);
    Outcome outcome =
        execute(comm, std::move(work),
                {names.result, options.existing, options.n_threads, options.item_seconds,
                 options.stop_at, options.say, options.on_stage});
    if (!outcome.hash.empty() && !job.stock) write_pages(options, names.result, stages);
    const bool is_there = !outcome.hash.empty() || outcome.is_complete_already;
    if (is_there && job.stock && comm.rank() == 0) outcome.stock = names;
    return outcome;
}

}  // namespace bemcal::run
