/// Reads [stock], a table or folder, and makes of a line a job of one building: from its
/// own file, the template with @column@ filled in, or its columns (`stock_description`).
/// Follows from the readers of any job; its seed comes from the stock's and its name.
/// A line that cannot be used keeps its complaint. Data are read by the worker alone.
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/lower_case.hpp"
#include "description/building_readers.hpp"
#include "description/result_names.hpp"
#include "input/suggest.hpp"
#include "job/adopted.hpp"
#include "job/stock.hpp"
#include "job/stock_description.hpp"
#include "job/studies.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

namespace {

namespace fs = std::filesystem;

constexpr const char* name_columns[] = {"name", "id", "building"};

std::string name_in(const StockLine& line) {
    for (const char* column : name_columns)
        if (const std::string name = line.cell(column); !name.empty()) return name;
    return {};
}

/// Empty = it can be one.
std::string refusal_of(const std::string& name) {
    if (name.empty()) return "has no name; expected a column name or id";
    if (name == "stock") return "the name \"stock\" is taken by the result";
    return description::refusal_of_name(description::Named::building, name);
}

/// A name that is missing, refused, or another line's is the line's complaint.
void check_names(std::vector<StockLine>& lines) {
    std::set<std::string> known;
    for (StockLine& line : lines) {
        std::string refusal = refusal_of(line.name);
        if (refusal.empty() && !known.insert(line.name).second)
            refusal = fmt::format("another line has the name \"{}\"", line.name);
        if (refusal.empty()) continue;
        line.complaint = refusal;
        line.name = fmt::format("line {}", line.line);
    }
}

/// Readings or weather in place of a table of buildings, say.
void check_columns(const input::Csv& csv) {
    const auto is_there = [&](const char* column) {
        return std::ranges::find(csv.columns, column) != csv.columns.end();
    };
    if (std::ranges::any_of(name_columns, is_there)) return;
    throw UserError(
        ExitCode::data,
        fmt::format("{}: has no column name or id, as a table of buildings has, but {}; "
                    "readings and weather go into a job (bemcal-batch new writes one)",
                    csv.file, fmt::join(csv.columns, ", ")));
}

/// Letters more or less, or small for large ones, that make a name another one.
int letters_off(const std::string& name, const std::string& other) {
    return input::edit_distance(lower_case(name), lower_case(other));
}

/// Names of one thing.
constexpr std::string_view aliases[][3] = {{"name", "id", "building"},
                                           {"floor_area", "floor_area_m2", ""}};

bool is_there(const input::Csv& csv, const std::string& column) {
    const auto stands = [&](std::string_view name) {
        return std::ranges::find(csv.columns, name) != csv.columns.end();
    };
    return stands(column) || std::ranges::any_of(aliases, [&](const auto& names) {
               return std::ranges::find(names, column) != std::end(names) &&
                      std::ranges::any_of(names, stands);
           });
}

/// A column that is none of those that are read, but nearly one that is not there.
void check_spelling(const input::Csv& csv, const std::vector<std::string>& read) {
    // Of short names one letter off is another word; of long ones two may be.
    constexpr std::size_t short_name = 4, long_name = 8;
    for (const std::string& column : csv.columns) {
        if (column.size() < short_name || std::ranges::find(read, column) != read.end())
            continue;
        const int most = column.size() < long_name ? 1 : 2;
        for (const std::string& other : read)
            if (letters_off(column, other) <= most && !is_there(csv, other))
                throw UserError(
                    ExitCode::data,
                    fmt::format(
                        "{}:{}: column \"{}\" is not read; did you mean \"{}\"? A "
                        "column of your own needs a name that is less like it",
                        csv.file, csv.header_line, column, other));
    }
}

std::vector<StockLine> lines_of(const input::Csv& csv) {
    check_columns(csv);
    std::vector<std::size_t> order(csv.columns.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::size_t k) { return csv.columns[k]; });
    std::vector<std::string> sorted;
    sorted.reserve(order.size());
    for (const std::size_t k : order) sorted.push_back(csv.columns[k]);
    const auto columns = std::make_shared<const std::vector<std::string>>(sorted);
    std::vector<StockLine> lines(csv.n_rows());
    for (std::size_t row = 0; row < lines.size(); ++row) {
        lines[row].line = csv.lines[row];
        lines[row].columns = columns;
        lines[row].cells.reserve(order.size());
        for (const std::size_t k : order) lines[row].cells.emplace_back(csv.cell(row, k));
        lines[row].name = name_in(lines[row]);
    }
    for (const input::Csv::ShortRow& odd : csv.short_rows)
        std::ranges::find(lines, odd.line, &StockLine::line)->complaint =
            fmt::format("has {} cell{}; expected {} as in the first line", odd.n_cells,
                        odd.n_cells == 1 ? "" : "s", csv.columns.size());
    return lines;
}

