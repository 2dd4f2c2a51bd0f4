/// The command line: one command for each thing a user does; rank 0 speaks for all ranks.
/// Source: exit codes of BSD's sysexits; CLI11 parses. Without a command it is `run`.
/// How a job runs is left to `run_job`, what it costs to `plan`, tables to the report.
#include "base/machine.hpp"
#include "base/terminal.hpp"
#include "effects/catalogue.hpp"
#include "effects/refinements.hpp"
#include "external/process.hpp"
#include "holidays/holidays.hpp"
#include "input/suggest.hpp"
#include "kernel/batch.hpp"
#include "manual/completion.hpp"
#include "manual/man_pages.hpp"
#include "plan/plan.hpp"
#include "plan/slurm_lines.hpp"
#include "report/csv_files.hpp"
#include "report/merge_chains.hpp"
#include "report/stock_files.hpp"
#include "report/tables.hpp"
#include "run/find_job.hpp"
#include "run/last_words.hpp"
#include "run/memory.hpp"
#include "run/output_place.hpp"
#include "run/program.hpp"
#include "run/run_job.hpp"
#include "run/signals.hpp"
#include "run/threads.hpp"
#include "run/together.hpp"
#include "run/watch.hpp"
#include "store/layout.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

using namespace bemcal;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct CommandLine {
    fs::path job, output, file, csv, parquet;
    std::vector<fs::path> files;
    fs::path last_night;
    std::string topic, place, years, stage;
    bool force = false, simulator = false, rooms = false, resume = false,
         rerun_failed = false, no_report = false;
    bool keep_priors = false, runs = false;
    std::map<std::string, std::vector<std::string>> words_of;  ///< of `new`, by option
    int n_threads = 0;
    double item_seconds = 0;  ///< 0 = no limit
    double stop_after_s = 0;  ///< 0 = no limit
    int first_chain = 0;
    bool slurm = false, watch = false;
    double every_s = 0;  ///< 0 = as fits a terminal or a log
    plan::SlurmRequest slurm_request;
};

constexpr const char* footer =
    "Without an argument it runs the quickstart. In front of it, `mpirun -np N` starts N "
    "ranks.\n"
    "Exit codes: 0 done, 1 written but a target was missed (not converged), 64 command "
    "line,\n65 data, also a damaged result, 66 input missing, 70 program error, 71 no "
    "memory or\nthreads, 73 output exists or cannot be made, 74 reading or writing "
    "failed, "
    "75 stopped\n(go on with --resume), 78 job file.";

/// Of an option's value what is wrong with it. CLI11's own check would print the largest
/// number with all of its digits.
std::string not_above_zero(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    const bool is_number = error == std::errc() && at == end && std::isfinite(value);
    return is_number && value > 0 ? ""
                                  : fmt::format("{}: expected a number above 0", text);
}

void add_run(CLI::App& app, CommandLine& line) {
    CLI::App* run =
        app.add_subcommand("run", "run a job (may be left out: bemcal-batch JOB)");
    run->add_option("JOB", line.job,
                    "job file, or a folder NAME with NAME.toml; none = quickstart");
    run->add_option("-o,--output", line.output,
                    "result file; default: the job's, else NAME.h5")
        ->type_name("FILE");
    auto* force = run->add_flag("--force", line.force,
                                "overwrite a result, drop an unfinished run");
    auto* resume = run->add_flag("--resume", line.resume,
                                 "go on with an unfinished run, if there is one")
                       ->excludes(force);
    run->add_flag("--rerun-failed", line.rerun_failed,
                  "do only the items again that failed or took too long, and write the "
                  "result anew")
        ->excludes(force)
        ->excludes(resume);
    run->add_option("--item-seconds", line.item_seconds,
                    "an item that takes longer counts as failed, and the others go on; "
                    "default: no limit")
        ->type_name("SECONDS")
        ->check(not_above_zero);
    run->add_option("--threads", line.n_threads,
                    "compute threads of each rank; default: its share of the cores")
        ->check(CLI::Range(1, 4096));
    run->add_option("--stop-after", line.stop_after_s,
                    "begin nothing more after so many seconds, finish what is running, "
                    "and exit with 75; --resume goes on")
        ->type_name("SECONDS")
        ->check(not_above_zero);
    run->add_option(
           "--first-chain", line.first_chain,
           "number of the first chain of a posterior: runs of one job with other "
           "chains, say an array of a batch system, are put together by report")
        ->check(CLI::Range(0, 1000000000));
    run->add_option(
           "--after", line.last_night,
           "of a stock: result of the last night; only what has changed since is "
           "done again")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    run->add_flag("--no-report", line.no_report,
                  "write no page with pictures beside the result");
}

