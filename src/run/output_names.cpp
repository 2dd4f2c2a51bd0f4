/// Holds what a run would write against what it reads, by name and by device and inode,
/// before anything is computed.
/// Our own rules, without a source. Files that only a building's own text names are known
/// later; a file that is not of our form is therefore never replaced.
#include "run/output_names.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "job/stock.hpp"
#include "run/part_folder.hpp"
#include "stock/record.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 240;  ///< of 255 bytes; a fresh name is longer

fs::path normal(const fs::path& path) {
    return fs::absolute(path).lexically_normal();
}

bool lies_in(const fs::path& path, const fs::path& folder) {
    return path.native().starts_with(folder.native() + "/");
}

/// Files that a job reads, under every name that we know.
class Inputs {
  public:
    void add(const fs::path& path) {
        if (path.empty()) return;
        const auto id = file_id(path);
        if (id) ids_.insert(*id);
        names_.insert(normal(path));
    }
    /// By name alone: a stock has many, and most cells are no files.
    void add_cell(const fs::path& path) { names_.insert(normal(path)); }

    /// The input that stands there, or below there; none: there is none.
    std::optional<fs::path> at(const fs::path& path) const {
        const fs::path wanted = normal(path);
        if (names_.contains(wanted)) return path;
        const auto id = file_id(path);
        if (id && ids_.contains(*id)) return path;
        for (const fs::path& name : names_)
            if (lies_in(name, wanted)) return name;
        return std::nullopt;
    }

  private:
    std::set<FileId> ids_;
    std::set<fs::path> names_;
};

void add_cells(const job::Stock& stock, Inputs& inputs) {
    std::error_code ignored;
    const bool is_folder = fs::is_directory(stock.table, ignored);
    const std::array folders{is_folder ? stock.table : stock.table.parent_path(),
                             fs::path(stock.template_name).parent_path()};
    std::set<std::string> cells;
    for (const job::StockLine& line : stock.lines)
        cells.insert(line.cells.begin(), line.cells.end());
    for (const std::string& cell : cells)
        for (const fs::path& folder : folders)
            if (!cell.empty()) inputs.add_cell(folder / cell);
}

Inputs inputs_of(const job::Job& job, const OutputWish& wish) {
    Inputs inputs;
    for (const input::InputFile& file : job.inputs) inputs.add(file.path);
    inputs.add(job.file);
    inputs.add(wish.last_night);
    if (job.stock) add_cells(*job.stock, inputs);
    return inputs;
}

/// The first bytes; empty where it cannot be read.
std::string begin_of(const fs::path& path, std::size_t n) {
    std::ifstream in(path, std::ios::binary);
    std::string bytes(n, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(n));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    return bytes;
}

/// Whether a pipe or device stands there, or a file that does not begin so. An empty one
/// is nobody's loss.
bool is_of_another(const fs::path& path, const std::string& head) {
    std::error_code ignored;
    if (fs::is_other(path, ignored)) return true;
    if (!fs::is_regular_file(path, ignored)) return false;
    const std::string begin = begin_of(path, head.size());
    return !begin.empty() && begin != head;
}

/// What is wrong with that name of a result; empty = nothing.
std::string complaint(const fs::path& result, const Inputs& inputs) {
    if (result.filename().native().size() > longest_name)
        return fmt::format("{}: a result cannot have a name of more than {} bytes",
                           result.string(), longest_name);
    if (const auto input = inputs.at(result))
        return fmt::format(
            "{}: is an input of this job, and the result would take its "
            "place",
            input->string());
    if (const auto input = inputs.at(part_folder_of(result)))
        return fmt::format(
            "{}: is an input of this job, and the run would keep its "
            "files there",
            input->string());
    if (is_of_another(result, "\x89HDF"))
        return fmt::format("{}: is there already, and is no result", result.string());
    return {};
}

