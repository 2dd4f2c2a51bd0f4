/// What a night over a stock leaves beside its result: its table as CSV, and a history of
/// all nights, in which a night done again is replaced.
/// Plain handling of files, without a source; written under another name first, and one
/// writer at a time. What a line says is stock_tables'. The page is a script's.
#include "report/stock_files.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/lock.hpp"
#include "report/stock_tables.hpp"
#include "report/studies.hpp"
#include "stock/record.hpp"

#include <sstream>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>

namespace bemcal::report {
namespace {

namespace fs = std::filesystem;

/// What stands there behind that head; nothing where nothing does. A file that begins
/// otherwise is somebody else's.
std::string content_behind(const fs::path& path, const std::string& head) {
    if (!file_id(path)) return {};
    std::string text = read_regular(path);
    if (text.empty()) return {};
    if (!text.starts_with(head))
        throw UserError(ExitCode::cannot_create,
                        fmt::format("{}: is there already, and no run wrote it; move it "
                                    "away and go on with --resume",
                                    path.string()));
    return text.substr(head.size());
}

/// The lines of the other nights, without the head.
std::string other_nights(const fs::path& history, const std::string& night) {
    std::istringstream in(content_behind(history, stock::history_head));
    std::string text, line;
    while (std::getline(in, line))
        if (!line.starts_with(csv_cell(night) + ",")) text += line + "\n";
    return text;
}

}  // namespace

void write_stock_files(const run::OutputNames& names, const store::ResultFile& result) {
    const std::vector<Group> stocks = studies_of_kind(result, "stock");
    if (stocks.empty()) return;
    const std::string night = names.result.stem().string();
    Lock one_at_a_time(folder_of(names.result), O_RDONLY | O_DIRECTORY);
    one_at_a_time.wait();
    content_behind(names.table, stock::table_head);
    content_behind(names.changes, stock::changes_head);
    replace_file(names.table, stock_csv(stocks[0]));
    replace_file(names.changes, stock_changes(stocks[0]));
    replace_file(names.history, stock::history_head + other_nights(names.history, night) +
                                    stock_history(stocks[0], night));
}

}  // namespace bemcal::report