void add_describe(CLI::App& app, CommandLine& line) {
    CLI::App* describe = app.add_subcommand(
        "describe",
        "print every key of a job, dataset of a result, number that a parameter may name, "
        "refinement of its structure, effect that a loop may find, or public holiday");
    describe
        ->add_option("TOPIC", line.topic,
                     "job, results, parameters, structure, effects or holidays; of a job "
                     "also a kind of study or a section alone: posterior, meter")
        ->required();
    describe->add_option(
        "PLACE", line.place,
        "of holidays: a country and perhaps a state, US or DE-BY; none = "
        "list them; of man: 1 or 5; of completion: bash or zsh");
    describe->add_option("YEARS", line.years, "of holidays: 2021, or 2020-2022");
}

void add_adopt(CLI::App& app, CommandLine& line) {
    CLI::App* adopt = app.add_subcommand(
        "adopt", "write a job anew with what its loop found: effects, hours, priors");
    adopt->add_option("RESULT", line.file, "result file of a job with a loop")
        ->required();
    adopt->add_option("JOB", line.job, "that job, of one building; it stays as it is")
        ->required();
    adopt
        ->add_option(
            "-o,--output", line.output,
            "the new job, beside the old one; of a loop around a [simulator] a new folder")
        ->type_name("FILE")
        ->required();
    adopt->add_option("--stage", line.stage,
                      "BUILDING/STUDY, where the result has several loops");
    adopt->add_flag("--keep-priors", line.keep_priors,
                    "keep the job's own priors, for another study of the same readings");
    adopt->add_flag("--force", line.force, "write over the new job");
}

/// Options of `new` with a value; scripts/new says what is wrong with one.
struct NewOption {
    const char *name, *type, *says;
    bool is_required = false, repeats = false;
};
constexpr NewOption new_options[] = {
    {"--weather", "FILE",
     "EPW of a measured year, or a CSV file with outdoor temperature; once for each file",
     true, true},
    {"--meter", "FILE[:COLUMN[:QUANTITY[:UNIT]]]",
     "readings as CSV, a table of bills, an export of ENERGY STAR Portfolio Manager, or "
     "Green Button XML; once for each file or column",
     true, true},
    {"--idf", "FILE",
     "EnergyPlus's .idf or .epJSON, in place of area, year, storeys and height; use may be "
     "left out"},
    {"--area", "M2", "heated or cooled floor area"},
    {"--use", "USE", "office, school, house, apartments, retail, hotel, ..."},
    {"--built", "YEAR", "when it was built, or its envelope renewed"},
    {"--place", "COUNTRY", "two letters, perhaps with a state: GB, DE-BY, US-NY", true},
    {"--site", "LAT,LON", "where it stands; left out: as the EPW file says"},
    {"--storeys", "N", "left out: by use and area"},
    {"--height", "M", "of a storey; left out: by use"}};