/// NAME.h5, NAME-result.h5, NAME-result-2.h5, ...: the first that can be one.
fs::path free_name(const std::string& name, const Inputs& inputs,
                   const fs::path& folder) {
    const auto candidate = [&](int number) {
        return folder / (number == 0   ? name + ".h5"
                         : number == 1 ? name + "-result.h5"
                                       : fmt::format("{}-result-{}.h5", name, number));
    };
    int number = 0;
    while (!complaint(candidate(number), inputs).empty()) ++number;
    return candidate(number);
}

/// So that a job's name can begin a file's.
std::string shortened(const std::string& name) {
    return name.substr(0, longest_name - 40);
}

fs::path numbered(const std::string& name) {
    for (int number = 1;; ++number) {
        const fs::path path = fmt::format("{}-{:03}.h5", name, number);
        if (!is_taken(path) && !is_taken(part_folder_of(path))) return path;
    }
}

fs::path result_of(const job::Job& job, const OutputWish& wish, const Inputs& inputs) {
    const std::string name = shortened(job.name);
    fs::path named = wish.named.empty() ? job.output : wish.named;
    if (named.empty())
        return wish.is_numbered ? numbered(name) : free_name(name, inputs, "");
    if (const std::string said = complaint(named, inputs); !said.empty())
        throw UserError(
            ExitCode::cannot_create,
            fmt::format("{}; choose another name, like -o {}", said,
                        free_name(name, inputs, named.parent_path()).string()));
    return named;
}

/// The first of FOLDER/FIRST.csv, FOLDER/OTHER.csv, FOLDER/OTHER-2.csv, ... that may be
/// written.
fs::path beside(const fs::path& result, const std::string& first,
                const std::string& other, const char* head, const Inputs& inputs) {
    const auto is_free = [&](const fs::path& path) {
        return !inputs.at(path) && !is_of_another(path, head) && !fs::is_directory(path);
    };
    fs::path path = fs::path(result).replace_filename(first + ".csv");
    if (is_free(path)) return path;
    path.replace_filename(other + ".csv");
    for (int number = 2; !is_free(path); ++number)
        path.replace_filename(fmt::format("{}-{}.csv", other, number));
    return path;
}

/// Of "BUILDING/STUDY"; "" of a study that is of no single building.
std::string building_of(const std::string& stage) {
    const std::size_t end = stage.find('/');
    return end == std::string::npos ? "" : stage.substr(0, end);
}

}  // namespace

fs::path page_of(const fs::path& result, const std::string& suffix) {
    return fs::path(result).replace_filename(result.stem().string() + suffix + ".html");
}

std::vector<Page> pages_of(const fs::path& result,
                           const std::vector<std::string>& stages) {
    std::vector<Page> pages;
    Page of_none{page_of(result), {}};
    for (const std::string& stage : stages) {
        const std::string building = building_of(stage);
        const Page page{page_of(result, "-" + building), {building}};
        if (building.empty())
            of_none.stages.push_back(stage);
        else if (std::ranges::find(pages, page.file, &Page::file) == pages.end())
            pages.push_back(page);
    }
    if (stages.empty()) return {};
    if (pages.size() < 2) return {{of_none.file, {}}};
    if (!of_none.stages.empty()) pages.insert(pages.begin(), of_none);
    return pages;
}

OutputNames choose_output(const job::Job& job, const OutputWish& wish) {
    const Inputs inputs = inputs_of(job, wish);
    OutputNames names{result_of(job, wish, inputs), {}, {}, {}};
    if (!job.stock) return names;
    const std::string stem = names.result.stem().string(), title = shortened(job.name);
    names.table = beside(names.result, stem, stem + "-table", stock::table_head, inputs);
    names.history = beside(names.result, title + "-history", title + "-history",
                           stock::history_head, inputs);
    names.changes = beside(names.result, stem + "-changes", stem + "-changes",
                           stock::changes_head, inputs);
    return names;
}

}  // namespace bemcal::run