/// A line with cells too few or too many is a broken building, not a broken table.
const input::Csv& read_table(const schema::Section& section, const Stock& stock,
                             input::InputFiles& files) {
    input::CsvForm form;
    form.keeps_odd_rows = true;
    const input::Csv& csv = files.csv(stock.table, section.where("table"), form);
    const bool has_files = std::ranges::find(csv.columns, "file") != csv.columns.end();
    if (stock.template_name.empty() && !has_files) check_spelling(csv, read_columns());
    return csv;
}

std::vector<StockLine> lines_of(const schema::Section& section, const fs::path& folder) {
    const auto columns = std::make_shared<const std::vector<std::string>>(1, "file");
    std::vector<StockLine> lines;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".toml") {
            lines.emplace_back();
            lines.back().name = entry.path().stem().string();
            lines.back().columns = columns;
            lines.back().cells = {entry.path().filename().string()};
        }
    if (lines.empty())
        section.fail_value(
            "folder", error ? "cannot be read: " + error.message() : "holds no *.toml");
    std::ranges::sort(lines, {}, &StockLine::name);
    return lines;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool is_in_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The text with every @column@ in place; any other @ is itself.
std::string filled(const std::string& text, const StockLine& line,
                   const std::string& file) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at + 1;
        if (text[at] == '@' && end < text.size() && is_letter(text[end]))
            while (end < text.size() && is_in_name(text[end])) ++end;
        if (end == at + 1 || end >= text.size() || text[end] != '@') {
            result += text[at++];
            continue;
        }
        const std::string name = text.substr(at + 1, end - at - 1);
        const std::string* cell = line.find(name);
        if (cell == nullptr)
            throw UserError(
                ExitCode::config,
                fmt::format(
                    "{}:{}: @{}@: the table has no such column", file,
                    1 + std::count(text.begin(),
                                   text.begin() + static_cast<std::ptrdiff_t>(at), '\n'),
                    name));
        result += *cell;
        at = end + 1;
    }
    return result;
}

struct OwnText {
    std::string text, file;
    std::vector<study::DataDecision> decisions;
};

OwnText own_text(const Stock& stock, const StockLine& line, input::InputFiles& files) {
    if (const std::string file = line.cell("file"); !file.empty()) {
        const fs::path folder =
            fs::is_directory(stock.table) ? stock.table : stock.table.parent_path();
        const fs::path path = folder / file;
        return {filled(files.text(path), line, path.string()), path.string(), {}};
    }
    const std::string at = fmt::format("{}:{}", stock.table.string(), line.line);
    if (!stock.template_name.empty())
        return {filled(stock.template_text, line, stock.template_name),
                stock.template_name,
                {}};
    Description description = describe_line(stock, line, files);
    return {std::move(description.text), at + ", in its description",
            std::move(description.decisions)};
}

/// The stock's seed and the building's name, whatever else the stock holds.
std::uint64_t seed_of(std::uint64_t seed, const std::string& name) {
    const std::string text = fmt::format("{}/{}", seed, name);
    return checksum64(text.data(), text.size()) >> 11;
}

void add_building(const schema::Section& own, const schema::Section& root,
                  const StockLine& line, input::InputFiles& files, Job& job) {
    study::Case building = description::read_case({own, root}, files);
    building.name = building.building.name = line.name;
    job.buildings.push_back(std::move(building));
}