void add_new(CLI::App& app, CommandLine& line) {
    CLI::App* first = app.add_subcommand(
        "new", "write a first job from weather, meters, area, use, age and place");
    first->add_option("JOB", line.job, "the job to be written, with .toml")->required();
    for (const NewOption& option : new_options)
        first->add_option(option.name, line.words_of[option.name], option.says)
            ->type_name(option.type)
            ->expected(1)
            ->multi_option_policy(option.repeats ? CLI::MultiOptionPolicy::TakeAll
                                                 : CLI::MultiOptionPolicy::Throw)
            ->required(option.is_required);
    first->add_flag("--rooms", line.rooms,
                    "with --idf: a zone for each of its zones; default: one");
    first->add_flag("--simulator", line.simulator,
                    "with --idf: the job runs that EnergyPlus model, too; files for that "
                    "are written beside it");
    first->add_flag("--force", line.force, "write over the job, and over a result");
    first->add_flag("--run", line.runs, "run the job, too");
}

void add_status(CLI::App& app, CommandLine& line) {
    CLI::App* status =
        app.add_subcommand("status", "print whether a result is complete, and its hash");
    status
        ->add_option("FILE", line.file, "result file, also of a run that is not complete")
        ->required();
    auto* watch =
        status->add_flag("--watch", line.watch,
                         "first print the progress of its run until that has ended");
    status
        ->add_option("--every", line.every_s,
                     "between lines; default: 1 on a terminal, else 10")
        ->type_name("SECONDS")
        ->needs(watch)
        ->check(not_above_zero);
}

void add_others(CLI::App& app, CommandLine& line) {
    CLI::App* check =
        app.add_subcommand("check", "read everything, start no study, print the plan");
    check->add_option("JOB", line.job, "job file, or a folder NAME with NAME.toml")
        ->required();
    auto* slurm = check->add_flag("--slurm", line.slurm,
                                  "print what to ask Slurm for, as #SBATCH lines");
    check
        ->add_option("--nodes", line.slurm_request.n_nodes,
                     "nodes to be used; default: 1")
        ->needs(slurm)
        ->check(CLI::Range(1, 100000));
    check
        ->add_option("--cores-per-node", line.slurm_request.cores_per_node,
                     "of each node; default: what makes it half an hour, at most 16")
        ->needs(slurm)
        ->check(CLI::Range(1, 4096));
    add_describe(app, line);
    add_status(app, line);
    add_new(app, line);
    add_adopt(app, line);
    CLI::App* report = app.add_subcommand("report", "print results as tables");
    report
        ->add_option("FILE", line.files,
                     "result files; those of one job with other chains become one")
        ->required();
    auto* csv = report
                    ->add_option("--csv", line.csv,
                                 "write every dataset as CSV into this new folder "
                                 "instead, by building and study")
                    ->type_name("FOLDER");
    report
        ->add_option("--parquet", line.parquet,
                     "write tables as Parquet into this new folder instead; takes "
                     "Python's pyarrow")
        ->type_name("FOLDER")
        ->excludes(csv);
}

/// `run` where no command stands first. Throws UserError (usage) of a word that is nearly
/// one, and no file.
std::vector<std::string> arguments(int argc, char** argv) {
    static const std::vector<std::string> commands{
        "run", "check", "describe", "status", "report", "adopt", "new"};
    std::vector<std::string> words(argv + 1, argv + argc);
    const auto is_one_of = [&](const std::vector<std::string>& known) {
        return !words.empty() && std::ranges::count(known, words[0]) > 0;
    };
    if (is_one_of(commands) || is_one_of({"-h", "--help", "--version"})) return words;
    const std::string near = words.empty() ? "" : input::nearest(words[0], commands);
    if (!near.empty() && !std::filesystem::exists(words[0]))
        throw UserError(ExitCode::usage,
                        fmt::format("{}: there is no such command or job; did you mean "
                                    "\"{}\"?",
                                    words[0], near));
    words.insert(words.begin(), "run");
    return words;
}

/// Each line by itself: a job's mistakes are told together.
void print_warning(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        print(stderr, fmt::format("bemcal-batch: {}\n", line));
}

void print_tables(const store::ResultFile& result) {
    const std::string text = report::tables_of(result);
    if (text.empty()) return;
    print(stdout, text + "\n");
}

