/// Reads a job file into a Job: each section by its reader, in an order in which it finds
/// what it needs; then studies against buildings; then every key accounted for. Mistakes
/// are told together; one that leaves nothing to read (no file, no TOML) is told alone.
/// Follows from pbrt's rule that a key without effect is an error.
/// The sections' keys are the readers' (`read_*`). Lines of a stock are read where they
/// are worked on.
#include "base/error.hpp"
#include "checks/series.hpp"
#include "description/building_readers.hpp"
#include "description/read_quantities.hpp"
#include "description/read_simulator.hpp"
#include "description/result_names.hpp"
#include "job/job.hpp"
#include "job/kinds.hpp"
#include "job/stock.hpp"
#include "job/studies.hpp"

#include <algorithm>
#include <list>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

/// \param names  of the buildings
void add_case(Job& job, std::vector<BuildingNames>& names, input::InputFiles& files,
              const description::Sources& sources) {
    const schema::Section& own = sources.own;
    study::Case building = description::read_case(sources, files);
    description::check_name(own, "name", description::Named::building, building.name);
    for (const study::Case& other : job.buildings)
        if (other.name == building.name)
            own.fail("name",
                     fmt::format("another building is called \"{}\"", building.name));
    names.push_back(names_of(building, sources));
    job.buildings.push_back(std::move(building));
}

/// Files with a building each; their trees are kept until all keys are checked.
void read_building_files(const schema::Section& root, input::InputFiles& files, Job& job,
                         std::vector<BuildingNames>& names) {
    struct File {
        std::string name;
        schema::Node tree;
    };
    std::list<File> trees;
    const std::vector<std::string> paths = root.texts("buildings");
    if (paths.empty())
        root.fail("buildings", "is empty; expected files with a building each");
    for (const std::string& file : paths)
        root.attempt([&] {
            const std::filesystem::path path = root.path(file);
            trees.push_back({path.string(), {}});
            trees.back().tree = schema::parse_document(
                files.text(path, root.where("buildings")), trees.back().name);
            const schema::Section own(trees.back().tree, "building", trees.back().name,
                                      "", schema::job_table(), root.mistakes());
            add_case(job, names, files, {own, root});
            schema::check_all_used(own);
        });
}

/// \param has_mistakes  studies may be missing that could not be read
bool needs_building(const Job& job, bool has_mistakes) {
    return (job.studies.empty() && !has_mistakes) ||
           std::ranges::any_of(job.studies, [](const StudySpec& study) {
               return study.kind->is_of_buildings;
           });
}

bool has_twin(const Job& job) {
    return std::ranges::any_of(
        job.studies, [](const StudySpec& study) { return study.kind->takes_twin; });
}

/// Building or buildings; where there is a simulator, sections of one have an effect as
/// its twin only.
void read_buildings(const schema::Section& root, input::InputFiles& files, Job& job,
                    std::vector<BuildingNames>& names) {
    if (root.has("simulator") && !has_twin(job)) return;
    if (root.has("buildings"))
        read_building_files(root, files, job, names);
    else if (needs_building(job, root.n_failures() > 0) || root.has("zone"))
        add_case(job, names, files, {root, std::nullopt});
}

/// Sections that only a building reads, where there is none because of a mistake.
void skip_sections_of_buildings(const schema::Section& root) {
    for (const schema::Key& key : schema::job_table().keys_of("building"))
        root.skip(key.key);
    root.skip("buildings");
}

/// The studies against what is simulated; of a job that could not be read whole their
/// names alone. Scenarios are read by studies.
void check_as_a_whole(const schema::Section& root,
                      const std::vector<BuildingNames>& names, Job& job) {
    const bool is_whole = root.n_failures() == 0;
    if (is_whole) checks::check_shared_meters(job.buildings);
    root.attempt([&] { check_studies_of(root, names, is_whole, job); });
    if (root.n_failures() > 0) root.skip("scenario");
    if (is_whole) return;
    root.skip("study");
    if (job.buildings.empty()) skip_sections_of_buildings(root);
}

void read_job_simulator(const schema::Section& root, input::InputFiles& files, Job& job) {
    if (!root.has("simulator")) return;
    const external::CommandOptions options = description::read_simulator(
        root.table("simulator", "simulator"), files, job.name);
    job.simulator = external::make_command_simulator(options);
    if (!options.hours.empty())
        job.hourly_simulator = external::make_hourly_simulator(options);
}

void read_output(const schema::Section& root, Job& job) {
    if (!root.has("output")) return;
    const schema::Section section = root.table("output", "output");
    section.attempt_all(
        [&] { job.output = section.text("file"); },
        [&] { job.hourly_outputs = description::read_quantities(section, "hourly"); });
    job.max_failed_share = section.number("max_failed_share");
}

/// The table and what is done with every line; the lines are read by those who work on
/// them.
void read_stock_job(const schema::Section& root, input::InputFiles& files, Job& job) {
    for (const char* key : {"buildings", "zone", "simulator", "scenario"})
        if (root.has(key))
            root.fail(key,
                      "has no place beside [stock]; a building's sections stand in its "
                      "template or in the files that its table names");
    const std::string words =
        words_of_kinds([](const Kind& kind) { return kind.takes_stock; });
    if (job.studies.size() != 1)
        root.fail("study", fmt::format("has {} sections; a stock has one: {}",
                                       job.studies.size(), words));
    if (!job.studies[0].kind->takes_stock)
        open_studies(root)[0].section.fail_value("kind",
                                                 "a stock has one study: " + words);
    job.stock = read_stock(root.table("stock", "stock"), files);
}

}  // namespace

Job read_job(const std::filesystem::path& file, input::InputFiles& files) {
    Job job;
    job.file = file;
    job.text = files.text(file);
    if (file.extension() == ".csv")
        job.text = job_text_of_table(file.filename().string());
    const std::string name = file.string();
    const schema::Node tree = schema::parse_document(job.text, name);
    schema::Mistakes mistakes;
    const schema::Section root(tree, "job", name, "", schema::job_table(), &mistakes);
    root.attempt(
        [&] { job.name = root.has("name") ? root.text("name") : file.stem().string(); });
    root.attempt([&] { job.seed = static_cast<std::uint64_t>(root.integer("seed")); });
    root.attempt([&] { read_job_simulator(root, files, job); }, {"simulator"});
    root.attempt(
        [&] { job.studies = read_studies(root, files, job.seed, job.simulator); },
        {"study"});
    root.attempt([&] { read_output(root, job); }, {"output"});
    if (root.has("stock")) {
        root.attempt([&] { read_stock_job(root, files, job); });
    } else {
        std::vector<BuildingNames> names;
        root.attempt([&] { read_buildings(root, files, job, names); });
        check_as_a_whole(root, names, job);
        schema::check_all_used(root);
    }
    mistakes.throw_all(name);
    job.inputs = files.log();
    return job;
}

Job read_job(const std::filesystem::path& file) {
    input::InputFiles files;
    return read_job(file, files);
}

}  // namespace bemcal::job