Job building_of(const Job& stock_job, const StockLine& line, input::InputFiles& files,
                const Adopted* adopted) {
    const Stock& stock = *stock_job.stock;
    if (!line.complaint.empty())
        throw UserError(ExitCode::data, fmt::format("{}:{}: {}", stock.table.string(),
                                                    line.line, line.complaint));
    Job job;
    job.file = stock_job.file;
    job.name = line.name;
    job.first_chain = stock_job.first_chain;
    job.seed = seed_of(stock_job.seed, line.name);
    files.weathers = stock.weathers;
    const std::string root_name = stock_job.file.string();
    const schema::Node root_tree = schema::parse_document(stock_job.text, root_name);
    const schema::Section root(root_tree, "job", root_name);
    job.studies = read_studies(root, files, job.seed, nullptr);  // with its own seed
    OwnText own = own_text(stock, line, files);
    schema::Node tree = schema::parse_document(own.text, own.file);
    if (adopted != nullptr) lay_adopted(*adopted, root, own.file, tree);
    const schema::Section section(tree, "building", own.file);
    add_building(section, root, line, files, job);
    check_studies_of(root, {names_of(job.buildings[0])}, true, job);
    schema::check_all_used(section);
    auto& decisions = job.buildings[0].decisions;
    decisions.insert(decisions.begin(), own.decisions.begin(), own.decisions.end());
    job.inputs = files.log();
    return job;
}

}  // namespace

std::string StockLine::cell(const std::string& column) const {
    const std::string* found = find(column);
    return found == nullptr ? "" : *found;
}

const std::string* StockLine::find(const std::string& column) const {
    const auto at = std::ranges::lower_bound(*columns, column);
    if (at == columns->end() || *at != column) return nullptr;
    if (at + 1 != columns->end() && at[1] == column)
        throw UserError(ExitCode::data,
                        fmt::format("line {}: column \"{}\" stands there twice; rename "
                                    "one",
                                    line, column));
    return &cells[static_cast<std::size_t>(at - columns->begin())];
}

std::string Stock::hash_of(const StockLine& line) const {
    return hash_without(line, "");
}

std::string Stock::hash_but_end(const StockLine& line) const {
    return hash_without(line, "to");
}

std::string Stock::hash_without(const StockLine& line, std::string_view column) const {
    Hasher hasher;
    for (std::size_t k = 0; k < line.cells.size(); ++k) {
        if ((*line.columns)[k] == column) continue;
        hasher.add(std::string_view((*line.columns)[k]));
        hasher.add(std::string_view(line.cells[k]));
    }
    hasher.add(std::string_view(template_text));
    return hasher.hex();
}

std::shared_ptr<Stock> read_stock(const schema::Section& section,
                                  input::InputFiles& files) {
    auto stock = std::make_shared<Stock>();
    stock->weathers = std::make_shared<description::WeatherMemory>();
    if (section.has("table") == section.has("folder"))
        section.fail("table", "expected either table or folder");
    const bool is_folder = section.has("folder");
    stock->table = section.path(section.text(is_folder ? "folder" : "table"));
    if (section.has("template")) {
        const fs::path path = section.path(section.text("template"));
        stock->template_name = path.string();
        stock->template_text = files.text(path, section.where("template"));
    }
    stock->lines = is_folder ? lines_of(section, stock->table)
                             : lines_of(read_table(section, *stock, files));
    check_names(stock->lines);
    StockOptions& options = stock->options;
    options.recent_days = section.number("recent_days");
    options.window_days = section.number("window_days");
    options.budget = section.number("budget");
    options.hours = section.number("hours");
    options.drift_value = section.number("drift_value");
    options.drift_error = section.number("drift_error");
    options.keep_results = section.flag("keep_results");
    options.false_alarms = section.number("false_alarms");
    return stock;
}

std::string job_text_of_table(const std::string& table) {
    return fmt::format(
        "# A table alone: each building is screened.\n[stock]\ntable = \"{}\"\n\n"
        "[[study]]\nkind = \"screening\"\nn_points = 4096\n",
        table);
}

Job read_stock_building(const Job& stock_job, const StockLine& line,
                        input::InputFiles& files, const Adopted* adopted) {
    const Stock& stock = *stock_job.stock;
    try {
        return building_of(stock_job, line, files, adopted);
    } catch (const UserError& error) {
        // A line of the template says little of the cell that was put there.
        const std::string what = error.what();
        if (stock.template_name.empty() || !what.starts_with(stock.template_name)) throw;
        throw UserError(error.exit_code(),
                        fmt::format("{}:{}: {}", stock.table.string(), line.line, what));
    }
}

}  // namespace bemcal::job