/// What is wrong with a result's content is told with the name of its file.
void print_tables_of(const fs::path& file, const store::ResultFile& result) {
    try {
        print_tables(result);
    } catch (const UserError& error) {
        throw UserError(error.exit_code(),
                        fmt::format("{}: {}", file.string(), error.what()));
    }
}

/// From now, which is the program's start.
std::optional<Clock::time_point> stop_at(const CommandLine& line) {
    if (line.stop_after_s <= 0) return std::nullopt;
    const std::chrono::duration<double> limit(std::min(line.stop_after_s, 1e9));
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

/// Table, history and page of a night.
void write_stock(const run::OutputNames& names, const run::JobOptions& options) {
    try {
        report::write_stock_files(names, store::read_result(names.result, "stock"));
    } catch (const UserError& error) {
        throw UserError(error.exit_code(),
                        fmt::format("{}; the result is whole, and --resume writes its "
                                    "table and history",
                                    error.what()));
    }
    print_warning(fmt::format("wrote {} and {}; nights: {}", names.table.string(),
                              names.changes.string(), names.history.string()));
    if (options.pages)
        print_warning(options.pages->write_stock(names.result, names.history));
}

/// The environment names a kernel that this machine has.
void check_kernel() {
    try {
        kernel::choose_instruction_set();
    } catch (const std::invalid_argument& error) {
        throw UserError(ExitCode::usage, error.what());
    }
}

ExitCode run_command(run::Comm& comm, const CommandLine& line) {
    check_kernel();
    const run::SignalWatch watch;  // already while the job is read
    run::JobOptions options;
    options.is_numbered = line.job.empty();
    options.output = line.output;
    options.existing = line.force          ? run::Existing::force
                       : line.resume       ? run::Existing::resume
                       : line.rerun_failed ? run::Existing::rerun_failed
                                           : run::Existing::refuse;
    options.item_seconds = line.item_seconds;
    options.n_threads = line.n_threads;
    options.stop_at = stop_at(line);
    options.first_chain = line.first_chain;
    options.last_night = line.last_night;
    options.version = BEMCAL_VERSION;
    options.say = print_warning;
    options.on_stage = print_tables;
    if (!line.no_report)
        options.pages = run::PageWriter{run::find_script(
            "scripts/result_report", {BEMCAL_SOURCE_DIR, BEMCAL_DATA_DIR})};
    run::together(comm, [&] {
        options.job = line.job.empty()
                          ? run::find_quickstart({BEMCAL_SOURCE_DIR, BEMCAL_DATA_DIR})
                          : run::job_file(line.job);
    });
    const run::Outcome outcome = run::run_job(comm, options);
    if (outcome.stock) write_stock(*outcome.stock, options);
    return outcome.code;
}

ExitCode check_command(const CommandLine& line, int n_ranks) {
    const job::Job job = job::read_job(run::job_file(line.job));
    if (line.slurm) {
        print(stdout, plan::slurm_lines(plan::plan_cost(job), line.slurm_request));
        return ExitCode::ok;
    }
    run::choose_output(job, {});  // which a run would refuse
    const auto cores = static_cast<int>(run::placement().cores.size());
    print(stdout, plan::plan_text(job, std::max(cores, n_ranks)));
    return ExitCode::ok;
}

std::string holidays_text(const CommandLine& line) {
    if (line.place.empty()) return holidays::describe_countries();
    try {
        return holidays::describe(line.place, line.years);
    } catch (const std::invalid_argument& error) {
        throw UserError(ExitCode::usage, error.what());
    }
}

constexpr const char* general_topics[] = {"job",       "results", "parameters",
                                          "structure", "effects", "holidays"};

std::vector<std::string> topics() {
    std::vector<std::string> all(std::begin(general_topics), std::end(general_topics));
    for (std::string& topic : job::job_topics())
        if (std::ranges::find(all, topic) == all.end()) all.push_back(std::move(topic));
    return all;
}

/// "FILE[:COLUMN]" of "FILE[:COLUMN]:PATH(existing)": the type without what it is checked
/// for.
std::string without_check(const std::string& type) {
    int depth = 0;
    const auto end = std::ranges::find_if(type, [&](char c) {
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        return c == ':' && depth == 0;
    });
    return {type.begin(), end};
}

manual::Option manual_of(const CLI::Option& option) {
    manual::Option made;
    for (const std::string& name : option.get_snames()) made.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) made.names.push_back("--" + name);
    made.sentence = option.get_description();
    made.repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    if (made.names.empty())
        made.value = option.get_name();
    else if (option.get_expected_min() > 0) {
        made.value = without_check(option.get_type_name());
    }
    return made;
}

manual::Program manual_of(const CLI::App& app) {
    manual::Program program{
        "bemcal-batch", BEMCAL_VERSION, app.get_description(), app.get_footer(), {},
        topics()};
    for (const CLI::App* sub :
         app.get_subcommands([](const CLI::App*) { return true; })) {
        manual::Command& command = program.commands.emplace_back(
            manual::Command{sub->get_name(), sub->get_description(), {}});
        for (const CLI::Option* option : sub->get_options())
            command.options.push_back(manual_of(*option));
    }
    return program;
}

/// Man pages and completions, for those who install the program; "" = neither.
std::string manual_text(const CLI::App& app, const std::string& of) {
    const manual::Program program = manual_of(app);
    return of == "man 1"   ? manual::man_page_of(program)
           : of == "man 5" ? manual::man_page_of_job(program, job::describe_job())
           : of == "completion bash" ? manual::bash_completion(program)
           : of == "completion zsh"  ? manual::zsh_completion(program)
                                     : "";
}

std::string topic_text(const CLI::App& app, const CommandLine& line) {
    const std::string& topic = line.topic;
    if (topic == "holidays") return holidays_text(line);
    if (!line.place.empty()) return manual_text(app, topic + " " + line.place);
    return topic == "job"          ? job::describe_job()
           : topic == "results"    ? store::describe_results()
           : topic == "structure"  ? effects::describe_structure()
           : topic == "effects"    ? effects::describe()
           : topic == "parameters" ? job::describe_parameters()
                                   : job::describe_topic(topic);
}

ExitCode describe_command(const CLI::App& app, const CommandLine& line) {
    const std::string text = topic_text(app, line);
    const bool is_man = line.topic == "man";
    if (text.empty() && (is_man || line.topic == "completion"))
        throw UserError(ExitCode::usage,
                        fmt::format("describe {0}{1}{2}: expected {0} {3}", line.topic,
                                    line.place.empty() ? "" : " ", line.place,
                                    is_man ? "1 or 5" : "bash or zsh"));
    if (text.empty() && !line.place.empty())
        throw UserError(
            ExitCode::usage,
            fmt::format(
                "describe {} {}: expected nothing after {}; what has more are man "
                "1, man 5, completion bash, completion zsh, and holidays COUNTRY",
                line.topic, line.place, line.topic));
    if (text.empty())
        throw UserError(ExitCode::usage,
                        fmt::format("describe {}: there is no such topic{}", line.topic,
                                    input::suggestion(line.topic, topics())));
    print(stdout, text);
    return ExitCode::ok;
}

/// Nothing where no run writes it.
void watch(const CommandLine& line) {
    std::optional<std::chrono::duration<double>> every;
    if (line.every_s > 0) every.emplace(std::min(line.every_s, 1e6));
    run::watch_run(line.file, every);
}

ExitCode status_command(const CommandLine& line) {
    if (line.watch) watch(line);
    if (run::is_unfinished(line.file)) {
        print(stdout, fmt::format("{}: {}", line.file.string(),
                                  run::part_status(run::part_folder_of(line.file))));
        return ExitCode::more_to_do;
    }
    const store::ResultFile result = store::read_result(line.file);
    print(stdout, fmt::format("{}: {}", line.file.string(), report::status_of(result)));
    return report::is_damaged(result) ? ExitCode::data : ExitCode::ok;
}

/// \param lines  what `status` says of each \return data where one is damaged
ExitCode statuses_of(const CommandLine& line,
                     const std::vector<store::ResultFile>& results,
                     std::vector<std::string>& lines) {
    ExitCode code = ExitCode::ok;
    for (std::size_t k = 0; k < results.size(); ++k) {
        lines.push_back(fmt::format("{}: {}\n", line.files[k].string(),
                                    report::status_of(results[k])));
        if (!report::is_damaged(results[k])) continue;
        code = ExitCode::data;
        print_warning(line.files[k].string() +
                      ": is damaged: its numbers are not those that were written");
    }
    return code;
}

/// One result into the folder itself, several each into one by its name.
void write_csv(const fs::path& folder, const std::vector<fs::path>& files,
               const std::vector<store::ResultFile>& results) {
    for (std::size_t k = 0; k < results.size(); ++k) {
        const fs::path into = results.size() == 1 ? folder : folder / files[k].stem();
        const int n = report::write_csv_files(results[k], into);
        print_warning(fmt::format("wrote {} files into {}", n, into.string()));
    }
}

/// By scripts/NAME, whose messages and codes are this program's.
/// \param takes  what it needs of Python, told where it does not run
ExitCode script_command(const std::string& name, std::vector<std::string> words,
                        const char* takes) {
    const auto script =
        run::find_script("scripts/" + name, {BEMCAL_SOURCE_DIR, BEMCAL_DATA_DIR});
    if (!script)
        throw UserError(ExitCode::no_input,
                        fmt::format("scripts/{} was not found beside the program; cmake "
                                    "--install puts it there",
                                    name));
    words.insert(words.begin(), script->string());
    const int code = run::code_of_program(std::move(words), run::Said::shown);
    if (code < 0)
        throw UserError(ExitCode::os, fmt::format("{}: did not run; it takes {}",
                                                  script->string(), takes));
    return static_cast<ExitCode>(code);
}

/// Parquet has a library for Python, none for C++ in Debian.
ExitCode parquet_command(const CommandLine& line) {
    std::vector<std::string> words{"--parquet", line.parquet.string()};
    for (const fs::path& file : line.files) words.push_back(file.string());
    return script_command("result_tables", std::move(words),
                          "Python with pandas, xarray, h5py and pyarrow");
}

/// Each file with its tables; where chains were put together, all files come first.
ExitCode report_command(const CommandLine& line) {
    if (!line.parquet.empty()) return parquet_command(line);
    std::vector<store::ResultFile> results;
    results.reserve(line.files.size());
    for (const fs::path& file : line.files) results.push_back(store::read_result(file));
    std::vector<std::string> lines;
    const ExitCode code = statuses_of(line, results, lines);
    const std::size_t n_files = results.size();
    const auto merged = report::merge_chains(std::move(results));
    if (!line.csv.empty()) {
        write_csv(line.csv, line.files, merged);
        return code;
    }
    for (std::size_t k = 0; k < n_files; ++k) {
        print(stdout, lines[k]);
        if (merged.size() == n_files) print_tables_of(line.files[k], merged[k]);
    }
    if (merged.size() == n_files) return code;
    for (const store::ResultFile& result : merged) print_tables_of(line.files[0], result);
    return code;
}

ExitCode adopt_command(const CommandLine& line) {
    std::vector<std::string> words{line.file.string(), line.job.string(), "-o",
                                   line.output.string()};
    if (!line.stage.empty()) words.insert(words.end(), {"--stage", line.stage});
    if (line.keep_priors) words.emplace_back("--keep-priors");
    if (line.force) words.emplace_back("--force");
    return script_command(
        "adopt", std::move(words),
        "Python with h5py and tomlkit (Debian: python3-h5py, python3-tomlkit)");
}

/// Values go behind `=`, for one may begin with a minus.
ExitCode write_first_job(const CommandLine& line) {
    std::vector<std::string> words{line.job.string()};
    for (const auto& [option, values] : line.words_of)
        for (const std::string& value : values)
            words.push_back(fmt::format("{}={}", option, value));
    if (line.rooms) words.emplace_back("--rooms");
    if (line.simulator) words.emplace_back("--simulator");
    if (line.force) words.emplace_back("--force");
    return script_command("new", std::move(words), "Python 3.11 or newer");
}

/// Rank 0 writes the job; all ranks run it.
ExitCode new_command(run::Comm& comm, const CommandLine& line) {
    run::Bytes code(1);
    run::together(comm, [&] {
        if (comm.rank() == 0) code[0] = static_cast<std::byte>(write_first_job(line));
    });
    const auto written = static_cast<ExitCode>(comm.all_gather(code)[0][0]);
    return written == ExitCode::ok && line.runs ? run_command(comm, line) : written;
}

/// Commands that one rank is enough for; the others have nothing to do.
ExitCode alone(run::Comm& comm, const CLI::App& app, const CommandLine& line) {
    if (comm.rank() != 0) return ExitCode::ok;
    if (app.got_subcommand("check")) return check_command(line, comm.size());
    if (app.got_subcommand("describe")) return describe_command(app, line);
    if (app.got_subcommand("status")) return status_command(line);
    if (app.got_subcommand("adopt")) return adopt_command(line);
    return report_command(line);
}

/// Help and version are no errors; a command line that is wrong gets code 64.
int parse_failed(const CLI::App& app, const CLI::ParseError& error, int rank) {
    const bool is_help = error.get_exit_code() == 0;
    std::ostringstream out, complaint;
    app.exit(error, out, complaint);
    if (rank == 0) print(stdout, out.str());
    if (rank == 0) print(stderr, complaint.str());
    return is_help ? 0 : static_cast<int>(ExitCode::usage);
}

int run_program(run::Comm& comm, int argc, char** argv) {
    CLI::App app(
        "Calibrates hourly building energy models against measured data, in batches.",
        "bemcal-batch");
    app.set_version_flag("--version", "bemcal-batch " BEMCAL_VERSION);
    app.require_subcommand(1);
    app.footer(footer);
    CommandLine line;
    add_run(app, line);
    add_others(app, line);
    std::vector<std::string> words = arguments(argc, argv);
    std::reverse(words.begin(), words.end());
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        return parse_failed(app, error, comm.rank());
    }
    return static_cast<int>(app.got_subcommand("run")   ? run_command(comm, line)
                            : app.got_subcommand("new") ? new_command(comm, line)
                                                        : alone(comm, app, line));
}

int reported_code(run::Comm& comm, int argc, char** argv) {
    try {
        return run_program(comm, argc, argv);
    } catch (const UserError& error) {
        if (comm.rank() == 0) print_warning(error.what());
        return static_cast<int>(error.exit_code());
    }
}

/// What was printed into a full or closed stream is no success.
int with_lost_output(int code) {
    if (code != 0 || !is_output_lost()) return code;
    if (!has_reader_gone())  // a reader such as `head` that has enough needs no words
        print_warning(
            "what was printed could not be written: the stream is full or closed");
    return static_cast<int>(ExitCode::io);
}

/// One rank's end is the end of all.
[[noreturn]] void abort(run::Comm& comm, const UserError& error) {
    print_warning(fmt::format("rank {}: {}", comm.rank(), error.what()));
    external::end_commands();
    run::end_is_planned();
    comm.abort(static_cast<int>(error.exit_code()));
}

}  // namespace

int main(int argc, char** argv) {
    open_standard_streams();
    run::watch_for_unplanned_end();
    run::keep_freed_memory();
    run::Comm comm(&argc, &argv);
    try {
        const int code = with_lost_output(reported_code(comm, argc, argv));
        external::end_commands();
        run::end_is_planned();
        if (comm.has_left_threads()) comm.leave(code);
        return code;
    } catch (const std::exception&) {
        abort(comm, as_user_error(std::current_exception()));
    }
}
